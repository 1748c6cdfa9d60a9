// The air, marched by its two tables as bakers/render/sky_view.h describes. The camera is h km above the ground,
// z is up, and light is per unit of solar irradiance, in the channels of the tables. Above this text stand the
// numbers of the recipe and the lookups of the tables (live_glsl.h).
uniform highp sampler2D phase_table;
uniform vec3 sun;

const float PI = 3.14159265;
const int SKY_STEPS = 40;
const int CLOUD_AIR_STEPS = 4;                                              // between the camera and a cloud

// Sunlight at an altitude; s is the radius times the cosine of the sun's zenith angle there.
Light sunlight(float h, float s) {
    if (s < -sqrt(h * (2.0 * R + h))) return Light(0.0);                    // the planet hides it
    return sun_through(h, s / (R + h));
}

// What a km of air scatters again towards the eye, whose direction has the cosine mu of its zenith angle and nu of its
// angle to the sun (scattered_again of bakers/render/sky_march.cpp). `scattering` are the air's coefficients times the
// moments of its phase functions.
Light scattered_again(float h, float s, float mu, float nu, Light scattering[DEGREE + 1]) {
    float sun_mu = clamp(s / (R + h), -1.0, 1.0), view_mu = clamp(mu, -1.0, 1.0);
    float sine = sqrt((1.0 - view_mu) * (1.0 + view_mu)), sines = sine * sqrt((1.0 - sun_mu) * (1.0 + sun_mu));
    float along = nu - view_mu * sun_mu;
    float azimuth_cosine = abs(along) < sines ? along / sines : along < 0.0 ? -1.0 : 1.0;
    Light sum = Light(0.0);
    float last = 1.0, before = azimuth_cosine, sectoral = 1.0;                  // cos(m phi), P_m^m
    for (int m = 0; m <= DEGREE; ++m) {
        float lower = 0.0, harmonic = sectoral;                                 // P_l^m
        for (int l = m; l <= DEGREE; ++l) {
            sum += scattering[l] * (harmonic * last) * light_moment(h, sun_mu, l * (l + 1) / 2 + m);
            float higher = (float(2 * l + 1) * view_mu * harmonic - float(l + m) * lower) / float(l + 1 - m);
            lower = harmonic;
            harmonic = higher;
        }
        sectoral *= sine * float(2 * m + 1);
        float next = 2.0 * azimuth_cosine * last - before;
        before = last;
        last = next;
    }
    return sum;
}

// The radiance of the ground.
Light ground_light(float s) {
    Light direct = max(s / R, 0.0) * sunlight(0.0, s) / PI;
    Light from_sky = max(2.0 * light_moment(0.0, s / R, 0) - ALBEDO * direct, 0.0) / (1.0 + ALBEDO);
    return ALBEDO * (direct + from_sky);
}

// The phase functions of all layers between a ray and the sun. The table is read between two texels.
void find_phases(vec3 ray, out Light phases[LAYERS]) {
    float x = phase_by_peaks(half_angle(ray, sun)) * float(textureSize(phase_table, 0).x - 1);
    int low = int(min(x, float(textureSize(phase_table, 0).x - 2)));
    for (int i = 0; i < LAYERS; ++i) {
        phases[i] = Light(mix(texelFetch(phase_table, ivec2(low, i), 0),
                              texelFetch(phase_table, ivec2(low + 1, i), 0), x - float(low)));
    }
}

// (1 - exp(-x)) / x; the series is for what the difference would round away.
Light mean_through(Light x, Light through) {
    Light series = 1.0 + x * (-0.5 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0))));
    return mix((1.0 - through) / max(x, Light(0.1)), series, step(x, Light(0.1)));
}

struct Air {
    Light light, through;
    float end;      // km, where the ray ends at the ground or at the top of the air
    bool grounded;  // it ends at the ground
};

