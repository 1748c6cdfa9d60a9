// Lookups of asset = "cloud_light", the light within a cloud, in place of a march towards the sun. The
// sampler is trilinear, repeats along x and y and is clamped along z.
//
// p is in metres from the lower corner of the tile, z up; `tile` are the edges of the tile, the recipe's
// extent.
vec4 cloud_light(sampler3D light, vec3 p, vec3 tile) { return texture(light, p / tile); }

// A map of one slice, contents = "shadow".
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
