#include "bakers/assets/cloud_distance/distance_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {
namespace {

using Point = std::array<double, 3>;

class Check {
  public:
    Check(const DistanceTexture& texture, const DistanceCode& code, const NearestVoxel& nearest,
          const std::array<int, 3>& voxels, const std::array<double, 3>& voxel_m)
        : texture_(texture),
          code_(code),
          nearest_(nearest),
          voxels_(voxels),
          voxel_m_(voxel_m),
          zero_m_(std::min(0.0, code.metres(double{code.surface()})) - code.rounding_m()) {}

    // The exact distance: to touched cells, or minus that to holed ones.
    double exact(const Point& place) const {
        const double outside = nearest_.to_cloud(place);
        return outside > 0 ? outside : -nearest_.to_hole(place);
    }

    // Returns by how much a distance is farther from 0 than the exact one.
    double excess(double found, double exact) const {
        if (found > code_.rounding_m()) return found - std::max(exact, 0.0);
        return found < zero_m_ ? std::min(exact, 0.0) + zero_m_ - found : 0;
    }

    // Returns by how much the distance of a texel is nearer to 0 than it need be.
    double loss(double found, double exact, const std::array<double, 2>& range) const {
        const double wanted = std::fabs(std::clamp(exact, range[0], range[1]));
        return wanted - code_.most_lost() - std::fabs(found);
    }

    Point texel_of(const Point& place) const {
        Point centre{};
        for (std::size_t a = 0; a < 3; ++a) {
            centre[a] = (std::floor(place[a] / texture_.cell) + 0.5) * texture_.cell;
        }
        return centre;
    }
    double texel_at(const Point& centre) const {
        std::array<int, 3> at{};
        for (std::size_t a = 0; a < 3; ++a) at[a] = static_cast<int>(centre[a] / texture_.cell);
        return code_.metres(double{texture_.values[index_of(texture_.size, at[0], at[1], at[2])]});
    }

    // Goes on by what it looks up, until it finds cloud or leaves the layer, or has gone round.
    void trace(Point place, const Point& direction, std::int64_t& steps, std::int64_t& lost) const {
        constexpr int kMostSteps = 256;
        const double least_m = 1e-3 * code_.most_lost();
        for (int step = 0; step < kMostSteps; ++step) {
            if (place[2] < 0 || place[2] > voxels_[2]) return;
            const double found = looked_up_m(texture_, code_, place);
            if (found <= least_m) return;
            ++steps;
            if (found > nearest_.to_cloud(place)) ++lost;
            for (std::size_t a = 0; a < 3; ++a) {
                place[a] += found * direction[a] / voxel_m_[a];
                if (a < 2) place[a] -= std::floor(place[a] / voxels_[a]) * voxels_[a];
            }
        }
    }

  private:
    const DistanceTexture& texture_;
    const DistanceCode& code_;
    const NearestVoxel& nearest_;
    std::array<int, 3> voxels_;
    std::array<double, 3> voxel_m_;
    double zero_m_;  // the least that is looked up for 0
};

// The finding at one point.
struct Finding {
    Point place{};
    Point texel{};
    double lookup_error_m = 0;
    double texel_error_m = 0;
    double excess_m = 0;
    double loss_m = 0;
    std::int64_t steps = 0;
    std::int64_t lost_steps = 0;
};

Point direction_of(int ray) {
    const Point share = low_discrepancy_point(ray + (1 << 20));
    const double cosine = 2 * share[0] - 1;
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return {sine * cosine_of_turns(share[1]), sine * cosine_of_turns(share[1] - 0.25), cosine};
}

}  // namespace

double looked_up_m(const DistanceTexture& texture, const DistanceCode& code, const Point& place) {
    std::array<AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] = filter_taps(config::OccupancyFilter::trilinear, place[a] / texture.cell,
                              texture.size[a], a < 2);
        const double high = std::floor(taps[a].weight[1] * 256 + 0.5) / 256;
        taps[a].weight = {1 - high, high};
    }
    return code.metres(filtered_in_double(taps, [&](int x, int y, int z) {
        return texture.values[index_of(texture.size, x, y, z)];
    }));
}

DistanceCheckResult check_distances(const DistanceTexture& texture, const DistanceCode& code,
                                    const NearestVoxel& nearest, const std::array<int, 3>& voxels,
                                    const std::array<double, 3>& voxel_m, int points, int rays,
                                    const BakeOptions& options) {
    const Check check(texture, code, nearest, voxels, voxel_m);
    const std::array<double, 2> range = code.range();
    std::vector<Finding> findings(static_cast<std::size_t>(points));
    for_each_tile(points, options, "distances at points", [&](int i) {
        Finding& found = findings[static_cast<std::size_t>(i)];
        found.place = low_discrepancy_point(i);
        for (std::size_t a = 0; a < 3; ++a) found.place[a] *= voxels[a];
        found.texel = check.texel_of(found.place);
        const double looked_up = looked_up_m(texture, code, found.place);
        const double exact = check.exact(found.place);
        const double texel = check.texel_at(found.texel);
        const double texel_exact = check.exact(found.texel);
        found.lookup_error_m = looked_up - std::clamp(exact, range[0], range[1]);
        found.texel_error_m = texel - std::clamp(texel_exact, range[0], range[1]);
        found.excess_m = check.excess(looked_up, exact);
        found.loss_m = check.loss(texel, texel_exact, range);
        if (i < rays) check.trace(found.place, direction_of(i), found.steps, found.lost_steps);
    });
    DistanceCheckResult result;
    result.points = points;
    result.rays = std::min(points, rays);
    ErrorStatistics lookups;
    ErrorStatistics texels;
    const double width = range[1] - range[0];
    for (const Finding& found : findings) {
        if (std::fabs(found.lookup_error_m) > lookups.max() * width) {
            result.farthest_off = found.place;
        }
        lookups.add(found.lookup_error_m / width);
        texels.add(found.texel_error_m / width);
        if (found.excess_m > 0) ++result.too_far;
        if (found.loss_m > 0) ++result.too_near;
        if (found.excess_m > result.worst_m) result.worst_place = found.place;
        if (found.loss_m > std::max(result.worst_m, found.excess_m)) {
            result.worst_place = found.texel;
        }
        result.worst_m = std::max({result.worst_m, found.excess_m, found.loss_m});
        result.steps += found.steps;
        result.lost_steps += found.lost_steps;
    }
    result.lookup = lookups.figures();
    result.texel = texels.figures();
    return result;
}

}  // namespace skybake::occupancy
