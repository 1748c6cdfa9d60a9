// Lookups of asset = "noise_volume". Use a repeating, trilinear sampler. p is a point and `tile` the edges of
// a tile, in one unit.
// Cost: fetches 1, operations 6, divisions 3, special functions 0
vec4 noise_volume(sampler3D table, vec3 p, vec3 tile) { return texture(table, p / tile); }

// The same with sampling = "corners", at any level of detail: size is that of level 0.
vec4 noise_volume_at_corners(sampler3D table, vec3 size, vec3 p, vec3 tile) {
    return texture(table, p / tile + 0.5 / size);
}

// The four channels of the presets nubis_shape and nubis_detail as one: what pack = "shape" and "detail"
// store. Noise of billows, remapped by the broken-up fBm of the others; and the erosion of its edges.
float nubis_shape(vec4 noise) {
    float fbm = 0.625 * noise.g + 0.25 * noise.b + 0.125 * noise.a;
    return (noise.r - (fbm - 1.0)) / (2.0 - fbm);
}
float nubis_detail(vec3 noise) { return 0.625 * noise.r + 0.25 * noise.g + 0.125 * noise.b; }
