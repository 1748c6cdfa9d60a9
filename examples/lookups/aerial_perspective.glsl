// Lookups of asset = "aerial_perspective". Use a clamped, trilinear sampler.
//
// `picture` is the place in the camera's picture, (0, 0) at its upper left; d is the distance along the
// view ray, in the unit of view_distance. `slices` is their number, `squared` is true with slices =
// "squared" and false with "linear". Before the first slice, light grows from 0 and transmittance falls
// from 1 with distance.

// The w of the lookup, and the share of its value that is reached at d.
vec2 aerial_depth(float slices, float d, float view_distance, bool squared) {
    float first = 0.5 / slices, x = max(d / view_distance, 0.0);
    return squared ? vec2(sqrt(x), min(x / (first * first), 1.0)) : vec2(x, min(x / first, 1.0));
}

// content = "in_scatter_and_transmittance": the colour of what is seen becomes colour * a + rgb. With
// content = "in_scatter" rgb alone are of use.
// Cost: fetches 1, operations 16, divisions 0, special functions 1
vec4 aerial_perspective(sampler3D air, float slices, vec2 picture, float d, float view_distance, bool squared) {
    vec2 depth = aerial_depth(slices, d, view_distance, squared);
    vec4 value = texture(air, vec3(picture, depth.x));
    return mix(vec4(0.0, 0.0, 0.0, 1.0), value, depth.y);
}

// The same with content = "in_scatter" and four wavelengths.
// Cost: fetches 1, operations 8, divisions 0, special functions 1
vec4 aerial_light_of_4(sampler3D air, float slices, vec2 picture, float d, float view_distance, bool squared) {
    vec2 depth = aerial_depth(slices, d, view_distance, squared);
    return depth.y * texture(air, vec3(picture, depth.x));
}

// These look up content = "transmittance".
// Cost: fetches 1, operations 16, divisions 0, special functions 1
vec4 aerial_transmittance_of_4(sampler3D air, float slices, vec2 picture, float d, float view_distance,
                               bool squared) {
    vec2 depth = aerial_depth(slices, d, view_distance, squared);
    vec4 value = texture(air, vec3(picture, depth.x));
    return mix(vec4(1.0), value, depth.y);
}

vec3 aerial_transmittance(sampler3D air, float slices, vec2 picture, float d, float view_distance,
                          bool squared) {
    return vec3(aerial_transmittance_of_4(air, slices, picture, d, view_distance, squared));
}

// With slices_begin = "air", the default of cameras in space, `d` counts from where the view ray enters
// the air: with way = aerial_way(...), pass d - way.x, and min(way.y, view_distance) for view_distance.
// Nearer points, in front of the air, have light 0 and transmittance 1.

// Where the slices of a view ray of a camera in space begin, and how far they reach. Rays that miss the
// air begin where they are nearest to it. `pitch` is the cosine and the sine of the camera's pitch; r,
// ground and top are the distances of the camera, the ground and the air's top from the planet's centre.
// Cost: fetches 0, operations 37, divisions 2, special functions 4
vec2 aerial_way(vec2 picture, vec2 pitch, float tan_half_fov, float aspect, float r, float ground, float top) {
    vec2 at = tan_half_fov * vec2(aspect * (2.0 * picture.x - 1.0), 1.0 - 2.0 * picture.y);
    float mu = (pitch.y + at.y * pitch.x) / sqrt(1.0 + dot(at, at));
    float nearest = r * sqrt(max(1.0 - mu * mu, 0.0));
    float in_air = sqrt(max((top - nearest) * (top + nearest), 0.0));
    float in_ground = sqrt(max((ground - nearest) * (ground + nearest), 0.0));
    return vec2(max(-r * mu - in_air, 0.0), max(2.0 * (in_air - in_ground), top - ground));
}

// Where a view direction is in the picture of a camera with these axes of length 1 (right: where x grows
// in the picture), tan(fov / 2) of its vertical angle, and aspect. With heading 0 the camera looks
// towards the sun's azimuth; a positive heading turns it to the right. Directions must lie in front of it.
vec2 aerial_picture(vec3 dir, vec3 forward, vec3 right, vec3 up, float tan_half_fov, float aspect) {
    float depth = dot(dir, forward) * tan_half_fov;
    return 0.5 + 0.5 * vec2(dot(dir, right) / (depth * aspect), -dot(dir, up) / depth);
}
