#include "bakers/clouds/cover_search.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/shape_kernel.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"

namespace skybake::cloud {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How far floats may move q + c m - 1. Where that is about 0, x, e and v are at most 2, and each of
// some ten steps rounds by half of 2^-23 of them.
constexpr double kRoom = 2e-6;

constexpr int kRows = 16;
constexpr int kDepth = 8;

CloudPlan at_coverage(CloudPlan plan, double coverage) {
    plan.coverage = coverage;
    return plan;
}

// The plan that gives v itself where b is above 0, at full coverage and without its map.
CloudPlan full_plan(CloudPlan plan) {
    plan.coverage_map.reset();
    plan.threshold_in_file = false;
    return at_coverage(std::move(plan), 1);
}

// Bounds of the number of columns that hold cloud. They differ where so many may fill at once that those
// were not looked at.
struct Count {
    std::int64_t least = 0;
    std::int64_t most = 0;
};

using CountedCoverage = std::pair<double, std::int64_t>;

// Searches between two coverages for the count of columns that is nearest to a share of all.
template <class CountAt>
FoundCover bisected(CountedCoverage low, CountedCoverage high, double share, std::size_t columns,
                    const CountAt& count_at) {
    const auto all = static_cast<double>(columns);
    const auto share_of = [all](std::int64_t count) { return static_cast<double>(count) / all; };
    FoundCover found{.tried = {low.first, high.first},
                     .reach = {share_of(low.second), share_of(high.second)}};
    const auto wanted = static_cast<std::int64_t>(std::llround(share * all));
    while (low.second < wanted && wanted < high.second) {
        const double middle = low.first + (high.first - low.first) / 2;
        if (middle <= low.first || middle >= high.first) break;
        const Count count = count_at(middle);
        if (count.least <= wanted && wanted <= count.most) {
            low = {middle, count.least};
            break;
        }
        const bool is_low = count.most < wanted;
        (is_low ? low : high) = {middle, is_low ? count.most : count.least};
    }
    const bool is_low = std::abs(wanted - low.second) <= std::abs(high.second - wanted);
    const CountedCoverage& nearest = is_low ? low : high;
    found.coverage = nearest.first;
    found.share = share_of(nearest.second);
    return found;
}

class CoverSearch {
  public:
    CoverSearch(const CloudPlan& plan, const CoverRequest& request, const BakeOptions& options)
        : plan_(plan), request_(request), width_(static_cast<std::size_t>(plan.size[0])) {
        const CloudField field(full_plan(plan));
        std::vector<double> least;  // of each slice
        for (const SliceShape& slice : plan.slices) least.push_back(least_cloud(slice.water));
        peaks_.assign(width_ * static_cast<std::size_t>(plan.size[1]), -kInfinity);
        for_each_tile((plan.size[1] + kRows - 1) / kRows, options, "cover",
                      [&](int tile) { find_peaks(field, least, tile * kRows); });
    }

    FoundCover search() const {
        const auto counted = [this](double coverage) { return count_at(coverage); };
        return bisected({0.0, count_at(0).least}, {1.0, count_at(1).least}, request_.share,
                        peaks_.size(), counted);
    }

  private:
    bool is_cloud(float v, float water) const {
        finish(plan_, water, 1, &v);
        return round_to_pixel_type(double{v}, request_.pixel_type) > request_.level;
    }

    // The least v that is stored as cloud, by bisection of the bits of floats up to 1e9.
    double least_cloud(float water) const {
        std::uint32_t low = 0;
        auto high = std::bit_cast<std::uint32_t>(1e9F);
        if (!is_cloud(std::bit_cast<float>(high), water)) return kInfinity;
        while (high - low > 1) {
            const std::uint32_t middle = low + (high - low) / 2;
            (is_cloud(std::bit_cast<float>(middle), water) ? high : low) = middle;
        }
        return double{std::bit_cast<float>(low)};
    }

    // q of a voxel from v and the erosion e at full coverage. b must be above the threshold too.
    double margin(double v, double e, double least) const {
        const double q = (1 - e) * (v - least);
        return std::min(q, (1 - e) * v + e - double{plan_.level()});
    }

    void find_peaks(const CloudField& field, const std::vector<double>& least, int first_row) {
        const int rows = std::min(kRows, plan_.size[1] - first_row);
        std::vector<float> values;
        std::vector<float> details;
        std::vector<float*> channels(static_cast<std::size_t>(plan_.channels), nullptr);
        double* const peaks = &peaks_[static_cast<std::size_t>(first_row) * width_];
        for (int z = 0; z < plan_.size[2]; z += kDepth) {
            const VoxelBox box{{0, first_row, z},
                               {plan_.size[0], rows, std::min(kDepth, plan_.size[2] - z)}};
            if (field.is_empty(box)) continue;
            values.resize(static_cast<std::size_t>(box.count()));
            channels.front() = values.data();
            field.fill(box, channels);
            if (*std::ranges::max_element(values) <= 0) continue;
            details.assign(values.size(), 0);
            if (plan_.detail) plan_.fill_detail(box, details.data());
            const std::size_t slice = width_ * static_cast<std::size_t>(rows);
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (!(values[i] > 0)) continue;
                const std::size_t level = static_cast<std::size_t>(z) + i / slice;
                const SliceShape& shape = plan_.slices[level];
                const double e = plan_.detail ? erosion_of(shape, details[i]) : 0;
                double& peak = peaks[i % slice];
                peak = std::max(peak, margin(double{values[i]}, e, least[level]));
            }
        }
    }