// Along `ray` to its end, without the light of the ground. Segments are short where the air is dense.
Air air_along(float h, vec3 ray) {
    float r = R + h, s = r * ray.z, rho2 = h * (R + r), rise = (D - h) * (R + D + r), nu = dot(ray, sun);
    bool falls = s < -sqrt(rho2);
    float root = sqrt(s * s + rise);
    float end = falls ? rho2 / (sqrt(max(s * s - rho2, 0.0)) - s) : s > 0.0 ? rise / (root + s) : root - s;
    float densest = falls ? end : max(-s, 0.0);
    Air air = Air(Light(0.0), Light(1.0), end, falls);
    Light phases[LAYERS];
    find_phases(ray, phases);
    float begin = -sqrt(densest), range = sqrt(max(end - densest, 0.0)) - begin, from = -densest;
    for (int i = 1; i <= SKY_STEPS; ++i) {
        float y = begin + range * float(i) / float(SKY_STEPS), to = y * abs(y), width = to - from;
        float t = densest + 0.5 * (from + to), q = t * (t + 2.0 * s);
        float altitude = clamp(h + q / (sqrt(max(r * r + q, 0.0)) + r), 0.0, D), sun_s = r * sun.z + t * nu;
        Light extinction = Light(0.0), to_eye = Light(0.0), scattering[DEGREE + 1];
        for (int l = 0; l <= DEGREE; ++l) scattering[l] = Light(0.0);
        for (int layer = 0; layer < LAYERS; ++layer) {
            float density = density_at(layer, altitude);
            extinction += density * EXTINCTION_OF_AIR[layer];
            to_eye += density * SCATTERING[layer * (DEGREE + 1)] * phases[layer];
            for (int l = 0; l <= DEGREE; ++l) scattering[l] += density * SCATTERING[layer * (DEGREE + 1) + l];
        }
        Light depth = extinction * width, passed = exp(-depth);
        Light again = scattered_again(altitude, sun_s, (s + t) / (R + altitude), nu, scattering);
        Light source = to_eye * sunlight(altitude, sun_s) + again;
        air.light += air.through * source * width * mean_through(depth, passed);
        air.through *= passed;
        from = to;
    }
    return air;
}

// Returns the share of light that the air lets through from `reach` km away, by Simpson's rule.
Light through_air(float h, vec3 ray, float reach) {
    float r = R + h, s = r * ray.z, width = reach / float(CLOUD_AIR_STEPS);
    Light depth = Light(0.0);
    for (int i = 0; i <= 2 * CLOUD_AIR_STEPS; ++i) {
        float t = 0.5 * float(i) * width, q = t * (t + 2.0 * s);
        float altitude = clamp(h + q / (sqrt(max(r * r + q, 0.0)) + r), 0.0, D);
        float share = i == 0 || i == 2 * CLOUD_AIR_STEPS ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        for (int layer = 0; layer < LAYERS; ++layer) {
            depth += share * density_at(layer, altitude) * EXTINCTION_OF_AIR[layer];
        }
    }
    return exp(-depth * width / 6.0);
}

// The sun's disc (bakers/render/sun_disc.h), for sunlight `seen`. `wide` is at least the angle of a pixel, so that the
// disc has no jagged edge.
const float SUN = 4.651e-3;                                                 // the disc's radius
Light sun_disc(vec3 ray, Light seen, float wide) {
    float angle = length(ray - sun);
    float inside = 1.0 - smoothstep(SUN - 0.5 * wide, SUN + 0.5 * wide, angle);
    float mu = sqrt(max(1.0 - angle * angle / (SUN * SUN), 0.0));
    Light disc = inside / (PI * SUN * SUN) * (1.0 + 0.5 * LIMB) * pow(Light(max(mu, 0.05)), LIMB);
    return seen * disc;
}

// Returns the sunlight that a lens scatters, in 1/sr.
float lens_veil(vec3 ray) {
    float cosine = max(dot(ray, sun), 0.0), sine = length(cross(ray, sun));
    return 0.01 / (PI * log(1.0 + 1.0 / (SUN * SUN))) * cosine / (sine * sine + SUN * SUN);
}
