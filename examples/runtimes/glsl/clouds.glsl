// The clouds of recipe.toml, lit by the sun and the sky: a march that leaps by the baked grid, and one from
// each sample towards the sun. cloud_table and cells_table are the textures. `camera` is in metres, z is the
// altitude.
#define BASE baked_cloud_corner_m().z                                       // of the recipe
#define TOP (BASE + baked_cloud_extent_m().z)
#define EXTINCTION baked_cloud_extinction_per_m()
const float STEP = 23.4, SUN_STEP = 23.4, UP_STEP = 47.0, OPAQUE = 0.002;   // m; a voxel, and two
const int SKY_OF_CLOUDS = 12;                                               // steps through the air before them
const int OCTAVES = 8;

// Droplets of 12 um: Henyey-Greenstein's and Draine's functions (Jendersie and d'Eon 2023). Light that is
// scattered n more times sees them wider by 2^-n (Wrenninge et al. 2013). u is 1 - cosine.
float henyey_greenstein(float g, float u) {
    float b = (1.0 - g) * (1.0 - g) + 2.0 * g * u;
    return (1.0 - g * g) / (4.0 * PI * b * sqrt(b));
}
float droplets(float u, float wide) {
    float g = 0.56686 * wide, alpha = 23.385 * wide, c = 1.0 - u;
    float draine = henyey_greenstein(g, u) * (1.0 + alpha * c * c) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
    return mix(henyey_greenstein(0.99045 * wide, u), draine, 0.48742);
}

// The optical depth from p to the top or the base of the layer, along a ray that rises or falls.
float depth_along(vec3 p, vec3 ray, float stride) {
    float way = ((ray.z > 0.0 ? TOP : BASE) - p.z) / ray.z;
    return EXTINCTION * baked_cells_march(cloud_table, cells_table, p + ray * 0.5 * stride, ray, stride, int(way / stride));
}

struct Clouds { vec3 light; float through, distance; };                     // distance in metres

// `noise` in [0, 1) shifts the samples of a pixel.
Clouds clouds_along(vec3 camera, vec3 ray, vec3 sun, float reach, float noise) {
    vec2 faces = (vec2(BASE, TOP) - camera.z) / ray.z;                      // infinite for a level ray
    float first = max(min(faces.x, faces.y), 0.0), last = min(max(faces.x, faces.y), reach);
    Clouds seen = Clouds(vec3(0.0), 1.0, 0.0);
    float octaves[OCTAVES], u = 0.5 * dot(ray - sun, ray - sun), weights = 0.0, bright = 1.0, wide = 1.0;
    for (int n = 0; n < OCTAVES; ++n) {
        octaves[n] = bright * droplets(u, wide);
        bright *= 0.7;
        wide *= 0.5;
    }
    float km = 1e-3, low = R + BASE * km, high = R + TOP * km;
    vec3 sun_low = sunlight(BASE * km, low * sun.z), sun_high = sunlight(TOP * km, high * sun.z);
    vec3 from_sky = skylight(TOP * km, high * sun.z), from_ground = ground(R * sun.z);
    float t = (ceil(first / STEP - noise) + noise) * STEP;
    while (t < last && seen.through > OPAQUE) {
        vec3 p = camera + ray * t;
        float empty = baked_cells_leap(cloud_table, cells_table, p, ray);
        if (empty > 0.0) {
            t += STEP * max(floor(empty / STEP), 1.0);                      // the sample before the box's face
            continue;
        }
        float density = baked_cloud(cloud_table, p);
        if (density > 0.0) {
            float depth = sun.z > 0.0 ? depth_along(p, sun, SUN_STEP) : 1e9, lit = 0.0;
            for (int n = 0; n < OCTAVES; ++n, depth *= 0.5) lit += octaves[n] * exp(-depth);
            // Diffuse light comes through layers by two-stream theory (Bohren 1987), g = 0.869.
            float above = depth_along(p, vec3(0.0, 0.0, 1.0), UP_STEP);
            float below = depth_along(p, vec3(0.0, 0.0, -1.0), UP_STEP);
            vec3 light = lit * mix(sun_low, sun_high, (p.z - BASE) / (TOP - BASE)) +
                         from_sky / (2.0 + 0.131 * above) +
                         from_ground / (2.0 + 0.131 * below) * 2.0 / (2.0 + 0.131 * (above + below));
            float passed = exp(-EXTINCTION * density * STEP), weight = seen.through * (1.0 - passed);
            seen.light += weight * light;
            seen.distance += weight * t;
            weights += weight;
            seen.through *= passed;
        }
        t += STEP;
    }
    seen.distance /= max(weights, 1e-9);
    return seen;
}
