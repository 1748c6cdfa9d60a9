// Lookups of tables of columns (asset = "optical_depth"). All tables: end points on texel centres,
// clamped. t = what a lookup of to_top and between returns, one channel a kind; column_k = t_k^8 * length, in km, and
//
//   transmittance = exp(-sum over kinds of extinction_k * column_k)
//
// R, D, F: the ground's radius, the thickness of the air and the altitude `fine` of the formula of
// the v axis, in the manifest. mu: cosine of the zenith angle; s = r mu; altitudes h in km. In single
// precision lowest() is right to 0.4 m on Earth: enough for fog of 100 m.
uniform float R, D, F;      // km
float g(float h) { return sqrt(log(1.0 + max(h, 0.0) / F) / log(1.0 + D / F)); }
float centre(float x, float size) { return 0.5 / size + clamp(x, 0.0, 1.0) * (1.0 - 1.0 / size); }
// texels of a course along u: first, count of `size`
float course_u(float x, float first, float count, float size) {
    return (first + 0.5 + clamp(x, 0.0, 1.0) * (count - 1.0)) / size;
}
float share(float a, float b) { return b > 0.0 ? clamp(a / b, 0.0, 1.0) : 0.0; }
float rise(float h, float gain, float d) {            // d: length of the way that climbs by `gain`
    float level = sqrt(gain * (2.0 * (R + h) + gain));
    return 1.0 - sqrt(1.0 - share(d - gain, level - gain));
}
float lowest(float h, float s) {                      // altitude nearest to the centre, s = r mu < 0
    float r = R + h;
    return max(h - s * s / (r + sqrt((r - s) * (r + s))), 0.0);
}
vec4 power8(vec4 t) { t *= t; t *= t; return t * t; }

// to_top, size W x H (256 x 128); the ray must not meet the ground. Returns columns in km.
vec4 column_to_top(sampler2D table, float h, float mu, vec2 size) {
    float r = R + h, s = r * mu, gain = D - h, q = gain * (2.0 * r + gain);
    float root = sqrt(s * s + q);
    float length = s > 0.0 ? q / (root + s) : root - s;
    float passes = floor(size.x / 2.0), rises = size.x - passes;
    float u = s < 0.0 ? course_u(sqrt(1.0 - share(g(lowest(h, s)), g(h))), rises, passes, size.x)
                      : course_u(rise(h, gain, length), 0.0, rises, size.x);
    return power8(texture(table, vec2(u, centre(g(h), size.y)))) * length;
}

// between by altitudes, size N (64^3): two altitudes and the angle between the points at the centre.
vec4 column_between(sampler3D table, float ha, float hb, float angle, vec3 size) {
    float low = min(ha, hb), gain = max(ha, hb) - low, r = R + low, k = sin(0.5 * angle);
    float d = sqrt(gain * gain + 4.0 * r * (r + gain) * k * k);
    float s = d > 0.0 ? 0.5 * (gain * (gain + 2.0 * r) / d - d) : r;      // at the lower point
    float passes = floor(size.x / 2.0), rises = size.x - passes;
    float u = s < 0.0 ? course_u(sqrt(1.0 - share(g(lowest(low, s)), g(low))), rises, passes, size.x)
                      : course_u(rise(low, gain, d), 0.0, rises, size.x);
    return power8(texture(table, vec3(u, centre(g(low + gain), size.y),
                                      centre(share(g(low), g(low + gain)), size.z)))) * d;
}

// between by distance: altitude, s = r mu, length along the ray. N/4 rises, N/2 passes, the rest falls.
vec4 column_along(sampler3D table, float h, float s, float d, vec3 size) {
    float r = R + h, q = d * (d + 2.0 * s), end = clamp(h + q / (sqrt(r * r + q) + r), 0.0, D);
    float rises = floor(size.x / 4.0), passes = floor(size.x / 2.0), rho = sqrt(h * (2.0 * R + h)), u, w;
    if (s + d <= 0.0 && s < -rho) {
        float ground = rho * rho / (-s + sqrt(max(s * s - rho * rho, 0.0)));
        u = course_u(share(rho - ground, rho - h), rises + passes, size.x - rises - passes, size.x);
        w = 1.0 - sqrt(share(g(end), g(h)));
    } else if (s < 0.0) {
        float low = g(lowest(h, s)), from = -sqrt(max(g(h) - low, 0.0));
        u = course_u(sqrt(1.0 - share(low, g(h))), rises, passes, size.x);
        w = share(sign(s + d) * sqrt(max(g(end) - low, 0.0)) - from, sqrt(1.0 - low) - from);
    } else {
        float gain = D - h, top = gain * (2.0 * r + gain);
        u = course_u(rise(h, gain, top / (sqrt(s * s + top) + s)), 0.0, rises, size.x);
        w = sqrt(share(g(end) - g(h), 1.0 - g(h)));
    }
    return power8(texture(table, vec3(u, centre(g(h), size.y), centre(w, size.z)))) * d;
}
// density: u = centre(g(h), N), the texel is the density itself; phase: u = centre(sqrt(angle / PI), N), 1/sr
