// Lookups of asset = "cloud_volume", and marches that leave out what is empty: by the channel `leap` of
// asset = "occupancy", or by the first channel of asset = "cloud_distance". The samplers of the cloud and
// of distances are trilinear, repeat along x and y and are clamped along z.
//
// p and the march's `from` are in metres from the lower corner of the tile, z up; `tile` are the edges of
// the tile, the recipe's extent. Density times extinction_scale is extinction, so that density summed
// over metres and times extinction_scale is optical depth.

// Cost: fetches 1, operations 6, divisions 0, special functions 0
vec4 cloud_texel(sampler3D cloud, vec3 p, vec3 tile) { return texture(cloud, p / tile); }

float cloud_density(sampler3D cloud, vec3 p, vec3 tile) { return cloud_texel(cloud, p, tile).r; }

// The density of a value v where the recipe says threshold_at = "runtime".
float cloud_edge(float v, float threshold, float edge_softness) {
    if (v <= threshold) return 0.0;
    float x = v - threshold < edge_softness ? (v - threshold) / edge_softness : 1.0;
    return v * (x * x * (3.0 - 2.0 * x));
}

// Where a ray is in the cloud's layer, as distances from its start: nowhere where x > y. The last one is
// far away for a level ray.
vec2 cloud_layer(float height, float from_z, float ray_z) {
    if (abs(ray_z) < 1e-7) return from_z >= 0.0 && from_z <= height ? vec2(0.0, 1e7) : vec2(1.0, 0.0);
    vec2 face = vec2(-from_z, height - from_z) / ray_z;
    return vec2(max(min(face.x, face.y), 0.0), max(face.x, face.y));
}

// The place of p in its tile, in voxels; `voxels` is the cloud's size.
vec3 cloud_voxel(vec3 voxels, vec3 p, vec3 tile) {
    vec3 place = p / tile;
    return (place - vec3(floor(place.x), floor(place.y), 0.0)) * voxels;
}

// The cell of a grid that p is in, to be fetched without filtering. `cell` is the recipe's: a cell's edge
// in voxels; `cells` are those of the grid along each axis.
// Cost with the fetch: fetches 1, operations 32, divisions 0, special functions 0
ivec3 cloud_cell(vec3 cells, float cell, vec3 voxels, vec3 p, vec3 tile) {
    vec3 at = floor(cloud_voxel(voxels, p, tile) / cell);
    return ivec3(clamp(at, vec3(0.0), cells - 1.0));
}

// The box of cells that p is in, whose `leap` is x: leap - 1 cells about its own, all of them empty, or its own
// alone where leap is 0, since there may be cloud in it; and y, how far the ray goes on from p within it, in
// metres. That ends a 64th of a voxel before the face, so that no sample is beyond it, however floats and the
// weights of texture units are rounded. `full` has, in the channel of `leap`, the leap that a texel of 1
// stands for: 255 for unorm types, else 1; and 0 in the others. Tiles follow each other along x and y; the
// last cell of each is smaller where `cell` does not divide the cloud's size.
vec2 cloud_box(sampler3D leaps, vec3 cells, float cell, vec4 full, vec3 voxels, vec3 p, vec3 ray, vec3 tile) {
    vec3 inside = cloud_voxel(voxels, p, tile);
    ivec3 at = cloud_cell(cells, cell, voxels, p, tile);
    float leap = floor(dot(texelFetch(leaps, at, 0), full) + 0.5), reach = max(leap, 1.0);
    vec3 along = ray / tile * voxels;                                       // voxels per metre
    vec3 face = vec3(at) + vec3(along.x < 0.0 ? 1.0 - reach : reach, along.y < 0.0 ? 1.0 - reach : reach,
                                along.z < 0.0 ? 1.0 - reach : reach);       // cells from the tile's corner
    vec3 tiles = floor((face + 0.5) / cells);
    face = tiles * voxels + (face - tiles * cells) * cell;                  // voxels from there
    vec3 margin = abs(sign(along)) / 64.0;                                  // none where the ray stands still
    vec3 way = (abs(face - inside) - margin) / max(abs(along), vec3(1e-20));
    return vec2(leap, max(min(way.x, min(way.y, way.z)), 0.0));
}

// How far the ray goes on from p, in metres, through what is empty; 0 where there may be cloud.
float cloud_leap(sampler3D leaps, vec3 cells, float cell, vec4 full, vec3 voxels, vec3 p, vec3 ray, vec3 tile) {
    vec2 box = cloud_box(leaps, cells, cell, full, voxels, p, ray, tile);
    return box.x > 0.0 ? box.y : 0.0;
}

// The sum of densities times metres over `count` samples at from + ray * stride * i, i = 0, 1 ..., all of
// them within the layer: it is the sum of a march that looks everywhere. The grid is fetched once for each
// box, and not where the sample before had cloud, since the next one most often has.
float cloud_march(sampler3D cloud, sampler3D leaps, vec3 cells, float cell, vec4 full, vec3 voxels, vec3 from,
                  vec3 ray, vec3 tile, float stride, int count) {
    float sum = 0.0, density = 0.0;
    int i = 0;
    while (i < count) {
        vec2 box = vec2(0.0);
        vec3 p = from + ray * (stride * float(i));
        if (density == 0.0) box = cloud_box(leaps, cells, cell, full, voxels, p, ray, tile);
        int end = i + 1 + int(min(box.y / stride, float(count - i - 1)));
        if (box.x > 0.0) i = end;
        while (i < end) {
            density = cloud_density(cloud, from + ray * (stride * float(i)), tile);
            sum += density;
            i += 1;
        }
    }
    return sum * stride;
}

// Metres from p, which lies within the layer, to the cloud, negative within it: never farther from 0 than
// the distance is. `ends` are the metres that texels of 0 and 1 stand for: the recipe's range for unorm
// types, else 0 and 1. `box` are the edges of what the texels span: the tile's, and more along z where
// `cell` does not divide the cloud's size.
float cloud_distance(sampler3D distances, vec2 ends, vec3 p, vec3 box) {
    return ends.x + (ends.y - ends.x) * cloud_texel(distances, p, box).r;
}

// The sum that cloud_march returns, of samples that it finds by distances: none that is within the distance
// at a sample can hold cloud, itself included where that is more than what rounding makes of 0. Distances
// are not fetched where the sample before had cloud.
float cloud_trace(sampler3D cloud, sampler3D distances, vec2 ends, vec3 box, vec3 from, vec3 ray,
                  vec3 tile, float stride, int count) {
    float sum = 0.0, density = 0.0;
    int i = 0;
    while (i < count) {
        vec3 p = from + ray * (stride * float(i));
        float empty = density == 0.0 ? cloud_distance(distances, ends, p, box) : 0.0;
        density = empty < stride / 64.0 ? cloud_density(cloud, p, tile) : 0.0;
        sum += density;
        i += 1 + int(clamp(empty / stride, 0.0, float(count)));
    }
    return sum * stride;
}
