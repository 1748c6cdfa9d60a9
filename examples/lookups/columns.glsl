// Lookups of tables of columns (asset = "optical_depth"). Use a clamped, linear sampler. A lookup of columns
// returns, with one channel per kind of particles, the integral of the density along the path in km, so that
//
//   transmittance = exp(-sum over kinds of extinction_k * column_k)
//
// Altitudes h are from 0 to D, all lengths in km; mu is the cosine of the zenith angle, s = (R + h) * mu.
// `size` are the texels of the table.
struct ColumnShell {
    float R;        // the ground's radius
    float D;        // the thickness of the air
    float fine;     // `fine_km` of the manifest: up to there the altitudes' axis is as sqrt(h)
};

// g of the manifest, from 0 on the ground to 1 at the top. Near the ground 1 + x keeps no digits of x, and
// a GPU's logarithm of 1 may be below 0.
float column_altitude(ColumnShell air, float h) {
    float x = max(h, 0.0) / air.fine;
    float depth = x < 0.03 ? x * (1.0 - x * (0.5 - x / 3.0)) : log(1.0 + x);
    return sqrt(depth / log(1.0 + air.D / air.fine));
}
float column_share(float a, float b) { return b > 0.0 ? clamp(a / b, 0.0, 1.0) : 0.0; }
float column_centre(float x, float size) { return clamp(x, 0.0, 1.0) * (1.0 - 1.0 / size) + 0.5 / size; }
// Paths of a course (they rise, pass their lowest point or fall) have texels of their own along u.
float column_course(float x, float first, float count, float size) {
    return clamp(x, 0.0, 1.0) * ((count - 1.0) / size) + (first + 0.5) / size;
}
// x of a path that rises by `gain` over a distance of d.
float column_rise(ColumnShell air, float h, float gain, float d) {
    float level = sqrt(gain * (2.0 * (air.R + h) + gain));
    return 1.0 - sqrt(1.0 - column_share(d - gain, level - gain));
}
// The lowest altitude of a path with s < 0; in float it is right to a centimetre on Earth.
float column_lowest(ColumnShell air, float h, float s) {
    float r = air.R + h;
    return max(h - s * s / (r + sqrt((r - s) * (r + s))), 0.0);
}
vec4 column_of(vec4 t, float d) { t *= t; t *= t; return t * t * d; }

// table = "to_top". The ray must not meet the ground.
// Cost: fetches 1, operations 90, divisions 4, special functions 9
vec4 column_to_top(sampler2D table, vec2 size, ColumnShell air, float h, float mu) {
    float r = air.R + h, s = r * mu, gain = air.D - h, q = gain * (2.0 * r + gain);
    float root = sqrt(s * s + q), d = s > 0.0 ? q / (root + s) : root - s, g = column_altitude(air, h);
    float passes = float(int(size.x) / 2), rises = size.x - passes;
    float low = s < 0.0 ? column_altitude(air, column_lowest(air, h, s)) : 0.0;
    float u = s < 0.0 ? column_course(sqrt(1.0 - column_share(low, g)), rises, passes, size.x)
                      : column_course(column_rise(air, h, gain, d), 0.0, rises, size.x);
    return column_of(texture(table, vec2(u, column_centre(g, size.y))), d);
}

// table = "between" with coordinates = "altitudes": two points at altitudes ha and hb, d apart. The path
// must not enter the ground.
// Cost: fetches 1, operations 107, divisions 5, special functions 10
vec4 column_between(sampler3D table, vec3 size, ColumnShell air, float ha, float hb, float d) {
    float low = min(ha, hb), gain = max(ha, hb) - low, r = air.R + low;
    float s = d > 0.0 ? 0.5 * (gain * ((gain + 2.0 * r) / d) - d) : r;      // at the lower point
    float g_low = column_altitude(air, low), g_high = column_altitude(air, low + gain);
    float passes = float(int(size.x) / 2), rises = size.x - passes;
    float lowest = s < 0.0 ? column_altitude(air, column_lowest(air, low, s)) : 0.0;
    float u = s < 0.0 ? column_course(sqrt(1.0 - column_share(lowest, g_low)), rises, passes, size.x)
                      : column_course(column_rise(air, low, gain, d), 0.0, rises, size.x);
    vec3 place = vec3(u, column_centre(g_high, size.y), column_centre(column_share(g_low, g_high), size.z));
    return column_of(texture(table, place), d);
}

// table = "between" with coordinates = "distance": from the altitude h over a distance of d along a ray.
// Cost: fetches 1, operations 159, divisions 10, special functions 19
vec4 column_along(sampler3D table, vec3 size, ColumnShell air, float h, float mu, float d) {
    float r = air.R + h, s = r * mu, q = d * (d + 2.0 * s), rho = sqrt(h * (2.0 * air.R + h));
    float end = column_altitude(air, clamp(h + q / (sqrt(max(r * r + q, 0.0)) + r), 0.0, air.D));
    float rises = float(int(size.x) / 4), passes = float(int(size.x) / 2);
    float g = column_altitude(air, h), u, w;
    // Rounding puts rays along the horizon on either side of it; within it they pass the ground.
    if (s + d <= 0.0 && s < -1.0000004 * rho) {
        float ground = rho * rho / (sqrt(max(s * s - rho * rho, 0.0)) - s);
        float x = column_share(rho - ground, rho - h);
        u = column_course(x, rises + passes, size.x - rises - passes, size.x);
        w = 1.0 - sqrt(column_share(end, g));
    } else if (s < 0.0) {
        float low = column_altitude(air, column_lowest(air, h, s)), from = -sqrt(max(g - low, 0.0));
        float to = sign(s + d) * sqrt(max(end - low, 0.0));
        u = column_course(sqrt(1.0 - column_share(low, g)), rises, passes, size.x);
        w = column_share(to - from, sqrt(1.0 - low) - from);
    } else {
        float gain = air.D - h, top = gain * (2.0 * r + gain);
        u = column_course(column_rise(air, h, gain, top / (sqrt(s * s + top) + s)), 0.0, rises, size.x);
        w = sqrt(column_share(end - g, 1.0 - g));
    }
    vec3 place = vec3(u, column_centre(g, size.y), column_centre(w, size.z));
    return column_of(texture(table, place), d);
}

// table = "density": of each kind, in shares of the density that its coefficients are for.
// Cost: fetches 1, operations 17, divisions 0, special functions 2
vec4 column_density(sampler2D table, float size, ColumnShell air, float h) {
    return texture(table, vec2(column_centre(column_altitude(air, h), size), 0.5));
}

// table = "phase": phase functions in 1/sr, of the angle between the unit vectors `a`, the view ray, and
// `b`, the direction to the sun.
// Cost: fetches 1, operations 21, divisions 0, special functions 4
vec4 column_phase(sampler2D table, float size, vec3 a, vec3 b) {
    float x = sqrt(atan(length(a - b), length(a + b)) * 0.636619772);       // 2 / pi
    return texture(table, vec2(column_centre(x, size), 0.5));
}
