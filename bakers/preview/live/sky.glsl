// The air as this page looks at it: one sun, and the tables of the recipe. Above this text stand the numbers of the
// recipe and the functions of the air (bakers/preview/runtime/air_library.glsl).
uniform vec3 sun;

const float PI = 3.14159265;
const float SUN = 4.651e-3;                                                 // the radius of its disc

Light sunlight(float h, float s) { return air_sunlight(SUN_TABLE, h, s); }
Light ground_light(float s) { return air_ground_light(SUN_TABLE, LIGHT_TABLE, s); }
Air air_along(float h, vec3 ray) { return air_along(AIR_TABLES, h, ray, sun, 1e9, 40); }
Light through_air(float h, vec3 ray, float reach) { return air_through(h, ray, reach, 4); }
Light sun_disc(vec3 ray, Light seen, float pixel) { return air_sun_disc(ray, sun, seen, pixel); }

// Returns the sunlight that a lens scatters, in 1/sr.
float lens_veil(vec3 ray) {
    float cosine = max(dot(ray, sun), 0.0), sine = length(cross(ray, sun));
    return 0.01 / (PI * log(1.0 + 1.0 / (SUN * SUN))) * cosine / (sine * sine + SUN * SUN);
}
