// Lookups of asset = "transmittance", and of asset = "bruneton" with table = "transmittance": the share
// of light that comes through from a point to the top of the atmosphere; with content = "optical_depth"
// the optical depth. Use a clamped, bilinear sampler.
//
// R is the ground's radius, D the thickness of the air (top_radius - ground_radius), h the altitude,
// from 0 to D, all in km; mu is the cosine of the ray's zenith angle. The ray must not meet the ground.
// `size` are the table's texels.
// A difference of squared radii would lose metres in float: these forms keep the altitude.

// The place in the table from 0 to 1: straight up and the horizon, the ground and the top.
vec2 transmittance_place(float R, float D, float h, float mu) {
    float H = sqrt(D * (2.0 * R + D)), rho = sqrt(h * (2.0 * R + h));
    float s = (R + h) * mu, q = (D - h) * (2.0 * R + D + h), root = sqrt(s * s + q);
    float d = s > 0.0 ? q / (root + s) : root - s;          // the distance to the top
    float d_min = D - h, d_max = rho + H;
    return vec2((d - d_min) / (d_max - d_min), rho / H);
}

// Cost: fetches 1, operations 23, divisions 2, special functions 2
vec4 transmittance_to_top_of_4(sampler2D table, vec2 size, float R, float D, float h, float mu) {
    vec2 x = transmittance_place(R, D, h, mu);                                      // of four wavelengths
    return texture(table, x * (1.0 - 1.0 / size) + 0.5 / size);
}
vec3 transmittance_to_top(sampler2D table, vec2 size, float R, float D, float h, float mu) {
    return vec3(transmittance_to_top_of_4(table, size, R, D, h, mu));
}

// The same with mapping = "ue".
// Cost: fetches 1, operations 19, divisions 2, special functions 2
vec4 transmittance_to_top_ue_of_4(sampler2D table, float R, float D, float h, float mu) {
    return texture(table, transmittance_place(R, D, h, mu));
}
vec3 transmittance_to_top_ue(sampler2D table, float R, float D, float h, float mu) {
    return vec3(transmittance_to_top_ue_of_4(table, R, D, h, mu));
}
