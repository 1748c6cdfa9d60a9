#include "bakers/occupancy/marcher.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake::occupancy {
namespace {

constexpr int kRays = 512;

// Ray n through a layer, upwards. Samples are in the middles of steps.
SampledRay ray_upwards(int n, const std::array<int, 3>& voxels,
                       const std::array<double, 3>& voxel_m) {
    constexpr double kGoldenTurn = 0.6180339887498949;
    const auto [x, y, slant] = low_discrepancy_point(n);
    const double cosine = 1 - slant / 2;
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Place direction = {sine * cosine_of_turns(n * kGoldenTurn),
                             sine * cosine_of_turns(n * kGoldenTurn - 0.25), cosine};
    const Place start = {x * voxels[0], y * voxels[1], 0};
    const double step_m = *std::ranges::min_element(voxel_m);
    SampledRay ray;
    for (std::size_t a = 0; a < 3; ++a) {
        ray.step[a] = direction[a] * step_m / voxel_m[a];
        ray.from[a] = start[a] + ray.step[a] / 2;
    }
    ray.samples = static_cast<int>(std::ceil((voxels[2] - ray.from[2]) / ray.step[2]));
    return ray;
}

}  // namespace

Stay LeapCells::operator()(const Place& from, const Place& step) const {
    constexpr double kMargin = 1.0 / 64;
    const std::array<int, 3> cells = grid.size();
    Place inside = from;
    std::array<int, 3> at{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (a < 2) inside[a] -= std::floor(from[a] / grid.voxels[a]) * grid.voxels[a];
        at[a] = std::clamp(static_cast<int>(inside[a]) / grid.cell, 0, cells[a] - 1);
    }
    const int leap = leaps[index_of(cells, at[0], at[1], at[2])];
    const int reach = std::max(leap, 1);
    double steps = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 3; ++a) {
        if (step[a] == 0) continue;
        // Tiles follow each other; the last cell of each may be smaller.
        const int face = step[a] < 0 ? at[a] + 1 - reach : at[a] + reach;
        const int of_tile = wrapped(face, cells[a]);
        const int voxel = (face - of_tile) / cells[a] * grid.voxels[a] + of_tile * grid.cell;
        steps = std::min(steps, (std::fabs(voxel - inside[a]) - kMargin) / std::fabs(step[a]));
    }
    return {leap > 0, std::max(steps, 0.0)};
}

Stay stay_of_distance(double steps) { return {steps >= 1.0 / 64, std::max(steps, 0.0)}; }

MarchFetches march(const SampledRay& ray, const Structure& structure,
                   const std::function<bool(const Place&)>& look) {
    MarchFetches fetches;
    bool in_cloud = false;
    for (int k = 0; k < ray.samples;) {
        Stay stay;
        if (!in_cloud) {
            stay = structure(ray.at(k), ray.step);
            ++fetches.structure;
        }
        const int end = k + 1 + static_cast<int>(std::min<double>(stay.steps, ray.samples - k - 1));
        if (stay.empty) k = end;
        for (; k < end; ++k, ++fetches.densities) in_cloud = look(ray.at(k));
    }
    return fetches;
}

SkippingGain skipping_gain(const VoxelBits& bits, const std::array<double, 3>& voxel_m,
                           config::OccupancyFilter filter, const Structure& structure,
                           const BakeOptions& options) {
    const std::array<int, 3>& voxels = bits.voxels();
    const auto has_cloud = [&](const Place& place) {
        std::array<AxisTaps, 3> taps;
        for (std::size_t a = 0; a < 3; ++a) {
            taps[a] = filter_taps(filter, place[a], voxels[a], a < 2);
        }
        return filtered_in_double(
                   taps, [&](int x, int y, int z) { return bits.at(x, y, z) ? 1.0 : 0.0; }) > 0;
    };
    std::vector<SkippingGain> rays(kRays);
    parallel_for(kRays, options.threads, [&](int n) {
        const SampledRay ray = ray_upwards(n, voxels, voxel_m);
        rays[static_cast<std::size_t>(n)] = {double(ray.samples),
                                             double(march(ray, structure, has_cloud).all())};
    });
    SkippingGain mean;
    for (const SkippingGain& ray : rays) {
        mean.without += ray.without / kRays;
        mean.with += ray.with / kRays;
    }
    return mean;
}

}  // namespace skybake::occupancy
