// Lookups of asset = "environment": radiance in 1/sr for a solar irradiance of 1. Use a bilinear sampler that
// clamps along v; along u it repeats if the mapping is longitude_latitude, and else clamps.
//
// The unit vectors `dir`, `up` and `ahead` point along the view ray, away from the planet's centre and straight
// ahead, whose azimuth is 0: to the sun where the asset has no clouds and no `sun_azimuth`. Azimuths grow to the
// right. Angles come from atan(y, x), which keeps its digits everywhere.
// `edge` is the number of texels along the edge of a face or of the square.
// A cube texture, as DDS and KTX2 files have it, is read by texture(cube, environment_view(dir, up, ahead)).

// Cost: fetches 1, operations 54, divisions 0, special functions 3
vec4 environment_of_4(sampler2D table, vec3 dir, vec3 up, vec3 ahead) {              // of four wavelengths
    const float PI = 3.14159265;
    float mu = dot(dir, up);
    vec3 a = dir - up * mu, b = ahead - up * dot(ahead, up);           // their azimuths
    float across = dot(cross(a, b), up), along = dot(a, b);
    float azimuth = across != 0.0 || along < 0.0 ? atan(across, along) : 0.0;    // any at the zenith
    float elevation = atan(mu, length(a));
    return texture(table, vec2(0.5 + azimuth / (2.0 * PI), 0.5 - elevation / PI));
}

vec3 environment(sampler2D table, vec3 dir, vec3 up, vec3 ahead) {
    return vec3(environment_of_4(table, dir, up, ahead));
}

vec3 environment_view(vec3 dir, vec3 up, vec3 ahead) {                 // how far to the right, up and ahead
    vec3 flat_ahead = ahead - up * dot(ahead, up);
    vec3 level = flat_ahead / length(flat_ahead);
    return vec3(dot(dir, cross(level, up)), dot(dir, up), dot(dir, level));
}

vec3 environment_face(vec3 v) {                                        // 0 to 5, and the place from -1 to 1
    float x = abs(v.x), y = abs(v.y), z = abs(v.z);
    if (x >= y && x >= z) return vec3(v.x > 0.0 ? 0.0 : 1.0, vec2(v.x > 0.0 ? -v.z : v.z, -v.y) / x);
    if (y >= z) return vec3(v.y > 0.0 ? 2.0 : 3.0, vec2(v.x, v.y > 0.0 ? v.z : -v.z) / y);
    return vec3(v.z > 0.0 ? 4.0 : 5.0, vec2(v.z > 0.0 ? v.x : -v.x, -v.y) / z);
}

// Cost: fetches 1, operations 68, divisions 9, special functions 1
vec4 environment_cube_of_4(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    vec3 at = environment_face(environment_view(dir, up, ahead));
    float margin = 0.5 / edge;                                         // of a face, against the next one
    float x = clamp(0.5 + 0.5 * at.y, margin, 1.0 - margin);
    float y = clamp(0.5 + 0.5 * at.z, margin, 1.0 - margin);
    return texture(table, vec2(x, (at.x + y) / 6.0));
}

vec3 environment_cube(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    return vec3(environment_cube_of_4(table, edge, dir, up, ahead));
}

vec4 environment_octahedral_texel(sampler2D table, float x, float y) {  // beyond an edge lies the one beside it
    float in_x = abs(x) > 1.0 ? sign(x) * 2.0 - x : x, of_y = abs(x) > 1.0 ? -y : y;
    float in_y = abs(of_y) > 1.0 ? sign(of_y) * 2.0 - of_y : of_y, of_x = abs(of_y) > 1.0 ? -in_x : in_x;
    return texture(table, vec2(0.5 + 0.5 * of_x, 0.5 + 0.5 * in_y));
}

vec4 environment_square_of_4(sampler2D table, float edge, float across, float down) {     // from -1 to 1
    float next = 2.0 / edge;
    float column = (0.5 + 0.5 * across) * edge - 0.5, row = (0.5 + 0.5 * down) * edge - 0.5;
    float left = (floor(column) + 0.5) * next - 1.0, top = (floor(row) + 0.5) * next - 1.0;
    vec4 above = mix(environment_octahedral_texel(table, left, top),
                     environment_octahedral_texel(table, left + next, top), column - floor(column));
    vec4 below = mix(environment_octahedral_texel(table, left, top + next),
                     environment_octahedral_texel(table, left + next, top + next), column - floor(column));
    return mix(above, below, row - floor(row));
}

// Cost: fetches 4, operations 181, divisions 5, special functions 1
vec4 environment_octahedral_of_4(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    vec3 v = environment_view(dir, up, ahead);
    float s = abs(v.x) + abs(v.y) + abs(v.z);
    float x = v.x / s, y = -v.z / s;
    float across = v.y < 0.0 ? (x < 0.0 ? -1.0 : 1.0) * (1.0 - abs(y)) : x;
    float down = v.y < 0.0 ? (y < 0.0 ? -1.0 : 1.0) * (1.0 - abs(x)) : y;
    return environment_square_of_4(table, edge, across, down);
}

vec3 environment_octahedral(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    return vec3(environment_octahedral_of_4(table, edge, dir, up, ahead));
}

// Cost: fetches 4, operations 182, divisions 4, special functions 4
vec4 environment_equal_area_of_4(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    const float PI = 3.14159265;
    vec3 v = environment_view(dir, up, ahead);
    float level = length(vec2(v.x, v.z)), r = level / sqrt(1.0 + abs(v.y));
    float b = level > 0.0 ? r * atan(abs(v.x), abs(v.z)) * 2.0 / PI : 0.0, a = r - b;
    float across = v.y < 0.0 ? 1.0 - b : a, down = v.y < 0.0 ? 1.0 - a : b;
    return environment_square_of_4(table, edge, v.z < 0.0 ? -across : across, v.x < 0.0 ? down : -down);
}

vec3 environment_equal_area(sampler2D table, float edge, vec3 dir, vec3 up, vec3 ahead) {
    return vec3(environment_equal_area_of_4(table, edge, dir, up, ahead));
}
