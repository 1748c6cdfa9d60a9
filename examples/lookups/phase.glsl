// Lookups of asset = "phase". Use a clamped, linear sampler; tables of one wavelength have it in r.
//
// Phase functions of droplets have peaks of a tenth of a degree, where cosines of floats have no digits
// left: the angle comes as sine and cosine of its half.

// Sine and cosine of half the angle between the unit vectors `a`, the view ray, and `b`, towards the sun.
vec2 half_angle(vec3 a, vec3 b) { return 0.5 * vec2(length(a - b), length(a + b)); }

// The place in the table from 0 to 1 of t = half_angle(a, b), by the table's spacing, which is `mapping`
// in the manifest.
// Cost with half_angle and phase_function: fetches 1, operations 20, divisions 0, special functions 3
float phase_by_angle(vec2 t) { return atan(t.x, t.y) * 0.636619772; }               // 2 / pi

// Cost with half_angle and phase_function: fetches 1, operations 13, divisions 0, special functions 1
float phase_by_cosine(vec2 t) { return t.x * t.x; }

// Cost with half_angle and phase_function: fetches 1, operations 13, divisions 0, special functions 1
float phase_by_cosine_from_back(vec2 t) { return t.y * t.y; }

// Cost with half_angle and phase_function: fetches 1, operations 24, divisions 0, special functions 4
float phase_by_peaks(vec2 t) {                                                      // 2^(-3/4)
    return t.x < t.y ? 0.594603558 * sqrt(t.x) : 1.0 - 0.594603558 * sqrt(t.y);
}

// The phase function at such a place, in 1/sr. `size` is the number of texels.
vec4 phase_function_of_4(sampler2D table, float size, float x) {                    // of four wavelengths
    return texture(table, vec2(x * (1.0 - 1.0 / size) + 0.5 / size, 0.5));
}
vec3 phase_function(sampler2D table, float size, float x) { return vec3(phase_function_of_4(table, size, x)); }

// content = "inverse_cumulative": for x uniform in [0, 1], 1 - cos(angle) of angles that are distributed
// as the phase function. For such a v, sin(angle) is sqrt(v * (2.0 - v)) and loses no digits.
// Cost: fetches 1, operations 2, divisions 0, special functions 0
vec4 sampled_angle_of_4(sampler2D table, float size, float x) {                     // of four wavelengths
    return texture(table, vec2(x * (1.0 - 1.0 / size) + 0.5 / size, 0.5));
}
vec3 sampled_angle(sampler2D table, float size, float x) { return vec3(sampled_angle_of_4(table, size, x)); }
