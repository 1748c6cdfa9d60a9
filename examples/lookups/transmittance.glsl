// Lookups of asset = "transmittance", and of asset = "bruneton" with table = "transmittance": the share
// of light that comes through from a point to the top of the atmosphere; with content = "optical_depth"
// the optical depth. Use a clamped, bilinear sampler.
//
// R is the ground's radius, D the thickness of the air (top_radius - ground_radius), h the altitude,
// from 0 to D, all in km; mu is the cosine of the ray's zenith angle. The ray must not meet the ground.
// A difference of squared radii would lose metres in float: these forms keep the altitude.

// The place in the table from 0 to 1: straight up and the horizon, the ground and the top.
vec2 transmittance_place(float R, float D, float h, float mu) {
    float H = sqrt(D * (2.0 * R + D)), rho = sqrt(h * (2.0 * R + h));
    float s = (R + h) * mu, q = (D - h) * (2.0 * R + D + h), root = sqrt(s * s + q);
    float d = s > 0.0 ? q / (root + s) : root - s;          // the distance to the top
    float d_min = D - h, d_max = rho + H;
    return vec2((d - d_min) / (d_max - d_min), rho / H);
}

vec3 transmittance_to_top(sampler2D table, float R, float D, float h, float mu) {
    vec2 size = vec2(textureSize(table, 0)), x = transmittance_place(R, D, h, mu);
    return texture(table, (0.5 + x * (size - 1.0)) / size).rgb;
}

// The same with mapping = "ue".
vec3 transmittance_to_top_ue(sampler2D table, float R, float D, float h, float mu) {
    return texture(table, transmittance_place(R, D, h, mu)).rgb;
}

// The same for tables of four wavelengths.
vec4 transmittance_to_top_of_4(sampler2D table, float R, float D, float h, float mu) {
    vec2 size = vec2(textureSize(table, 0)), x = transmittance_place(R, D, h, mu);
    return texture(table, (0.5 + x * (size - 1.0)) / size);
}

vec4 transmittance_to_top_ue_of_4(sampler2D table, float R, float D, float h, float mu) {
    return texture(table, transmittance_place(R, D, h, mu));
}
