// A picture by a camera on a plain: x and y along the ground, z up. The camera, the direction to the sun and
// the size of the picture in pixels are those of the block `View`. `pixel` counts from the lower left corner.
vec4 picture(vec2 pixel) {
    vec2 place = (2.0 * pixel - size) / size.x * tan_half_fov;
    vec3 ray = normalize(forward + place.x * right + place.y * up);
    float h = camera.z * 1e-3;
    vec3 light = sky(h, ray, sun);
    // Jimenez 2014: neighbouring pixels differ much.
    float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
    Clouds clouds = clouds_along(camera, ray, sun, 144e3, noise);
    if (clouds.through < 1.0) {
        Air air = air_along(h, ray, sun, clouds.distance * 1e-3, SKY_OF_CLOUDS);
        light = air.through * clouds.light + (1.0 - clouds.through) * air.light + clouds.through * light;
    }
    return vec4(shown_by_film(exposure * light), 1.0);
}