    static double erosion_of(const SliceShape& shape, float detail) {
        const double d = std::clamp(double{detail}, 0.0, 1.0);
        return double{shape.erosion} * (d + double{shape.billow} * (1 - 2 * d));
    }

    double map_at(std::size_t column) const {
        if (!plan_.coverage_map) return 1;
        const double x = (static_cast<double>(column % width_) + 0.5) / plan_.size[0];
        return plan_.coverage_map->at(x,
                                      (static_cast<double>(column / width_) + 0.5) / plan_.size[1]);
    }

    // The columns that hold cloud at a coverage.
    Count count_at(double coverage) const {
        constexpr std::size_t kFew = 512;  // are looked at however many tie
        std::int64_t sure = 0;
        std::vector<std::size_t> unsure;
        for (std::size_t column = 0; column < peaks_.size(); ++column) {
            const double above = peaks_[column] + coverage * map_at(column) - 1;
            if (above > kRoom) ++sure;
            if (std::fabs(above) <= kRoom) unsure.push_back(column);
        }
        if (unsure.size() > std::max(kFew, peaks_.size() / kMostTiedColumns)) {
            return {sure, sure + static_cast<std::int64_t>(unsure.size())};
        }
        if (unsure.empty()) return {sure, sure};
        const CloudPlan plan = at_coverage(plan_, coverage);
        for (const std::size_t column : unsure) sure += holds_cloud(plan, column) ? 1 : 0;
        return {sure, sure};
    }

    bool holds_cloud(const CloudPlan& plan, std::size_t column) const {
        const VoxelBox box{{static_cast<int>(column % width_), static_cast<int>(column / width_)},
                           {1, 1, plan.size[2]}};
        std::vector<float> values(static_cast<std::size_t>(box.count()));
        std::vector<float*> channels(static_cast<std::size_t>(plan.channels), nullptr);
        channels.front() = values.data();
        fill_cloud(plan, {}, box, channels);
        return std::ranges::any_of(values, [this](float value) {
            return round_to_pixel_type(double{value}, request_.pixel_type) > request_.level;
        });
    }

    const CloudPlan& plan_;
    const CoverRequest& request_;
    std::size_t width_ = 0;
    std::vector<double> peaks_;  // the greatest q of each column; -infinity: none above 0
};

// Counts the columns of a plan that hold cloud.
std::int64_t count_columns(CloudPlan plan, const CoverRequest& request,
                           const BakeOptions& options) {
    const CloudField field(std::move(plan));
    const std::array<int, 3>& size = field.plan().size;
    std::atomic<std::int64_t> covered = 0;
    const int tiles = (size[1] + kRows - 1) / kRows;
    parallel_for(tiles, options.threads, [&](int tile) {
        if (options.cancelled()) return;
        const int first = tile * kRows;
        const VoxelBox box{{0, first, 0}, {size[0], std::min(kRows, size[1] - first), size[2]}};
        if (field.is_empty(box)) return;
        std::vector<float> values(static_cast<std::size_t>(box.count()));
        std::vector<float*> channels(static_cast<std::size_t>(field.plan().channels), nullptr);
        channels.front() = values.data();
        field.fill(box, channels);
        std::vector<char> holds(values.size() / static_cast<std::size_t>(size[2]));
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double stored = round_to_pixel_type(double{values[i]}, request.pixel_type);
            if (stored > request.level) holds[i % holds.size()] = 1;
        }
        covered += std::ranges::count(holds, 1);
    });
    return covered;
}

}  // namespace

FoundCover find_grown_cover(const std::function<CloudPlan(double coverage)>& plan_of,
                            const std::array<int, 3>& size, const CoverRequest& request,
                            const BakeOptions& options) {
    constexpr double kMost = 16;  // more water than the driest air lacks, and than there is
    const auto counted = [&](double coverage) {
        return CountedCoverage{coverage, count_columns(plan_of(coverage), request, options)};
    };
    const auto columns = static_cast<std::size_t>(VoxelBox{{}, {size[0], size[1], 1}}.count());
    const auto wanted = std::llround(request.share * static_cast<double>(columns));
    CountedCoverage low = counted(0), high = counted(1);
    for (double step = 1; low.second > wanted && step < kMost; step *= 2) {
        high = std::exchange(low, counted(low.first - step));
    }
    for (double step = 1; high.second < wanted && step < kMost; step *= 2) {
        low = std::exchange(high, counted(high.first + step));
    }
    return bisected(low, high, request.share, columns, [&](double coverage) {
        const std::int64_t count = counted(coverage).second;
        return Count{count, count};
    });
}

FoundCover find_cover(const CloudPlan& plan, const CoverRequest& request,
                      const BakeOptions& options) {
    const CoverSearch search(plan, request, options);
    if (options.cancelled()) return {};
    return search.search();
}

}  // namespace skybake::cloud
