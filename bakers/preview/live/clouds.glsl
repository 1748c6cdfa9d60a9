// Clouds, marched and lit as bakers/render/cloud_view.h describes: samples lie at (k + jitter) * STEP, a march
// leaps by the grid over what is empty, and another one goes from each lit sample towards the sun. Above this
// text stand the numbers of the recipe and the published lookups (live_glsl.h).
uniform highp sampler3D cloud_table, cells_table, share_table;
uniform float extinction_factor, view_step, sun_step, reach;
uniform int sun_samples;
uniform bool repeats;

const int OCTAVES = 8;
const float OPAQUE = 0.0009765625;
const vec4 FULL_LEAP = vec4(255.0, 0.0, 0.0, 0.0);

int fetches = 0;

// Droplets of 12 um: Henyey-Greenstein's and Draine's functions (Jendersie and d'Eon 2023). Light that is
// scattered n more times sees them wider by 2^-n (Wrenninge et al. 2013). u is 1 - cosine.
float henyey_greenstein(float g, float u) {
    float b = (1.0 - g) * (1.0 - g) + 2.0 * g * u;
    return (1.0 - g * g) / (4.0 * PI * b * sqrt(b));
}
float droplets(float u, float wide) {
    float g = DROPLETS.y * wide, alpha = DROPLETS.z * wide, c = 1.0 - u;
    float draine = henyey_greenstein(g, u) * (1.0 + alpha * c * c) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
    return mix(henyey_greenstein(DROPLETS.x * wide, u), draine, DROPLETS.w);
}

bool within(vec3 p) {
    return p.z >= 0.0 && p.z <= TILE.z &&
           (repeats || all(greaterThanEqual(p.xy, vec2(0.0))) && all(lessThan(p.xy, TILE.xy)));
}

// The extinction at p, in 1/m, with p counted from the tile's lower corner.
float extinction_at(vec3 p) {
    ++fetches;
    return EXTINCTION * extinction_factor * density_of(cloud_density(cloud_table, p, TILE));
}

// The samples that certainly lie in empty cells, beginning with the one at p; 0 where there may be cloud.
float empty_samples(vec3 p, vec3 ray, float stride) {
    ++fetches;
    float way = cloud_leap(cloud_table, cells_table, CELL, FULL_LEAP, p, ray, TILE);
    return way > 0.0 ? max(floor(way / stride), 1.0) : 0.0;
}

// The optical depth from p towards the sun.
float depth_to_sun(vec3 p, float jitter) {
    float depth = 0.0;
    bool was_empty = false;
    for (int k = 0; k < sun_samples;) {
        vec3 at = p + sun * ((float(k) + jitter) * sun_step);
        if (!within(at)) break;
        float empty = was_empty ? empty_samples(at, sun, sun_step) : 0.0;
        if (empty == 0.0) {
            float sigma = extinction_at(at);
            depth += sigma * sun_step;
            was_empty = sigma == 0.0;
        }
        k += max(int(min(empty, 65536.0)), 1);
    }
    return depth;
}

// The distances at which a ray enters and leaves the layer, or its only tile; nowhere where x > y.
vec2 span_in_layer(vec3 from, vec3 ray) {
    vec2 span = vec2(0.0, reach);
    for (int a = repeats ? 2 : 0; a < 3; ++a) {
        if (abs(ray[a]) < 1e-7) {
            if (from[a] < 0.0 || from[a] > TILE[a]) return vec2(1.0, 0.0);
            continue;
        }
        vec2 faces = vec2(-from[a], TILE[a] - from[a]) / ray[a];
        span = vec2(max(span.x, min(faces.x, faces.y)), min(span.y, max(faces.x, faces.y)));
    }
    return span;
}

// Light as coefficients of its sources: the sun's at the base and at the top of the layer, the mean radiance of
// the sky and of the ground.
struct Clouds {
    vec4 sources;
    float through, distance;  // the distance is in metres
};

Clouds clouds_along(vec3 camera, vec3 ray, vec2 noise) {
    vec3 from = camera - vec3(0.0, 0.0, BASE);
    vec2 span = span_in_layer(from, ray);
    Clouds seen = Clouds(vec4(0.0), 1.0, 0.0);
    if (span.x > span.y) return seen;
    float octaves[OCTAVES], u = 0.5 * dot(ray - sun, ray - sun), weights = 0.0, bright = 1.0, wide = 1.0;
    for (int n = 0; n < OCTAVES; ++n) {
        octaves[n] = bright * droplets(u, wide);
        bright *= 0.7;
        wide *= 0.5;
    }
    float last = ceil(span.y / view_step) + 1.0, lit_k = -2.0;
    bool was_empty = true;
    vec4 light = vec4(0.0);
    for (float k = max(floor(span.x / view_step) - 1.0, 0.0); k < last && seen.through >= OPAQUE;) {
        float t = (k + noise.x) * view_step;
        vec3 p = from + ray * t;
        if (!within(p)) {
            k += 1.0;
            continue;
        }
        float empty = was_empty ? empty_samples(p, ray, view_step) : 0.0;
        if (empty > 0.0) {
            k += empty;
            continue;
        }
        float sigma = extinction_at(p);
        was_empty = sigma == 0.0;
        if (sigma > 0.0) {
            // Two samples in a row share their light.
            if (mod(k, 2.0) < 0.5 || lit_k + 1.0 != k) {
                lit_k = k;
                float depth = depth_to_sun(p, noise.y), sunlit = 0.0, height = p.z / TILE.z;
                for (int n = 0; n < OCTAVES; ++n, depth *= 0.5) sunlit += octaves[n] * exp(-depth);
                light = vec4(sunlit * (1.0 - height), sunlit * height,
                             0.5 * texture(share_table, p / TILE).rg);
            }
            float passed = exp(-sigma * view_step), weight = seen.through * (1.0 - passed);
            seen.sources += weight * light;
            seen.distance += weight * t;
            weights += weight;
            seen.through *= passed;
        }
        k += 1.0;
    }
    seen.distance /= max(weights, 1e-9);
    return seen;
}

// The share of sunlight that the clouds let through to the ground at x and y.
float lit_ground(vec2 place) {
    if (sun.z <= 0.0) return 1.0;
    vec3 p = vec3(place, -BASE) + sun * (BASE / sun.z);                    // where the ray enters the layer
    return exp(-depth_to_sun(p + sun * 1e-3 * TILE.z, 0.5));
}
