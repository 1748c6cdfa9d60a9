#include "bakers/assets/cloud_light/ray_stencil.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "bakers/math/quadrature.h"

namespace skybake::cloud_light {
namespace {

// The distances at which the ray meets the planes through voxel centres, with both its ends,
// ascending. `start` is in units in which voxel i is at i.
std::vector<double> pieces(const glm::dvec3& start, const glm::dvec3& along, double end) {
    std::vector<double> ends = {0, end};
    for (std::size_t a = 0; a < 3; ++a) {
        if (along[a] == 0) continue;
        const double stop = start[a] + along[a] * end;
        const int first = static_cast<int>(std::floor(std::min(start[a], stop))) + 1;
        const int last = static_cast<int>(std::ceil(std::max(start[a], stop))) - 1;
        for (int plane = first; plane <= last; ++plane) {
            const double t = (plane - start[a]) / along[a];
            if (t > 0 && t < end) ends.push_back(t);
        }
    }
    std::ranges::sort(ends);
    return ends;
}

FilteredPoint filtered_point(const CloudLayer& layer, const glm::dvec3& at, double weight) {
    FilteredPoint point;
    const double z = std::clamp(at.z, 0.0, layer.size[2] - 1.0);
    point.dx = static_cast<int>(std::floor(at.x));
    point.dy = static_cast<int>(std::floor(at.y));
    point.z = static_cast<int>(z);
    point.above = std::min(point.z + 1, layer.size[2] - 1);
    point.share = {static_cast<float>(at.x - point.dx), static_cast<float>(at.y - point.dy),
                   static_cast<float>(z - point.z)};
    point.weight = static_cast<float>(weight);
    return point;
}

// The eight voxels of a point, with their shares of its weight in double.
struct Share {
    int z, dy, dx;
    double weight;
};

void add_shares(const CloudLayer& layer, const glm::dvec3& at, double weight,
                std::vector<Share>& shares) {
    const double z = std::clamp(at.z, 0.0, layer.size[2] - 1.0);
    const std::array<int, 3> low = {static_cast<int>(std::floor(at.x)),
                                    static_cast<int>(std::floor(at.y)), static_cast<int>(z)};
    const glm::dvec3 high_share = {at.x - low[0], at.y - low[1], z - low[2]};
    for (int corner = 0; corner < 8; ++corner) {
        double share = weight;
        std::array<int, 3> voxel = low;
        for (std::size_t a = 0; a < 3; ++a) {
            const bool high = ((corner >> a) & 1) != 0;
            share *= high ? high_share[a] : 1 - high_share[a];
            voxel[a] += high ? 1 : 0;
        }
        shares.push_back({std::min(voxel[2], layer.size[2] - 1), voxel[1], voxel[0], share});
    }
}

// Adds up the shares of each voxel.
std::vector<VoxelWeight> merged(std::vector<Share> shares) {
    const auto place = [](const Share& share) { return std::tie(share.z, share.dy, share.dx); };
    std::ranges::stable_sort(shares,
                             [&](const Share& a, const Share& b) { return place(a) < place(b); });
    std::vector<VoxelWeight> voxels;
    for (std::size_t i = 0; i < shares.size();) {
        double sum = 0;
        const Share& first = shares[i];
        for (; i < shares.size() && place(shares[i]) == place(first); ++i) sum += shares[i].weight;
        if (sum > 0) voxels.push_back({first.dx, first.dy, first.z, static_cast<float>(sum)});
    }
    return voxels;
}

}  // namespace

RayStencil make_stencil(const CloudLayer& layer, const glm::dvec3& start,
                        const glm::dvec3& direction) {
    assert(direction.z > 0 && start.z <= layer.size[2]);
    const glm::dvec3 along = in_voxels(layer, direction);
    const double end = ray_length(layer, start, along);
    const glm::dvec3 from = start - 0.5;
    const std::vector<double> ends = pieces(from, along, end);
    const QuadratureRule rule = gauss_legendre(layer.optics.has_edge ? kEdgePoints : 2);
    RayStencil stencil;
    std::vector<Share> shares;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double length = ends[i + 1] - ends[i];
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const glm::dvec3 at = from + along * (ends[i] + length * rule.nodes[k]);
            const double weight = layer.optics.extinction_per_m * length * rule.weights[k];
            if (layer.optics.has_edge) {
                stencil.points.push_back(filtered_point(layer, at, weight));
            } else {
                add_shares(layer, at, weight, shares);
            }
        }
    }
    stencil.voxels = merged(std::move(shares));
    return stencil;
}

}  // namespace skybake::cloud_light
