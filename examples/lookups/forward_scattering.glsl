// Lookup of asset = "forward_scattering", with which a march through a cloud shows the light around the sun.
// Use a clamped, linear sampler. A step adds, with cloud_light.glsl,
//
//   E * cloud_first_scattering(phase, depth, share) * forward_scattering(table, offset, depth)
//
// in the place of E * cloud_first_scattering(phase, depth, share). offset is 1 - cosine of the scattering
// angle, which is dot(a - b, a - b) / 2 of the unit vectors from the eye to the place and from the place to
// the sun; depth is the optical depth to the sun, and `size` are the texels of the table.
// Cost: fetches 1, operations 8, divisions 1, special functions 2
float forward_scattering(sampler2D table, vec2 size, float offset, float depth) {
    float within = min(depth, 252.0);
    vec2 place = vec2(sqrt(sqrt(0.5 * offset)), 1.01587302 * within / (within + 4.0));
    return texture(table, place * (1.0 - 1.0 / size) + 0.5 / size).r;
}
