// Lookup of asset = "environment": radiance in 1/sr for a solar irradiance of 1. Use a bilinear sampler
// that repeats along u and clamps along v.
//
// The unit vectors `dir`, `up` and `sun` point along the view ray, away from the planet's centre and to
// the sun, which stands at u = 1/2. Angles come from atan(y, x), which keeps its digits everywhere.
vec4 environment_of_4(sampler2D table, vec3 dir, vec3 up, vec3 sun) {                // of four wavelengths
    const float PI = 3.14159265;
    float mu = dot(dir, up);
    vec3 a = dir - up * mu, b = sun - up * dot(sun, up);               // their azimuths
    float across = dot(cross(b, a), up), along = dot(a, b);
    float azimuth = across != 0.0 || along < 0.0 ? atan(across, along) : 0.0;    // any at the zenith
    float elevation = atan(mu, length(a));
    return texture(table, vec2(0.5 + azimuth / (2.0 * PI), 0.5 - elevation / PI));
}

vec3 environment(sampler2D table, vec3 dir, vec3 up, vec3 sun) {
    return vec3(environment_of_4(table, dir, up, sun));
}
