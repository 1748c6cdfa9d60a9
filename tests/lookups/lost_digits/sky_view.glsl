// The lookup that was published once, and fails: angles by asin and acos. The tests show
// that they would notice.
const float R = 6360.0, T = 6460.0, PI = 3.14159265;    // km
float texel_centres(float x, float size) { return 0.5 / size + x * (1.0 - 1.0 / size); }

float dip(float radius, float h) { return 2.0 * asin(sqrt(h / (2.0 * (radius + h)))); }

// h: the camera's altitude; sun k of n in the file; size: of one sun's table, in texels
vec3 sky_view(sampler2D table, float h, vec3 dir, vec3 up, vec3 sun, float k, float n, vec2 size) {
    float horizon = dip(R, h);                                         // below the horizontal
    float l = asin(clamp(dot(dir, up), -1.0, 1.0)) + horizon;          // angle above the horizon
    float above = h < T - R ? PI / 2.0 + horizon : horizon - dip(T, h - (T - R));
    float below = PI / 2.0 - horizon;
    if (l > above) return vec3(0.0);                                   // from space, beyond the air
    float y = l < 0.0 ? 0.5 - 0.5 * sqrt(-l / below) : 0.5 + 0.5 * sqrt(l / above);
    float v = texel_centres(y, size.y), half_rows = floor(size.y / 2.0);
    v = l < 0.0 ? min(v, (half_rows - 0.5) / size.y) : max(v, (half_rows + 0.5) / size.y);
    vec3 a = dir - up * dot(dir, up), b = sun - up * dot(sun, up);     // azimuths; any at the zenith
    float c = dot(a, b) / max(length(a) * length(b), 1e-6);
    float x = acos(clamp(c, -1.0, 1.0)) / PI;
    return texture(table, vec2(texel_centres(x, size.x), (k + v) / n)).rgb;
}
