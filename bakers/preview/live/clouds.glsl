// Clouds, marched and lit as bakers/render/scene_view.h describes: samples of a layer lie at (k + jitter) * its step,
// those of all layers are taken in the order of their distances, a march leaps by the grid over what is empty, and
// others go from each lit sample towards the sun. Above this text stand the numbers of the recipe, the published
// lookups, cloud_library.glsl and one function for each layer's textures (live_glsl.h). Places are in metres: x and y
// from the tiles' corner, and z from the ground or, where a function takes a layer and p, from the layer's base.
uniform highp sampler3D share_table;
uniform float extinction_factor, view_step[CLOUDS], sun_step[CLOUDS], sun_samples[CLOUDS], reach[CLOUDS];
uniform vec2 fade[CLOUDS];      // the distances between which a layer fades; it does not where both are 0
uniform vec4 share_of[CLOUDS];  // blocks along x, y and z, and where they begin in the table along z

const int OCTAVES = 8, ALL_OCTAVES = OCTAVES * CLOUDS;
const float OPAQUE = 0.0009765625, SHARED_DEPTH = 0.125, SHARED_BEHIND = 0.015625;

int fetches = 0;

bool within(int layer, vec3 p) {
    return p.z >= 0.0 && p.z <= TILE[layer].z &&
           (repeats || all(greaterThanEqual(p.xy, vec2(0.0))) && all(lessThan(p.xy, TILE[layer].xy)));
}

// The extinction at p, in 1/m.
float extinction_at(int layer, vec3 p) {
    ++fetches;
    return EXTINCTION[layer] * extinction_factor * density_of(layer, value_in_layer(layer, p));
}

// The samples that certainly lie in empty cells, beginning with the one at p; 0 where there may be cloud.
float empty_way(int layer, vec3 p, vec3 ray) {
    ++fetches;
    return leap_in_layer(layer, p, ray);
}
float empty_samples(int layer, vec3 p, vec3 ray, float stride) {
    float way = empty_way(layer, p, ray);
    return way > 0.0 ? max(floor(way / stride), 1.0) : 0.0;
}

// The first sample towards the sun that is in the layer, for a place outside of it; -1 where there is none.
float first_towards_sun(int layer, vec3 p, float jitter) {
    float first = 0.0;
    for (int a = repeats ? 2 : 0; a < 3; ++a) {
        if (p[a] >= 0.0 && p[a] <= TILE[layer][a]) continue;
        float way = p[a] < 0.0 ? -p[a] : TILE[layer][a] - p[a], climb = sun[a] * sun_step[layer];
        if (way * climb <= 0.0) return -1.0;
        first = max(first, ceil(way / climb - jitter));
    }
    return first;
}

// The optical depth from a place in cloud to its first sample, as far as it follows from the extinction there.
float depth_before_first(int layer, vec3 p, float sigma, float jitter) {
    float climb = sun.z * sun_step[layer], to_face = climb > 0.0 ? TILE[layer].z - p.z : -p.z;
    return sigma * sun_step[layer] * (climb != 0.0 && to_face / climb < jitter ? to_face / climb : 0.5 * jitter);
}

// The optical depth of a layer from `place` towards the sun. Inside of the layer, `sigma` is the extinction there, and
// the trapezoidal rule leads from there to the second sample.
float depth_in_layer(int layer, vec3 place, float sigma, float jitter, bool is_inside) {
    vec3 p = place - vec3(0.0, 0.0, BASE[layer]);
    float first = is_inside ? 0.0 : first_towards_sun(layer, p, jitter);
    if (first < 0.0) return 0.0;
    float depth = is_inside ? depth_before_first(layer, p, sigma, jitter) : 0.0;
    bool was_empty = !is_inside;
    for (float k = first; k < first + sun_samples[layer];) {
        vec3 at = p + sun * ((k + jitter) * sun_step[layer]);
        if (!within(layer, at)) {
            if (is_inside || k > first) break;
            k += 1.0;  // rounding has left the first sample outside
            continue;
        }
        float empty = was_empty ? empty_samples(layer, at, sun, sun_step[layer]) : 0.0;
        if (empty == 0.0) {
            float here = extinction_at(layer, at);
            depth += here * sun_step[layer] * (is_inside && k == 0.0 ? 0.5 + 0.5 * jitter : 1.0);
            was_empty = here == 0.0;
        }
        k += max(empty, 1.0);
    }
    return depth;
}

