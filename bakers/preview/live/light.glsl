// The light around a layer of clouds, in four texels: sunlight at its base and at its top, the mean radiance of the
// sky above it and of the ground below it. A pass before writes the radiance of 64 x 64 directions of each half
// of the sky side by side; this one sums them up.
uniform highp sampler2D radiance_table;
uniform float through_layer;                                                // of diffuse light
uniform bool sums;
out vec4 color;

const int DIRECTIONS = 64;

float altitude_of(bool is_top) { return min((BASE + (is_top ? TILE.z : 0.0)) * 1e-3, D); }

Light radiance_of(ivec2 texel) {
    bool is_sky = texel.x < DIRECTIONS;
    float elevation = (float(texel.y) + 0.5) / float(DIRECTIONS) * 0.5 * PI - (is_sky ? 0.0 : 0.5 * PI);
    float azimuth = (float(texel.x % DIRECTIONS) + 0.5) / float(DIRECTIONS) * 2.0 * PI;
    vec3 ray = vec3(cos(elevation) * vec2(cos(azimuth), sin(azimuth)), sin(elevation));
    float h = altitude_of(is_sky);
    Air air = air_along(h, ray);
    if (!air.grounded) return air.light;
    return air.light + air.through * ground_light((R + h) * sun.z + air.end * dot(ray, sun), 1.0);
}

Light mean_radiance(bool is_sky) {
    Light sum = Light(0.0);
    float weights = 0.0;
    for (int y = 0; y < DIRECTIONS; ++y) {
        float elevation = (float(y) + 0.5) / float(DIRECTIONS) * 0.5 * PI - (is_sky ? 0.0 : 0.5 * PI);
        for (int x = 0; x < DIRECTIONS; ++x) {
            sum += cos(elevation) * Light(texelFetch(radiance_table, ivec2(is_sky ? x : x + DIRECTIONS, y), 0));
            weights += cos(elevation);
        }
    }
    return sum / weights;
}

vec4 padded(vec3 light) { return vec4(light, 0.0); }
vec4 padded(vec4 light) { return light; }

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (!sums) {
        color = padded(radiance_of(texel));
        return;
    }
    float h = altitude_of(texel.x == 1);
    color = padded(texel.x < 2 ? sunlight(h, (R + h) * sun.z)
                               : mean_radiance(texel.x == 2) * (texel.x == 3 ? through_layer : 1.0));
}
