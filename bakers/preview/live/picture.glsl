// One sample of each pixel: linear light for the screen, and in the last channel how often a ray has read the
// cloud and its grid. `before` holds the mean of the samples so far.
uniform vec3 camera, forward, right, up;                                    // camera in metres
uniform vec2 size, offset;                                                  // of the picture, in pixels
uniform float tan_half_fov, weight, rank;
uniform bool has_disc, has_glare, has_shadow;
uniform float ground_through, mean_sunlight;                                // of the sky's light, and of the sun's directly
uniform highp sampler2D before, light_table;
out vec4 color;

// Interleaved gradient noise (Jimenez 2014) in quarters, as bakers/render/frame_march.cpp has it, in one of two
// patterns; row 0 is at the top. Further samples of a pixel shift it by the golden ratio.
float noise_of(vec2 pixel, int pattern) {
    vec2 moved = pixel + 5.588238 * float(pattern);
    float noise = fract(52.9829189 * fract(0.06711056 * moved.x + 0.00583715 * moved.y));
    int place = (int(pixel.x) & 1) + 2 * (int(pixel.y) & 1);
    vec4 quarters = pattern == 0 ? vec4(0.0, 2.0, 3.0, 1.0) : vec4(2.0, 3.0, 1.0, 0.0);
    return fract(0.25 * (quarters[place] + noise) + 0.618034 * rank);
}

#ifdef CLOUDS_OF_RECIPE
// The share f of its light that the ground keeps below clouds (bakers/render/scene_view.h), of which `direct` is that
// of the sun's which comes straight.
Light shaded_ground(float direct) {
    Light by_sun = Light(texelFetch(light_table, ivec2(0, CLOUDS), 0)), by_sky = Light(texelFetch(light_table, ivec2(1, CLOUDS), 0));
    Light kept = by_sun * (direct + max(ground_through - mean_sunlight, 0.0)) + by_sky * ground_through;
    return kept / max(by_sun + by_sky, Light(1e-30));
}

// Whether a ray from above all layers passes over the limb of the highest one's top (limb_slope of
// bakers/render/scene_view.cpp), beyond which flat layers go on.
bool passes_limb(vec3 ray) {
    float top = 0.0;
    for (int layer = 0; layer < CLOUDS; ++layer) top = max(top, BASE[layer] + TILE[layer].z);
    float above = 1e-3 * (camera.z - top), r = R + 1e-3 * camera.z;
    return repeats && above > 0.0 && ray.z > -sqrt(above * (2.0 * r - above)) / r;
}

// The light of a layer, with the air before it, which has a share of the light of all air along the ray
// (Hillaire 2016).
Light cloud_light(int layer, Cloud cloud, float h, vec3 ray, Air air) {
    Light lit = Light(0.0);
    for (int i = 0; i < 4; ++i) lit += cloud.sources[i] * Light(texelFetch(light_table, ivec2(i, layer), 0));
    Light near = through_air(h, ray, cloud.distance * 1e-3);
    Light share = min((1.0 - near) / max(1.0 - air.through, 1e-7), 1.0);
    return near * lit + cloud.opacity * share * air.light;
}
#endif

// The light that the lens scatters, of the sunlight that the clouds let through to the camera.
Light glare_at(float h, vec3 ray) {
    Light seen = sunlight(h, (R + h) * sun.z) * lens_veil(ray);
#ifdef CLOUDS_OF_RECIPE
    seen *= exp(-depth_to_sun(-1, camera, 0.0, 0.5));
#endif
    return seen;
}

void main() {
    vec2 place = (2.0 * (gl_FragCoord.xy + offset) - size) / size.x * tan_half_fov;
    vec3 ray = normalize(forward + place.x * right + place.y * up);
    vec2 pixel = vec2(gl_FragCoord.x - 0.5, size.y - gl_FragCoord.y - 0.5);
    float h = camera.z * 1e-3, reads = 0.0, through = 1.0;
    Air air = air_along(h, ray);
    Light light = air.light, ground = Light(1.0);
#ifdef CLOUDS_OF_RECIPE
    Cloud clouds[CLOUDS];
    vec2 noise = vec2(noise_of(pixel, 0), noise_of(pixel, 1));
    through = march_clouds(camera, ray, noise, 2.0 * tan_half_fov / size.x, clouds);
    if (passes_limb(ray)) {
        through = 1.0;
        for (int layer = 0; layer < CLOUDS; ++layer) clouds[layer] = Cloud(vec4(0.0), 0.0, 0.0);
    }
    if (has_shadow && air.grounded && through > OPAQUE) {
        ground = shaded_ground(sunlight_on_ground(camera, ray, noise.y, mean_sunlight));
    }
    ground *= ground_mottle(camera, ray, 2.0 * tan_half_fov / size.x);
#endif
    if (air.grounded) {
        light += air.through * ground * ground_light((R + h) * sun.z + air.end_km * dot(ray, sun));
    } else if (has_disc) {
        float angle_of_pixel = 2.0 * tan_half_fov / size.x;
        light += (has_glare ? 0.99 : 1.0) * sun_disc(ray, air.through, angle_of_pixel);
    }
#ifdef CLOUDS_OF_RECIPE
    light *= through;
    for (int layer = 0; layer < CLOUDS; ++layer) {
        if (clouds[layer].opacity > 0.0) light += cloud_light(layer, clouds[layer], h, ray, air);
    }
    reads = float(fetches);
#endif
    if (has_glare) light += glare_at(h, ray);
    color = vec4(linear_srgb(light), reads);
    if (weight < 1.0) color = mix(texelFetch(before, ivec2(gl_FragCoord.xy), 0), color, weight);
}
