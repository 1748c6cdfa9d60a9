// The air of recipe.toml, marched by its two tables (Hillaire 2020): sky, ground, the sun's disc, and what
// the air adds and takes up to some distance. The camera is h km above the ground, z is up, and light is
// per unit of solar irradiance. transmittance_table and multiple_scattering_table are the textures.
//
// `skybake show recipe.toml atmosphere` prints these numbers. Coefficients are per km.
const float R = 6360.0, D = 100.0, ALBEDO = 0.3, PI = 3.14159265;
const vec3 RAYLEIGH = vec3(5.802e-3, 1.3558e-2, 3.31e-2), OZONE = vec3(6.5e-4, 1.881e-3, 8.5e-5);
const float MIE = 3.996e-3, MIE_EXTINCTION = 4.44e-3, MIE_G = 0.8;
const int SKY_STEPS = 40;
// Legendre moments of the two phase functions below, as examples/lookups/moments.glsl takes them.
const vec3 RAYLEIGH_MOMENTS = vec3(1.0, 0.0, 0.1), MIE_MOMENTS = vec3(1.0, 0.8436, 0.7097);

// Rayleigh's phase function, and that of Cornette and Shanks, in 1/sr.
float rayleigh_phase(float nu) { return 0.0596831037 * (1.0 + nu * nu); }
float mie_phase(float nu, float g) {
    float b = 1.0 + g * g - 2.0 * g * nu;
    return 0.119366207 * (1.0 - g * g) / (2.0 + g * g) * (1.0 + nu * nu) / (b * sqrt(b));
}

// Sunlight at an altitude; s is the radius times the cosine of the sun's zenith angle there.
vec3 sunlight(float h, float s) {
    if (s < -sqrt(h * (2.0 * R + h))) return vec3(0.0);                     // the planet hides it
    return baked_transmittance(transmittance_table, h, s / (R + h));
}

// The mean radiance of the sky there. The table has that of all directions, half of which are ground.
vec3 skylight(float h, float s) {
    vec3 sun = max(s / (R + h), 0.0) * sunlight(h, s) / PI;
    vec3 mean = baked_multiple_scattering(multiple_scattering_table, h, s / (R + h), 0);
    return max(2.0 * mean - ALBEDO * sun, 0.0) / (1.0 + ALBEDO);
}

vec3 ground(float s) { return ALBEDO * (max(s / R, 0.0) * sunlight(0.0, s) / PI + skylight(0.0, s)); }

// What a km of air scatters again towards the eye. mu is the cosine of the view's zenith angle there, sun_mu
// that of the sun's, and nu that of the angle between them.
vec3 scattered_air(float h, vec2 density, float mu, float sun_mu, float nu) {
    float sines = sqrt(max((1.0 - mu * mu) * (1.0 - sun_mu * sun_mu), 0.0)), along = nu - mu * sun_mu;
    float c = abs(along) < sines ? along / sines : sign(along);             // a vertical has no azimuth
    return density.x * RAYLEIGH * baked_multiple_scattering_scattered(multiple_scattering_table, h, sun_mu, mu, c, RAYLEIGH_MOMENTS)
         + density.y * MIE * baked_multiple_scattering_scattered(multiple_scattering_table, h, sun_mu, mu, c, MIE_MOMENTS);
}

struct Air { vec3 light, through; };

// Along `ray` as far as `reach` km, or to its end at the ground or at the top, where through is the share
// of light that comes from there. Segments are short where the air is dense.
Air air_along(float h, vec3 ray, vec3 sun, float reach, int steps) {
    float r = R + h, s = r * ray.z, rho2 = h * (R + r), rise = (D - h) * (R + D + r), nu = dot(ray, sun);
    bool falls = s < -sqrt(rho2);
    float end = falls ? rho2 / (sqrt(s * s - rho2) - s) : sqrt(s * s + rise) - s;
    float densest = min(falls ? end : max(-s, 0.0), reach);
    float begin = -sqrt(densest), range = sqrt(min(end, reach) - densest) - begin;
    vec3 rayleigh = RAYLEIGH * rayleigh_phase(nu);
    float mie = MIE * mie_phase(nu, MIE_G), from = begin * abs(begin);
    Air air = Air(vec3(0.0), vec3(1.0));
    for (int i = 1; i <= steps; ++i) {
        float y = begin + range * float(i) / float(steps), to = y * abs(y), width = to - from;
        float t = densest + 0.5 * (from + to), q = t * (t + 2.0 * s);
        float altitude = clamp(h + q / (sqrt(r * r + q) + r), 0.0, D), sun_s = r * sun.z + t * nu;
        vec2 density = exp(-altitude / vec2(8.0, 1.2));
        vec3 extinction = density.x * RAYLEIGH + density.y * MIE_EXTINCTION +
                          max(1.0 - abs(altitude - 25.0) / 15.0, 0.0) * OZONE;
        vec3 source = (density.x * rayleigh + density.y * mie) * sunlight(altitude, sun_s) +
                      scattered_air(altitude, density, (s + t) / (R + altitude), sun_s / (R + altitude), nu);
        vec3 passed = exp(-extinction * width);
        air.light += air.through * source * (1.0 - passed) / extinction;
        air.through *= passed;
        from = to;
    }
    return air;
}

// Returns the light that the camera sees where there is no cloud.
vec3 sky(float h, vec3 ray, vec3 sun) {
    float s = (R + h) * ray.z, rho2 = h * (2.0 * R + h);
    Air air = air_along(h, ray, sun, 1e9, SKY_STEPS);
    if (s < -sqrt(rho2)) {
        float end = rho2 / (sqrt(s * s - rho2) - s);
        return air.light + air.through * ground((R + h) * sun.z + end * dot(ray, sun));
    }
    const float SUN = 4.653e-3;                                             // the disc's radius
    return air.light + (length(ray - sun) < SUN ? air.through / (PI * SUN * SUN) : vec3(0.0));
}
