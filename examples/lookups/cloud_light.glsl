// Lookups of asset = "cloud_light", the light within a cloud, in place of a march towards the sun. The
// sampler is trilinear, repeats along x and y and is clamped along z.
//
// p is in metres from the lower corner of the tile, z up; `tile` are the edges of the tile, the recipe's
// extent.

// Cost: fetches 1, operations 6, divisions 0, special functions 0
vec4 cloud_light(sampler3D light, vec3 p, vec3 tile) { return texture(light, p / tile); }

// A map of one slice, contents = "shadow".
// Cost: fetches 1, operations 5, divisions 0, special functions 0
vec4 cloud_shadow(sampler3D light, vec3 p, vec3 tile) {
    return texture(light, vec3(p.x / tile.x, p.y / tile.y, 0.5));
}

// The real spherical harmonics of a unit vector, z up, that each part has coefficients of. The value in a
// direction is the sum over all parts of dot(coefficients, harmonics).
vec4 cloud_harmonics_1(vec3 d) { return vec4(0.28209479, 0.48860251 * d.y, 0.48860251 * d.z, 0.48860251 * d.x); }
vec4 cloud_harmonics_2(vec3 d) {
    return vec4(1.0925484 * d.x * d.y, 1.0925484 * d.y * d.z, 0.94617470 * d.z * d.z - 0.31539157,
                1.0925484 * d.x * d.z);
}
vec4 cloud_harmonics_3(vec3 d) {
    return vec4(0.54627422 * (d.x * d.x - d.y * d.y), 0.59004359 * d.y * (3.0 * d.x * d.x - d.y * d.y),
                2.8906114 * d.x * d.y * d.z, 0.45704580 * d.y * (5.0 * d.z * d.z - 1.0));
}
vec4 cloud_harmonics_4(vec3 d) {
    return vec4(0.37317633 * d.z * (5.0 * d.z * d.z - 3.0), 0.45704580 * d.x * (5.0 * d.z * d.z - 1.0),
                1.4453057 * d.z * (d.x * d.x - d.y * d.y), 0.59004359 * d.x * (d.x * d.x - 3.0 * d.y * d.y));
}

// --- Radiance -----------------------------------------------------------------------------------
//
// contents = "sun_radiance", "sky_radiance" or "clear_sky_radiance", "ground_radiance". A march through the
// cloud adds in each step, with the extinction share * sigma in the place of sigma,
//
//   light += passed * (1 - exp(-share * sigma * length)) * scattered;   passed *= exp(-share * sigma * length)
//   scattered = E * (cloud_first_scattering(phase, depth, share) + sun's harmonics)
//             + radiance of the sky * sky's harmonics + radiance of the ground * ground's harmonics
//
// E is the sun's irradiance, depth the lookup of contents = "optical_depth" at the place, and share the
// asset's extinction_share. Harmonics are sums over parts, as above, of the direction from the place to the
// eye.

// Sunlight that is scattered once: phase is the phase function times the single-scattering albedo.
float cloud_first_scattering(float phase, float depth, float share) { return phase / share * exp(-share * depth); }

// The phase function of droplets in 1/sr at 1 - cosine of the scattering angle, which is the angle between
// the directions from the eye to the place and from the place to the sun: dot(a - b, a - b) / 2 of these
// unit vectors. diameter is in micrometres, 5 to 50 (Jendersie and d'Eon 2023).
float cloud_henyey_greenstein(float g, float offset) {
    float x = (1.0 - g) * (1.0 - g) + 2.0 * g * offset;
    return 0.07957747 * (1.0 - g * g) / (x * sqrt(x));
}
float cloud_droplet_phase(float diameter, float offset) {
    float peak_g = exp(-0.0990567 / (diameter - 1.67154));
    float wide_g = exp(-2.20679 / (diameter + 3.91029) - 0.428934);
    float alpha = exp(3.62489 - 8.29288 / (diameter + 5.52825));
    float wide_share = exp(-0.599085 / (diameter - 0.641583) - 0.665888);
    float u = 1.0 - offset;
    float wide = cloud_henyey_greenstein(wide_g, offset) * (1.0 + alpha * u * u) /
                 (1.0 + alpha * (1.0 + 2.0 * wide_g * wide_g) / 3.0);
    return (1.0 - wide_share) * cloud_henyey_greenstein(peak_g, offset) + wide_share * wide;
}

// That of clouds with particles = "ice": rough crystals (Key et al. 2002).
float cloud_ice_phase(float offset) {
    return 0.99 * cloud_henyey_greenstein(0.779818, offset) + 0.01 * cloud_henyey_greenstein(-0.65, offset);
}
