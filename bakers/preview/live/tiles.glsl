// Tiles whose copies vary, as bakers/march/tile_variation-inl.h describes: each copy reads the volume from another
// voxel on, and about a border the copies on both sides are eroded, of which the greater value counts. p is in metres
// from the corner of the layer's tile 0.
uniform bool repeats;
uniform highp sampler2D shift_table;

const float MARGIN = 0.125;                                                 // of a tile's edge, on each side of a border
const float OVERLAP = 1.6;
const float COPIES = 64.0;                                                  // after which shifts repeat

// The place that copy number `tile` shows at p.
vec3 in_copy(int layer, vec2 tile, vec3 p) {
    ivec2 at = ivec2(tile - COPIES * floor(tile / COPIES) + 0.5);
    vec2 shift = texelFetch(shift_table, at + ivec2(0, int(COPIES) * layer), 0).rg;
    vec2 edges = TILE[layer].xy;
    return vec3(p.xy - tile * edges + shift / VOXELS[layer].xy * edges, p.z);
}

vec2 tile_of(int layer, vec3 p) { return floor(p.xy / TILE[layer].xy); }

// The nearest border of a tile along both axes.
struct Borders {
    vec2 side;         // -1 or 1
    bvec2 near;        // p is in its margin
    vec2 own, beyond;  // the erosion of the tile and of that beyond the border
};
Borders borders_at(vec2 share_of_tile) {
    vec2 high = step(0.5, share_of_tile), distance = mix(share_of_tile, 1.0 - share_of_tile, high);
    vec2 x = min(distance / MARGIN, 1.0), half_way = 0.5 * x * x * (3.0 - 2.0 * x);
    return Borders(2.0 * high - 1.0, lessThan(distance, vec2(MARGIN)),
                   max(1.0 - OVERLAP * (0.5 + half_way), 0.0), max(1.0 - OVERLAP * (0.5 - half_way), 0.0));
}

// Whether the neighbour number `i` of 1 to 3 reaches a place: that beyond x, beyond y or beyond both.
bool is_near(Borders borders, int i) { return ((i & 1) == 0 || borders.near.x) && ((i & 2) == 0 || borders.near.y); }
vec2 way_to(Borders borders, int i) { return vec2((i & 1) != 0 ? borders.side.x : 0.0, (i & 2) != 0 ? borders.side.y : 0.0); }

float varied_value(int layer, vec3 p) {
    vec2 tile = tile_of(layer, p);
    Borders borders = borders_at(p.xy / TILE[layer].xy - tile);
    float value = value_at(layer, in_copy(layer, tile, p)) - GREATEST[layer] * max(borders.own.x, borders.own.y);
    for (int i = 1; i < 4; ++i) {
        if (!is_near(borders, i)) continue;
        float erosion = max((i & 1) != 0 ? borders.beyond.x : borders.own.x, (i & 2) != 0 ? borders.beyond.y : borders.own.y);
        float other = value_at(layer, in_copy(layer, tile + way_to(borders, i), p));
        value = max(value, other - GREATEST[layer] * erosion);
    }
    return value;
}

// How far the ray goes on from p before it meets a cell that is not empty in a copy that counts there, or the end of
// the margin; 0 where p is in such a cell.
float varied_leap(int layer, vec3 p, vec3 ray) {
    vec2 tile = tile_of(layer, p), share_of_tile = p.xy / TILE[layer].xy - tile;
    Borders borders = borders_at(share_of_tile);
    float way = leap_at(layer, in_copy(layer, tile, p), ray);
    for (int i = 1; i < 4 && way > 0.0; ++i) {
        if (is_near(borders, i)) way = min(way, leap_at(layer, in_copy(layer, tile + way_to(borders, i), p), ray));
    }
    if (way == 0.0) return 0.0;
    for (int a = 0; a < 2; ++a) {
        vec2 part = borders.near[a] ? max(borders.side[a], 0.0) + vec2(-MARGIN, MARGIN) : vec2(MARGIN, 1.0 - MARGIN);
        float rest = ray[a] > 0.0 ? part.y - share_of_tile[a] : share_of_tile[a] - part.x;
        way = min(way, rest * TILE[layer][a] / max(abs(ray[a]), 1e-7));
    }
    return max(way, 1e-3);
}

// The volume's value, how far a ray may leap, and the place in the volume, for p in a layer or in its only tile.
float value_in_layer(int layer, vec3 p) {
    if (repeats) return varied_value(layer, p);
    return value_at(layer, p);
}
float leap_in_layer(int layer, vec3 p, vec3 ray) {
    if (repeats) return varied_leap(layer, p, ray);
    return leap_at(layer, p, ray);
}
vec3 place_in_volume(int layer, vec3 p) {
    if (repeats) return in_copy(layer, tile_of(layer, p), p);
    return p;
}
