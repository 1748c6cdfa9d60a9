// Lookup of asset = "sky_view": radiance in 1/sr for a solar irradiance of 1. Use a clamped, bilinear sampler.
//
// R is the ground's radius, D the thickness of the air, h the altitude of the table's camera, all in km.
// The unit vectors `dir`, `up` and `sun` point along the view ray, away from the planet's centre and to
// the sun. The file holds the tables of n suns below each other; this one is the k-th from 0 on. `size` are
// the texels of one of them.
// Angles come from atan(y, x): asin and acos are wrong by 4e-4 on some GPUs, 12 % of the radiance.
// Cost: fetches 1, operations 74, divisions 0, special functions 6
vec4 sky_view_of_4(sampler2D table, vec2 size, float R, float D, float h, vec3 dir, vec3 up, vec3 sun,
                   int k, int n) {                                 // of four wavelengths
    const float PI = 3.14159265;
    float cd = R / (R + h), sd = sqrt(h * (2.0 * R + h)) / (R + h);    // of the horizon's dip
    float mu = dot(dir, up), level = length(dir - up * mu);
    float l = atan(mu * cd + level * sd, level * cd - mu * sd);        // the angle above the horizon
    float above = 0.5 * PI + atan(sd, cd), below = atan(cd, sd);       // its ranges
    if (h >= D) {                                                      // from space: the edge of the air
        float ce = (R + D) / (R + h), se = sqrt((h - D) * (2.0 * R + D + h)) / (R + h);
        above = atan(sd * ce - cd * se, cd * ce + sd * se);
        if (l > above) return vec4(0.0);
    }
    vec3 a = dir - up * mu, b = sun - up * dot(sun, up);               // their azimuths
    float across = length(cross(a, b)), along = dot(a, b);
    float x = across > 0.0 || along < 0.0 ? atan(across, along) / PI : 0.0;    // any at the zenith
    float y = l < 0.0 ? 0.5 - 0.5 * sqrt(-l / below) : 0.5 + 0.5 * sqrt(l / above);
    vec2 uv = vec2(x, min(y, 1.0)) * (1.0 - 1.0 / size) + 0.5 / size;
    float horizon = float(int(size.y) / 2) / size.y, texel = 0.5 / size.y;  // sky and ground do not mix
    uv.y = l < 0.0 ? min(uv.y, horizon - texel) : max(uv.y, horizon + texel);
    return texture(table, vec2(uv.x, (float(k) + uv.y) / float(n)));
}

vec3 sky_view(sampler2D table, vec2 size, float R, float D, float h, vec3 dir, vec3 up, vec3 sun, int k,
              int n) {
    return vec3(sky_view_of_4(table, size, R, D, h, dir, up, sun, k, n));
}
