// Linear light as a screen shows it (bakers/render/tone_curve.h): exposure, tone curve, sRGB, and a dither that
// hides the steps of bytes. Above this text stands examples/lookups/film.glsl. `fine` is the picture that is being made, done up to a row; `rough` lies behind it.
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

void main() {
    vec3 light = in_gamut(clamp(exposure * light_of(gl_FragCoord.xy), -1e6, 1e6));
    vec3 shown = curve == 0 ? film(light) : curve == 1 ? 1.0 - exp(-light) : curve == 2 ? aces(light) : agx(light);
    vec3 bytes = 255.0 * srgb_of(shown);
    uint lattice = uint(gl_FragCoord.x) * 3242174889u + uint(size.y - gl_FragCoord.y) * 2447445414u;
    uint folded = (lattice & 0x80000000u) != 0u ? ~lattice : lattice;
    float threshold = float(folded >> 7) / 16777216.0;
    color = vec4(floor(min(bytes + threshold, 255.0)) / 255.0, 1.0);
}
