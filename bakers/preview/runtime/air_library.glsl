// The air, marched by its tables. The camera is h km above the ground, and z is up; s is the radius in km times the
// cosine of the sun's zenith angle. Light is radiance for a sun whose irradiance outside the air is 1, in the
// channels of the tables.

// The closed phase functions (a + b nu^2) / (1 + g^2 - 2 g nu)^(3/2) in 1/sr, where nu = `back` - 1 = 1 - `ahead` is
// the cosine of the angle between a ray and the sun.
float air_phase(float a, float b, float g, float ahead, float back) {
    float apart = (1.0 - abs(g)) * (1.0 - abs(g)) + 2.0 * abs(g) * (g < 0.0 ? back : ahead), nu = 0.5 * (back - ahead);
    return (a + b * nu * nu) / (apart * sqrt(apart));
}

// (1 - exp(-x)) / x; the series is for values that the difference would round away.
float air_mean_through_of(float x, float through) {
    if (x > 0.1) return (1.0 - through) / x;
    return 1.0 + x * (-0.5 + x * (0.166666667 + x * (-0.0416666667 + x * 0.00833333333)));
}

AIR_OF_RECIPE

// Sunlight at an altitude.
Light air_sunlight(sampler2D SUN_TABLE, float h, float s) {
    float radius = baked_ground_radius_km();
    if (s < -sqrt(h * (2.0 * radius + h))) return Light(0.0);               // the planet hides it
    return air_sun_through(SUN_TABLE, h, s / (radius + h));
}

// The mean radiance of the sky at an altitude. The table has that of all directions, half of which are ground.
Light air_skylight(sampler2D SUN_TABLE, sampler2D LIGHT_TABLE, float h, float s) {
    float sun_mu = s / (baked_ground_radius_km() + h);
    Light direct = max(sun_mu, 0.0) * air_sunlight(SUN_TABLE, h, s) * 0.318309886;
    return max(2.0 * air_mean_light(LIGHT_TABLE, h, sun_mu) - air_ground_albedo() * direct, 0.0) / (1.0 + air_ground_albedo());
}

// The radiance of the ground.
Light air_ground_light(sampler2D SUN_TABLE, sampler2D LIGHT_TABLE, float s) {
    Light direct = max(s / baked_ground_radius_km(), 0.0) * air_sunlight(SUN_TABLE, 0.0, s) * 0.318309886;
    return air_ground_albedo() * (direct + air_skylight(SUN_TABLE, LIGHT_TABLE, 0.0, s));
}

struct Air {
    Light light;
    Light through;  // the share of light that comes from the ray's end
    float end_km;   // where the ray ends: at the ground, at the top of the air, or where it was told to
    bool grounded;  // it ends at the ground
};

// The distances in km to the ray's densest point and to its end, and 1 if that is at the ground, else 0.
vec3 air_span(float h, float mu) {
    float radius = baked_ground_radius_km(), top = baked_air_thickness_km(), r = radius + h, s = r * mu;
    float below = h * (radius + r), above = (top - h) * (radius + top + r), root = sqrt(max(s * s + above, 0.0));
    if (s < -sqrt(below)) {
        float end = below / (sqrt(max(s * s - below, 0.0)) - s);
        return vec3(end, end, 1.0);
    }
    return vec3(max(-s, 0.0), s > 0.0 ? above / (root + s) : root - s, 0.0);
}

// Along `ray` to its end, or as far as `reach` km. Segments are short where the air is dense.
Air air_along(TABLES, float h, vec3 ray, vec3 sun, float reach, int steps) {
    float radius = baked_ground_radius_km(), r = radius + h, s = r * ray.z, nu = dot(ray, sun);
    vec3 span = air_span(h, ray.z);
    Air air;
    air.light = Light(0.0);
    air.through = Light(1.0);
    air.end_km = min(span.y, reach);
    air.grounded = span.z > 0.5 && span.y <= reach;
    float densest = min(span.x, air.end_km), begin = -sqrt(densest), range = sqrt(max(air.end_km - densest, 0.0)) - begin;
    float last = -densest, i = 1.0;
    AirPhases phases = air_phases(PHASES_GIVEN ray, sun);
    while (i <= float(steps)) {
        float y = begin + range * i / float(steps), next = y * abs(y), width = next - last;
        float t = densest + 0.5 * (last + next), q = t * (t + 2.0 * s);
        float altitude = clamp(h + q / (sqrt(max(r * r + q, 0.0)) + r), 0.0, baked_air_thickness_km());
        float sun_s = r * sun.z + t * nu;
        AirPoint here = air_at(altitude, phases);
        Light depth = here.extinction * width, passed = exp(-depth);
        Light source = here.to_eye * air_sunlight(SUN_TABLE, altitude, sun_s) +
                       air_scattered_again(LIGHT_TABLE, here, altitude, sun_s ANGLES);
        air.light += air.through * source * width * air_mean_through(depth, passed);
        air.through *= passed;
        last = next;
        i += 1.0;
    }
    return air;
}

// The share of light that the air lets through from `reach` km away, by Simpson's rule.
Light air_through(float h, vec3 ray, float reach, int steps) {
    float r = baked_ground_radius_km() + h, s = r * ray.z, width = reach / float(steps), i = 0.0;
    Light depth = Light(0.0);
    while (i <= 2.0 * float(steps)) {
        float t = 0.5 * i * width, q = t * (t + 2.0 * s);
        float altitude = clamp(h + q / (sqrt(max(r * r + q, 0.0)) + r), 0.0, baked_air_thickness_km());
        float share = i - 2.0 * floor(0.5 * i) > 0.5 ? 4.0 : 2.0;
        if (i < 0.5 || i > 2.0 * float(steps) - 0.5) share = 1.0;
        depth += share * air_extinction(altitude);
        i += 1.0;
    }
    return exp(-depth * width / 6.0);
}

// The sun's disc, darker towards its limb, for sunlight `seen` at the camera. Its edge is as soft as a pixel of
// `pixel` radians.
Light air_sun_disc(vec3 ray, vec3 sun, Light seen, float pixel) {
    float radius = 0.004651, angle = length(ray - sun), soft = max(pixel, 0.00001);
    float x = clamp((radius + 0.5 * soft - angle) / soft, 0.0, 1.0);
    if (x <= 0.0) return Light(0.0);
    float mu = sqrt(max(1.0 - angle * angle / (radius * radius), 0.0));
    Light limb = (1.0 + 0.5 * air_sun_limb()) * pow(Light(max(mu, 0.05)), air_sun_limb());
    return seen * limb * (x * x * (3.0 - 2.0 * x) / (3.14159265 * radius * radius));
}
