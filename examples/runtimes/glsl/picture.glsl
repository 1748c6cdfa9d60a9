// A picture by a camera on a plain: x and y along the ground, z up. The camera, the direction to the sun and
// the size of the picture in pixels are those of the block `View`. `pixel` counts from the lower left corner.
vec4 picture(vec2 pixel) {
    vec2 place = (2.0 * pixel - size) / size.x * tan_half_fov;
    vec3 ray = normalize(forward + place.x * right + place.y * up);
    // Jimenez 2014: neighbouring pixels differ much.
    float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
    vec3 light = skybake_view(transmittance_table, multiple_scattering_table, cloud_table, cells_table, camera, ray, sun,
                              2.0 * tan_half_fov / size.x, noise);
    return vec4(shown_by_film(exposure * light), 1.0);
}
