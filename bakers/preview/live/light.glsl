// The light around layers of clouds, in four texels of a row for each: sunlight at its base and at its top, the mean
// radiance of the sky above it and of the ground below it. The last row has the irradiances of level ground under a
// clear sky, by the sun and by the sky. A pass before writes the radiance of 64 x 64 directions of each half of the
// sky side by side, a square of rows for each layer and one for the ground; this one sums them up.
uniform highp sampler2D radiance_table;
uniform float sky_share[CLOUDS], ground_share;                              // that other layers leave, of diffuse light
uniform bool sums;
out vec4 color;

const int DIRECTIONS = 64;

float altitude_of(int layer, bool is_top) {
    return layer == CLOUDS ? 0.0 : min((BASE[layer] + (is_top ? TILE[layer].z : 0.0)) * 1e-3, D);
}

Light radiance_of(ivec2 texel) {
    bool is_sky = texel.x < DIRECTIONS;
    float elevation = (float(texel.y % DIRECTIONS) + 0.5) / float(DIRECTIONS) * 0.5 * PI - (is_sky ? 0.0 : 0.5 * PI);
    float azimuth = (float(texel.x % DIRECTIONS) + 0.5) / float(DIRECTIONS) * 2.0 * PI;
    vec3 ray = vec3(cos(elevation) * vec2(cos(azimuth), sin(azimuth)), sin(elevation));
    float h = altitude_of(texel.y / DIRECTIONS, is_sky);
    Air air = air_along(h, ray);
    if (!air.grounded) return air.light;
    return air.light + air.through * ground_light((R + h) * sun.z + air.end_km * dot(ray, sun));
}

// The mean over half of the sky; all directions weigh the same or, for an irradiance, by the sine of their elevation.
Light mean_radiance(int layer, bool is_sky, bool by_sine) {
    Light sum = Light(0.0);
    float weights = 0.0;
    for (int y = 0; y < DIRECTIONS; ++y) {
        float elevation = (float(y) + 0.5) / float(DIRECTIONS) * 0.5 * PI - (is_sky ? 0.0 : 0.5 * PI);
        float weight = cos(elevation) * (by_sine ? sin(elevation) : 1.0);
        for (int x = 0; x < DIRECTIONS; ++x) {
            ivec2 texel = ivec2(is_sky ? x : x + DIRECTIONS, layer * DIRECTIONS + y);
            sum += weight * Light(texelFetch(radiance_table, texel, 0));
            weights += weight;
        }
    }
    return sum / weights;
}

Light light_of_row(ivec2 texel) {
    if (texel.y == CLOUDS) {
        if (texel.x == 0) return max(sun.z, 0.0) * sunlight(0.0, R * sun.z);
        return texel.x == 1 ? PI * mean_radiance(CLOUDS, true, true) : Light(0.0);
    }
    float h = altitude_of(texel.y, texel.x == 1);
    if (texel.x < 2) return sunlight(h, (R + h) * sun.z);
    return mean_radiance(texel.y, texel.x == 2, false) * (texel.x == 2 ? sky_share[texel.y] : ground_share);
}

vec4 padded(vec3 light) { return vec4(light, 0.0); }
vec4 padded(vec4 light) { return light; }

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    color = padded(sums ? light_of_row(texel) : radiance_of(texel));
}
