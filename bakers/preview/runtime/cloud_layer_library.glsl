// The sum of densities times metres over `count` samples at start + ray * stride * i.
float NAME_sum(LAYER, vec3 start, vec3 ray, float stride, int count) {
    SUM;
}

// The optical depth of the cloud from p to its layer's top or base, at most as far as its tile is wide, by up to 256
// samples that are `stride` metres or more apart.
float NAME_depth(LAYER, vec3 p, vec3 ray, float stride) {
    float base = BAKED_corner_m().z, to_face = ray.z > 0.0 ? base + BAKED_extent_m().z - p.z : p.z - base;
    float way = min(max(to_face, 0.0) / max(abs(ray.z), 0.0000001), max(BAKED_extent_m().x, BAKED_extent_m().y));
    float apart = max(stride, way / 256.0);
    return BAKED_extinction_per_m() * NAME_sum(LAYER_GIVEN, p + ray * (0.5 * apart), ray, apart, int(way / apart));
}

// The shares of half of the sky's and of half of the ground's light that reach p along a line that slants by 45 degrees
// towards `side`. They come through layers by two-stream theory (Bohren 1987), as through layers above each other.
vec2 NAME_share(LAYER, vec3 p, vec2 side) {
    vec3 slant = vec3(0.70711 * side, 0.70711);
    vec2 depths = vec2(NAME_depth(LAYER_GIVEN, p, slant, 8.0 * STEP_M), NAME_depth(LAYER_GIVEN, p, -slant, 8.0 * STEP_M));
    return 1.0 / (2.0 + BACKWARD * 0.70711 * depths);
}

// What a camera sees of the cloud, which repeats along x and y, up to `reach_m`: a march that leaps over what is empty,
// with one from each sample towards the sun. The whole layer lets the share THROUGH of the sky's light pass.
// A pixel is `pixel` radians wide, and its `noise` in [0, 1) moves its samples.
Clouds NAME_seen(TABLES, LAYER, vec3 camera_m, vec3 ray, vec3 sun, float reach_m, float pixel, float noise) {
    float base = BAKED_corner_m().z, height = BAKED_extent_m().z, level = abs(ray.z) < 0.0000001 ? 0.0000001 : ray.z;
    vec2 faces = (vec2(base, base + height) - camera_m.z) / level;
    float nearest = max(min(faces.x, faces.y), 0.0), farthest = min(max(faces.x, faces.y), min(reach_m, REACH_M));
    Clouds seen;
    seen.light = Light(0.0);
    seen.through = 1.0;
    seen.distance_m = 0.0;
    if (nearest >= farthest) return seen;
    CloudOctaves octaves = cloud_octaves(PHASE, ray, sun);
    float radius = baked_ground_radius_km(), low = 0.001 * base, high = 0.001 * (base + height);
    Light sun_low = air_sunlight(SUN_TABLE, low, (radius + low) * sun.z);
    Light sun_high = air_sunlight(SUN_TABLE, high, (radius + high) * sun.z);
    Light from_sky = air_skylight(SUN_TABLE, LIGHT_TABLE, high, (radius + high) * sun.z);
    Light from_ground = air_ground_light(SUN_TABLE, LIGHT_TABLE, radius * sun.z);
    float k = max(floor(cloud_samples_to(nearest / STEP_M, pixel)) - 1.0, 0.0);
    float end = floor(cloud_samples_to(farthest / STEP_M, pixel)) + 2.0;
    bool was_empty = true;
    while (k < end && seen.through > 0.001) {
        float t = STEP_M * (k + noise) * (1.0 + pixel * (k + noise)), leap = 0.0, density = 0.0;
        bool is_inside = t >= nearest && t <= farthest;
        vec3 p = camera_m + ray * t;
        if (is_inside && was_empty) leap = LEAP;
        if (is_inside && leap <= 0.0) density = DENSITY;
        was_empty = density <= 0.0;
        if (density > 0.0) {
            float depth = sun.z > 0.0 ? NAME_depth(LAYER_GIVEN, p, sun, STEP_M) : 1000000.0;
            vec2 shares = 0.25 * (NAME_share(LAYER_GIVEN, p, vec2(1.0, 0.0)) + NAME_share(LAYER_GIVEN, p, vec2(-1.0, 0.0)) +
                                  NAME_share(LAYER_GIVEN, p, vec2(0.0, 1.0)) + NAME_share(LAYER_GIVEN, p, vec2(0.0, -1.0)));
            Light light = cloud_sunlit(octaves, depth) * mix(sun_low, sun_high, (p.z - base) / height) +
                          shares.x * from_sky + shares.y * THROUGH * from_ground;
            float passed = exp(-BAKED_extinction_per_m() * density * STEP_M * (1.0 + pixel * (2.0 * k + 1.0)));
            float weight = seen.through * (1.0 - passed);
            seen.light += weight * light;
            seen.distance_m += weight * t;
            seen.through *= passed;
        }
        k = max(k + 1.0, floor(cloud_samples_to((t + leap) / STEP_M, pixel) - noise));
    }
    if (seen.through >= 1.0) return seen;
    seen.distance_m /= 1.0 - seen.through;
    Air air = air_along(GIVEN, 0.001 * camera_m.z, ray, sun, 0.001 * seen.distance_m, 12);
    seen.light = air.through * seen.light + (1.0 - seen.through) * air.light;
    return seen;
}
