// How `skybake preview` shows light by its default curve, film; bakers/render/tone_curve.h says why it is
// this one. Light is linear sRGB, and daylight is white in it; it is multiplied by the exposure before.

// Colours near the border of what a screen shows, and beyond it, are drawn within it. `apart` is how far a
// channel lies below the greatest one, as a share of that.
float within_border(float apart, float threshold, float limit) {
    if (apart <= threshold) return apart;
    float reach = limit - threshold;
    float scale = reach / pow(pow((1.0 - threshold) / reach, -1.2) - 1.0, 1.0 / 1.2);
    float x = (apart - threshold) / scale;
    return threshold + scale * x / pow(1.0 + pow(x, 1.2), 1.0 / 1.2);
}
vec3 in_gamut(vec3 light) {
    float greatest = max(max(light.x, light.y), light.z);
    if (greatest <= 0.0) return vec3(0.0);
    vec3 apart = (vec3(greatest) - light) / greatest;
    return greatest * max(1.0 - vec3(within_border(apart.x, 0.815, 1.147), within_border(apart.y, 0.803, 1.264),
                                     within_border(apart.z, 0.880, 1.312)), vec3(0.0));
}

// Returns grey light as the curve shows it: a toe, a straight part from 0.22 to 0.532, and a shoulder.
float film_of_grey(float light) {
    if (light >= 0.532) return 1.0 - 0.468 * exp((0.532 - light) / 0.468);
    float place = min(light / 0.22, 1.0);
    return mix(0.22 * pow(place, 1.33), light, place * place * (3.0 - 2.0 * place));
}
// Returns light within the gamut. The greatest channel has the curve, and the others keep their ratios to
// it, for the most part.
vec3 film(vec3 light) {
    float greatest = max(max(light.x, light.y), light.z);
    if (greatest <= 0.0) return vec3(0.0);
    float bright = film_of_grey(greatest), white = 1.0 - 1.0 / (1.0 + 0.15 * (greatest - bright));
    vec3 kept = bright * mix(light / greatest, vec3(1.0), vec3(white));
    return mix(kept, vec3(film_of_grey(light.x), film_of_grey(light.y), film_of_grey(light.z)), vec3(0.15));
}

// The transfer function of sRGB, for a linear value in [0, 1].
float srgb_of_linear(float linear_value) {
    if (linear_value <= 0.0031308) return 12.92 * linear_value;
    return 1.055 * pow(linear_value, 1.0 / 2.4) - 0.055;
}
vec3 srgb_of(vec3 shown) {
    vec3 x = clamp(shown, vec3(0.0), vec3(1.0));
    return vec3(srgb_of_linear(x.x), srgb_of_linear(x.y), srgb_of_linear(x.z));
}
