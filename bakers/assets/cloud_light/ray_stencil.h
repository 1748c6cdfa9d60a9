// The quadrature of extinction along a ray towards the sun, as weights of voxels.
//
// All rays towards one sun are parallel, so that rays from places which are whole voxels apart along
// x and y have the same quadrature, moved by so many voxels. Between the planes through voxel centres
// the trilinearly filtered value is a product of three linear functions of the distance t, a cubic,
// which two points of Gauss and Legendre integrate exactly:
//
//   tau = sum over pieces (b - a) sum_k w_k sigma(a + (b - a) t_k)
//
// Without an edge sigma is linear in the voxels, and tau is one sum of voxels times weights. With an
// edge sigma is no polynomial: each point is filtered by itself, kEdgePoints of them in each piece.
#pragma once

#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// Points between two planes where a threshold is applied after filtering.
inline constexpr int kEdgePoints = 12;

// tau += weight * voxel (x + dx, y + dy, z).
struct VoxelWeight {
    int dx = 0;
    int dy = 0;
    int z = 0;  // within the volume
    float weight = 0;
};

// tau += weight * density(the value filtered between eight voxels), (x + dx, y + dy, z) and those one
// farther along each axis. `above` is the plane over z, or z itself where lookups are clamped.
struct FilteredPoint {
    int dx = 0;
    int dy = 0;
    int z = 0;
    int above = 0;
    std::array<float, 3> share{};  // of the voxels farther along x, y, z
    float weight = 0;
};

// The quadrature along the rays of one height. Weights contain extinction_per_m.
struct RayStencil {
    std::vector<VoxelWeight> voxels;    // without an edge: sorted by z, dy, dx, each voxel once
    std::vector<FilteredPoint> points;  // with an edge: from the ray's start on
};

// Returns the quadrature along the ray from `start` in a unit direction that rises. Voxels are
// relative to voxel (0, 0) of the ground plan.
RayStencil make_stencil(const CloudLayer& layer, const glm::dvec3& start,
                        const glm::dvec3& direction);

}  // namespace skybake::cloud_light
