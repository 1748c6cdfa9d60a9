// One sample of each pixel: linear light for the screen, and in the last channel how often a ray has read the
// cloud and its grid. `before` holds the mean of the samples so far.
uniform vec3 camera, forward, right, up;                                    // camera in metres
uniform vec2 size, offset;                                                  // of the picture, in pixels
uniform float tan_half_fov, weight, rank;
uniform bool has_disc, has_shadow;
uniform highp sampler2D before, light_table;
out vec4 color;

// Interleaved gradient noise (Jimenez 2014), moved for each layer; row 0 is at the top. Further samples of a
// pixel shift it by the golden ratio.
float noise_of(vec2 pixel, float layer) {
    vec2 moved = pixel + 5.588238 * layer;
    float noise = fract(52.9829189 * fract(0.06711056 * moved.x + 0.00583715 * moved.y));
    return fract(noise + 0.618034 * rank);
}

void main() {
    vec2 place = (2.0 * (gl_FragCoord.xy + offset) - size) / size.x * tan_half_fov;
    vec3 ray = normalize(forward + place.x * right + place.y * up);
    vec2 pixel = vec2(gl_FragCoord.x - 0.5, size.y - gl_FragCoord.y - 0.5);
    float h = camera.z * 1e-3, reads = 0.0, through = 1.0;
    Air air = air_along(h, ray);
    Light light = air.light;
#ifdef CLOUDS
    Clouds clouds = clouds_along(camera, ray, vec2(noise_of(pixel, 0.0), noise_of(pixel, 1.0)));
    through = clouds.through;
#endif
    if (air.grounded) {
        float lit = 1.0;
#ifdef CLOUDS
        if (has_shadow && through > OPAQUE) lit = lit_ground(camera.xy + ray.xy * air.end * 1e3);
#endif
        light += air.through * ground_light((R + h) * sun.z + air.end * dot(ray, sun), lit);
    } else if (has_disc) {
        float angle_of_pixel = 2.0 * tan_half_fov / size.x;
        light += sun_disc(ray, air.through, angle_of_pixel);
    }
#ifdef CLOUDS
    if (through < 1.0) {
        Light lit = Light(0.0);
        for (int i = 0; i < 4; ++i) lit += clouds.sources[i] * Light(texelFetch(light_table, ivec2(i, 0), 0));
        // The air before the clouds has a share of the light of all air along the ray (Hillaire 2016).
        Light near = through_air(h, ray, clouds.distance * 1e-3);
        Light share = min((1.0 - near) / max(1.0 - air.through, 1e-7), 1.0);
        light = near * lit + (1.0 - through) * share * air.light + through * light;
    }
    reads = float(fetches);
#endif
    color = vec4(shown(light), reads);
    if (weight < 1.0) color = mix(texelFetch(before, ivec2(gl_FragCoord.xy), 0), color, weight);
}
