// Linear light as a screen shows it (bakers/render/tone_curve.h): exposure, tone curve, sRGB, and a dither that
// hides the steps of bytes. `fine` is the picture that is being made, done up to a row; `rough` lies behind it.
uniform highp sampler2D fine, rough;
uniform vec2 size;
uniform float exposure, rows_done;
uniform int curve;
out vec4 color;

vec3 light_of(vec2 pixel) {
    if (pixel.y >= size.y - rows_done) return texelFetch(fine, ivec2(pixel), 0).rgb;
    ivec2 last = textureSize(rough, 0) - 1;
    vec2 place = pixel / size * vec2(last + 1) - 0.5, low = floor(place), share = place - low;
    vec3 rows[2];
    for (int y = 0; y < 2; ++y) {
        ivec2 left = clamp(ivec2(low) + ivec2(0, y), ivec2(0), last), right = min(max(ivec2(low) + ivec2(1, y), ivec2(0)), last);
        rows[y] = mix(texelFetch(rough, left, 0).rgb, texelFetch(rough, right, 0).rgb, share.x);
    }
    return mix(rows[0], rows[1], share.y);
}

float film(float light) {
    if (light >= 0.532) return 1.0 - 0.468 * exp((0.532 - light) / 0.468);
    float place = min(light / 0.22, 1.0);
    return mix(0.22 * pow(place, 1.33), light, place * place * (3.0 - 2.0 * place));
}

vec3 film(vec3 light) {
    float greatest = max(max(light.r, light.g), light.b);
    if (greatest <= 0.0) return vec3(0.0);
    float bright = film(greatest);
    vec3 kept = bright * mix(light / greatest, vec3(1.0), 1.0 - 1.0 / (1.0 + 0.15 * (greatest - bright)));
    return mix(kept, vec3(film(light.r), film(light.g), film(light.b)), 0.15);
}

vec3 aces(vec3 light) {
    vec3 v = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777) * light;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602) * v;
}

vec3 agx(vec3 light) {
    vec3 stops = log2(max(mat3(0.842479062, 0.0423282423, 0.0423756549, 0.0784336, 0.878468636, 0.0784336,
                               0.0792237451, 0.0791661275, 0.879142974) * light, 1e-30));
    vec3 x = clamp((stops + 12.47393) / 16.500, 0.0, 1.0);
    vec3 y = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
    return pow(max(mat3(1.196879005, -0.0528968518, -0.0529716355, -0.0980208811, 1.15190313, -0.0980434501,
                        -0.0990297441, -0.0989611768, 1.15107367) * y, 0.0), vec3(2.2));
}

// Colours near the border of what a screen shows, and beyond it, are drawn within it.
vec3 in_gamut(vec3 light) {
    float greatest = max(max(light.r, light.g), light.b);
    if (greatest <= 0.0) return light;
    const vec3 THRESHOLD = vec3(0.815, 0.803, 0.880), LIMIT = vec3(1.147, 1.264, 1.312), POWER = vec3(1.2);
    vec3 apart = (greatest - light) / greatest, reach = LIMIT - THRESHOLD;
    vec3 scale = reach / pow(pow((1.0 - THRESHOLD) / reach, -POWER) - 1.0, 1.0 / POWER);
    vec3 x = max(apart - THRESHOLD, 0.0) / scale;
    vec3 bent = THRESHOLD + scale * x / pow(1.0 + pow(x, POWER), 1.0 / POWER);
    return greatest * (1.0 - mix(bent, apart, lessThanEqual(apart, THRESHOLD)));
}

void main() {
    vec3 light = max(in_gamut(clamp(exposure * light_of(gl_FragCoord.xy), -1e6, 1e6)), 0.0);
    vec3 shown = curve == 0 ? film(light) : curve == 1 ? 1.0 - exp(-light) : curve == 2 ? aces(light) : agx(light);
    shown = clamp(shown, 0.0, 1.0);
    vec3 bytes = 255.0 * mix(1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055, 12.92 * shown, lessThanEqual(shown, vec3(0.0031308)));
    uint lattice = uint(gl_FragCoord.x) * 3242174889u + uint(size.y - gl_FragCoord.y) * 2447445414u;
    uint folded = (lattice & 0x80000000u) != 0u ? ~lattice : lattice;
    float threshold = float(folded >> 7) / 16777216.0;
    color = vec4(floor(min(bytes + threshold, 255.0)) / 255.0, 1.0);
}