// The optical depth of all layers from a place in one of them, or below all of them (-1), towards the sun.
float depth_to_sun(int inside, vec3 place, float sigma, float jitter) {
    float depth = 0.0;
    for (int layer = 0; layer < CLOUDS; ++layer) depth += depth_in_layer(layer, place, sigma, jitter, layer == inside);
    return depth;
}

// The distances at which a ray enters and leaves a layer, or its only tile; nowhere where x > y.
vec2 span_in_layer(int layer, vec3 from, vec3 ray) {
    vec2 span = vec2(0.0, reach[layer]);
    for (int a = repeats ? 2 : 0; a < 3; ++a) {
        if (abs(ray[a]) < 1e-7) {
            if (from[a] < 0.0 || from[a] > TILE[layer][a]) return vec2(1.0, 0.0);
            continue;
        }
        vec2 faces = vec2(-from[a], TILE[layer][a] - from[a]) / ray[a];
        span = vec2(max(span.x, min(faces.x, faces.y)), min(span.y, max(faces.x, faces.y)));
    }
    return span;
}

// The share of a layer's extinction that is left at a distance.
float faded(int layer, float t) {
    if (fade[layer].y == 0.0) return 1.0;
    float x = clamp((fade[layer].y - t) / (fade[layer].y - fade[layer].x), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// The shares of the sky's and of the ground's light at p. The table has one more block on each side of a layer's.
vec2 diffuse_shares(int layer, vec3 p) {
    vec3 place = place_in_volume(layer, p) / TILE[layer];
    vec3 blocks = vec3(fract(place.xy), clamp(place.z, 0.0, 1.0)) * share_of[layer].xyz;
    return texture(share_table, (blocks + vec3(1.0, 1.0, 1.0 + share_of[layer].w)) / vec3(textureSize(share_table, 0))).rg;
}

// A layer as coefficients of its light: the sun's at its base and at its top, the mean radiance of the sky and of the
// ground; and the share of light from the eye that ends in it, with the distance in metres at which it does.
struct Cloud {
    vec4 sources;
    float opacity, distance;
};

// The light at p, where a ray meets sunlight by `octaves`.
vec4 light_at(int layer, vec3 p, float sigma, float jitter, float octaves[ALL_OCTAVES]) {
    float depth = depth_to_sun(layer, p + vec3(0.0, 0.0, BASE[layer]), sigma, jitter);
    float sunlit = 0.0, height = p.z / TILE[layer].z;
    for (int n = 0; n < OCTAVES; ++n, depth *= 0.5) sunlit += octaves[layer * OCTAVES + n] * exp(-depth);
    return vec4(sunlit * (1.0 - height), sunlit * height, 0.5 * diffuse_shares(layer, p));
}

// The march of one layer's samples.
struct Samples {
    float k, last, lit_k;
    bool was_empty;
    vec4 light;
};
// Samples lie at t = u (1 + growth u) step with u = k + jitter, and growth is the angle of a pixel
// (bakers/march/cloud_rays.h). samples_to returns the u of a distance.
float samples_to(int layer, float t, float growth) { return cloud_samples_to(t / view_step[layer], growth); }
float sample_at(int layer, float u, float growth) { return u * (1.0 + growth * u) * view_step[layer]; }
Samples samples_in_layer(int layer, vec3 camera, vec3 ray, float growth) {
    vec2 span = span_in_layer(layer, camera - vec3(0.0, 0.0, BASE[layer]), ray);
    if (ray.z < 0.0) span.y = min(span.y, camera.z / -ray.z);  // the ground
    float first = max(floor(samples_to(layer, span.x, growth)) - 1.0, 0.0);
    float last = ceil(samples_to(layer, span.y, growth)) + 1.0;
    return Samples(first, span.x > span.y ? first : last, -2.0, true, vec4(0.0));
}

// Takes the next sample of a layer, or leaps.
void take_sample(int layer, vec3 camera, vec3 ray, vec2 noise, float growth, float octaves[ALL_OCTAVES],
                 inout Samples samples, inout Cloud cloud, inout float through) {
    float stride = view_step[layer] * (1.0 + growth * (2.0 * samples.k + 1.0));
    float t = sample_at(layer, samples.k + noise.x, growth);
    vec3 p = camera - vec3(0.0, 0.0, BASE[layer]) + ray * t;
    if (!within(layer, p)) {
        samples.k += 1.0;
        return;
    }
    float empty = samples.was_empty ? empty_way(layer, p, ray) : 0.0;
    if (empty > 0.0) {
        samples.k = max(floor(samples_to(layer, t + empty, growth) - noise.x), samples.k + 1.0);
        return;
    }
    float sigma = extinction_at(layer, p) * faded(layer, t);
    samples.was_empty = sigma == 0.0;
    if (sigma > 0.0) {
        // A sample shares the light of the one before it if the eye sees little of the difference.
        bool thin = mod(samples.k, 2.0) > 0.5 && sigma * stride <= SHARED_DEPTH;
        if (samples.lit_k + 1.0 != samples.k || (!thin && through > SHARED_BEHIND)) {
            samples.light = light_at(layer, p, sigma, noise.y, octaves);
        }
        samples.lit_k = samples.k;
        float passed = exp(-sigma * stride), weight = through * (1.0 - passed);
        cloud.sources += weight * samples.light;
        cloud.distance += weight * t;
        cloud.opacity += weight;
        through *= passed;
    }
    samples.k += 1.0;
}

// Returns what is seen through all clouds by a pixel of an angle.
float march_clouds(vec3 camera, vec3 ray, vec2 noise, float pixel, out Cloud clouds[CLOUDS]) {
    float octaves[ALL_OCTAVES], u = 0.5 * dot(ray - sun, ray - sun), through = 1.0;
    for (int i = 0; i < ALL_OCTAVES; ++i) {
        float n = float(i % OCTAVES);
        octaves[i] = pow(0.7, n) * cloud_phase(PHASE[i / OCTAVES], u, exp2(-n));
    }
    Samples samples[CLOUDS];
    for (int layer = 0; layer < CLOUDS; ++layer) {
        clouds[layer] = Cloud(vec4(0.0), 0.0, 0.0);
        samples[layer] = samples_in_layer(layer, camera, ray, pixel);
    }
    for (int next = 0; next >= 0 && through >= OPAQUE;) {
        next = -1;
        float nearest = 1e30;
        for (int layer = 0; layer < CLOUDS; ++layer) {
            float t = sample_at(layer, samples[layer].k + noise.x, pixel);
            if (samples[layer].k >= samples[layer].last || t >= nearest) continue;
            nearest = t;
            next = layer;
        }
        if (next >= 0) take_sample(next, camera, ray, noise, pixel, octaves, samples[next], clouds[next], through);
    }
    for (int layer = 0; layer < CLOUDS; ++layer) clouds[layer].distance /= max(clouds[layer].opacity, 1e-9);
    return through;
}

// The share of sunlight that the clouds let through to the ground that a ray meets; the mean of it beyond the reach.
float sunlight_on_ground(vec3 camera, vec3 ray, float jitter, float mean_sunlight) {
    float way = camera.z / max(-ray.z, 1e-9), farthest = 0.0;
    for (int layer = 0; layer < CLOUDS; ++layer) farthest = max(farthest, reach[layer]);
    if (sun.z <= 0.0 || way > farthest) return mean_sunlight;
    return exp(-depth_to_sun(-1, vec3(camera.xy + way * ray.xy, 0.0), 0.0, jitter));
}

// The ground's albedo varies as bakers/render/scene_view.h says.
float corner_value(ivec2 corner, int noise) {
    uint bits = uint(corner.x) * 0x9e3779b1u ^ uint(corner.y) * 0x85ebca77u ^ uint(noise) * 0xc2b2ae3du;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 12) * 0x297a2d39u;
    bits ^= bits >> 15;
    return float(bits >> 8) * exp2(-23.0) - 1.0;
}
float value_noise(vec2 p, int noise) {
    vec2 low = floor(p), t = (p - low) * (p - low) * (3.0 - 2.0 * (p - low));
    ivec2 corner = ivec2(low);
    return mix(mix(corner_value(corner, noise), corner_value(corner + ivec2(1, 0), noise), t.x),
               mix(corner_value(corner + ivec2(0, 1), noise), corner_value(corner + ivec2(1), noise), t.x), t.y);
}
Light ground_mottle(vec3 camera, vec3 ray, float pixel) {
    float way = camera.z / max(-ray.z, 1e-9), cell = 3000.0, sum = 0.0;
    if (ray.z >= 0.0 || way * pixel >= cell) return Light(1.0);
    vec2 p = camera.xy + way * ray.xy;
    for (int noise = 0; noise < 6; ++noise, cell /= 2.75) {
        float share = clamp((cell * -ray.z / (way * pixel) - 1.0) / 3.0, 0.0, 1.0);
        if (share == 0.0) break;
        sum += 0.125 * share * share * (3.0 - 2.0 * share) * value_noise(p / cell, noise);
        p = mat2(0.8, 0.6, -0.6, 0.8) * p;
    }
    return 1.0 + sum * min((1.0 / max(air_ground_albedo(), Light(1e-9)) - 1.0) / 0.75, Light(1.0));
}
