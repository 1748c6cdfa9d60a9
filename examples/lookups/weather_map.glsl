// Lookups of asset = "weather_map". Use a bilinear sampler that repeats. p is a point in the plane and `tile`
// the edges of a tile, in one unit.
// Cost: fetches 1, operations 4, divisions 2, special functions 0
vec4 weather_map(sampler2D table, vec2 p, vec2 tile) { return texture(table, p / tile); }

// How much is left of an amount if a runtime covers less of the sky: nothing where it is below 1 - keep,
// all where it is 1.
float weather_map_cover(float amount, float keep) {
    return keep > 0.0 ? clamp((amount - (1.0 - keep)) / keep, 0.0, 1.0) : 0.0;
}

// The vector of a texel of content = "directions", of about length 1 between texels.
vec3 weather_map_direction(vec3 texel) { return 2.0 * texel - 1.0; }
