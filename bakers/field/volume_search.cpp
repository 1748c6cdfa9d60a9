#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "bakers/field/certify.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/voxel_array.h"

namespace skybake {
namespace {

constexpr std::int64_t kMostVoxels = 1 << 18;

// From the middles of voxels to the next, and to the volume's ends.
std::vector<std::vector<double>> voxel_edges(const Level& level) {
    std::vector<std::vector<double>> edges;
    for (const int size : level.size) {
        std::vector<double> axis = {0};
        for (int i = 0; i < size && size > 1; ++i) axis.push_back((i + 0.5) / size);
        axis.push_back(1);
        edges.push_back(std::move(axis));
    }
    return edges;
}

// Estimates the errors in the cells of voxels.
class VoxelBends {
  public:
    VoxelBends(const Level& level, PixelType type, const SearchGrid& grid,
               const VolumeComparison& comparison, const BakeOptions& options)
        : level_(level),
          grid_(grid),
          comparison_(comparison),
          values_(level.size, level.statistics.size()) {
        std::vector<float*> targets;
        for (std::size_t c = 0; c < values_.channels(); ++c) {
            targets.push_back(values_.channel(c).data());
        }
        if (options.cancelled()) return;
        level.voxels->fill({{}, level.size}, targets);
        const auto count = static_cast<std::size_t>(VoxelBox{{}, level.size}.count());
        for (float* const target : targets) round_values(target, count, type);
    }

    double expected(std::size_t cell) const {
        const SearchPlace uvw = grid_.middle(cell);
        std::array<int, 3> voxel{};
        for (std::size_t a = 0; a < 3; ++a) {
            voxel[a] =
                std::clamp(static_cast<int>(uvw[a] * level_.size[a] - 0.5), 0, level_.size[a] - 1);
        }
        std::vector<double> exact;
        std::vector<double> found;
        for (std::size_t c = 0; c < values_.channels(); ++c) {
            const std::vector<float>& channel = values_.channel(c);
            double off = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                off += std::max(bend(channel, voxel, a, 0), bend(channel, voxel, a, 1));
            }
            exact.push_back(double{channel[offset(voxel)]});
            found.push_back(exact.back() + off / 8);
        }
        double largest = 0;
        for (const double error : errors_of(level_, comparison_, uvw, found, exact)) {
            if (std::isfinite(error)) largest = std::max(largest, std::fabs(error));
        }
        return largest;
    }

  private:
    std::size_t offset(const std::array<int, 3>& voxel) const {
        return values_.offset(voxel[0], voxel[1], voxel[2]);
    }

    // The second difference at the voxel, or at the next one along the axis.
    double bend(const std::vector<float>& values, std::array<int, 3> voxel, std::size_t axis,
                int next) const {
        const int last = level_.size[axis] - 1;
        if (last < 2) return 0;
        voxel[axis] = std::clamp(voxel[axis] + next, 1, last - 1);
        const double middle = double{values[offset(voxel)]};
        --voxel[axis];
        const double before = double{values[offset(voxel)]};
        voxel[axis] += 2;
        return std::fabs(before - 2 * middle + double{values[offset(voxel)]});
    }

    const Level& level_;
    const SearchGrid& grid_;
    const VolumeComparison& comparison_;
    VoxelArray values_;
};

}  // namespace

VolumeErrors search_volume(const Level& level, PixelType type, const VolumeReference& reference,
                           const VolumeReference& estimate, const SearchCounts& counts,
                           const BakeOptions& options, const VolumeComparison& comparison) {
    // An axis of one voxel is looked up at the voxel's centre.
    const auto lookup_place = [&](SearchPlace place) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (level.size[a] == 1) place[a] = 0.5;
        }
        return comparison.lookup_place ? comparison.lookup_place(place) : place;
    };
    const auto errors_against = [&](const VolumeReference& wanted) -> RowErrors {
        return [&](const SearchPlace& row, const std::vector<SearchPlace>& points,
                   PointError* errors) {
            const SearchPlace uvw = lookup_place(row);
            const std::vector<double> at_place =
                errors_of(level, comparison, uvw, look_up(level, type, uvw), wanted(uvw));
            std::fill_n(errors, points.size(), PointError::of(at_place.data(), at_place.size()));
        };
    };
    LookupSearch search = {
        SearchGrid(voxel_edges(level)), SearchGrid({}), errors_against(reference), {}, {}};
    if (estimate && counts.exact > 0) search.estimate = errors_against(estimate);
    std::optional<VoxelBends> bends;
    if (VoxelBox{{}, level.size}.count() <= kMostVoxels) {
        bends.emplace(level, type, search.rows, comparison, options);
        search.expected = [&bends](std::size_t cell, std::size_t) { return bends->expected(cell); };
    }
    SearchCounts of_places = counts;
    of_places.per_row = 1;
    const FoundErrors found = search_errors(search, of_places, options);
    return {found.figures, lookup_place(found.worst_row), found.points};
}

}  // namespace skybake
