#include "bakers/io/volumes/file_voxels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace skybake {

std::string words_of_fault(const ValueFaults::Kind& kind, const char* what) {
    const std::string first =
        fmt::format("its voxel ({}) is {}", fmt::join(kind.index, ", "), kind.value);
    return kind.count == 1
               ? first
               : fmt::format("{}, the first of {} that are {}", first, kind.count, what);
}

std::string refusal_of(const ValueFaults& faults) {
    return words_of_fault(faults.not_finite, "not finite") +
           "; not_finite = \"background\" takes the background in their place";
}

namespace {

// A box of space's axes along those of indices, or the other way round.
VoxelBox box_of_indices(const IndexAxes& axes, const VoxelBox& box) {
    VoxelBox indices;
    for (std::size_t a = 0; a < 3; ++a) {
        const int last = box.origin[a] + box.size[a] - 1;
        indices.origin[axes.index[a]] = axes.falls[a] ? -last : box.origin[a];
        indices.size[axes.index[a]] = box.size[a];
    }
    return indices;
}

class TurnedVoxels : public VoxelSource {
  public:
    TurnedVoxels(IndexAxes axes, std::shared_ptr<const VoxelSource> voxels)
        : axes_(axes), voxels_(std::move(voxels)) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        const VoxelBox indices = box_of_indices(axes_, box);
        std::vector<float> values(static_cast<std::size_t>(indices.count()));
        voxels_->fill(indices, {values.data()});
        const std::array<std::int64_t, 3> strides = {
            1, indices.size[0], std::int64_t{indices.size[0]} * indices.size[1]};
        std::array<std::int64_t, 3> steps{};  // between neighbours along x, y and z of space
        std::int64_t from = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t stride = strides[axes_.index[a]];
            steps[a] = axes_.falls[a] ? -stride : stride;
            if (axes_.falls[a]) from += stride * (box.size[a] - 1);
        }
        float* out = channels[0];
        for (int z = 0; z < box.size[2]; ++z) {
            for (int y = 0; y < box.size[1]; ++y) {
                std::int64_t at = from + z * steps[2] + y * steps[1];
                for (int x = 0; x < box.size[0]; ++x, at += steps[0]) {
                    *out++ = values[static_cast<std::size_t>(at)];
                }
            }
        }
    }

    bool is_empty(const VoxelBox& box) const override {
        return voxels_->is_empty(box_of_indices(axes_, box));
    }

  private:
    const IndexAxes axes_;
    const std::shared_ptr<const VoxelSource> voxels_;
};

// The axis of space along which a step leads, or none where it leads along several or nowhere.
std::optional<std::size_t> axis_of(const std::array<double, 3>& step) {
    constexpr double rounding = 1e-9;
    std::size_t axis = 0;
    for (std::size_t j = 1; j < 3; ++j) {
        if (std::fabs(step[j]) > std::fabs(step[axis])) axis = j;
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const bool is_apart = std::fabs(step[j]) <= rounding * std::fabs(step[axis]);
        if (j != axis && !is_apart) return std::nullopt;
    }
    return step[axis] == 0 ? std::nullopt : std::optional(axis);
}

}  // namespace

std::optional<std::string> read_index_map(const IndexMap& map, FileVoxels& voxels,
                                          IndexAxes& axes) {
    std::array<bool, 3> taken{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<std::size_t> axis = axis_of(map.steps[i]);
        if (!axis || taken[*axis]) {
            return "its transform turns the axes by other than right angles, or shears them";
        }
        const double step = map.steps[i][*axis];
        const double centre = map.centre[*axis];
        if (!std::isfinite(step) || !std::isfinite(centre)) return "its transform is not finite";
        taken[*axis] = true;
        axes.index[*axis] = i;
        axes.falls[*axis] = step < 0;
        voxels.voxel_size[*axis] = std::fabs(step);
        voxels.index_origin[*axis] = centre - std::fabs(step) / 2;
    }
    return std::nullopt;
}

void turn_to_space(const IndexAxes& axes, FileVoxels& voxels) {
    if (axes.are_plain()) return;
    const VoxelBox indices{voxels.first, voxels.size};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t i = axes.index[a];
        voxels.size[a] = indices.size[i];
        const int last = indices.origin[i] + indices.size[i] - 1;
        voxels.first[a] = axes.falls[a] ? -last : indices.origin[i];
    }
    if (voxels.voxels)
        voxels.voxels = std::make_shared<TurnedVoxels>(axes, std::move(voxels.voxels));
}

std::optional<std::string> find_grid_name(const std::vector<GridName>& grids,
                                          const std::string& asked, std::size_t& number) {
    const std::string wanted = asked.empty() ? "density" : asked;
    auto found = std::ranges::find(grids, wanted, &GridName::name);
    const bool takes_any = asked.empty() && (found == grids.end() || !found->is_of_numbers);
    if (takes_any && std::ranges::count(grids, true, &GridName::is_of_numbers) == 1) {
        found = std::ranges::find(grids, true, &GridName::is_of_numbers);
    }
    number = static_cast<std::size_t>(found - grids.begin());
    if (found != grids.end()) return std::nullopt;
    if (grids.empty()) return "it has no grids";
    std::vector<std::string> choices;
    for (const GridName& grid : grids) {
        if (grid.is_of_numbers) choices.push_back(fmt::format("grid = \"{}\"", grid.name));
    }
    if (choices.empty()) return "it has no grid of numbers";
    return fmt::format("it has no grid `{}`; write {}", wanted, fmt::join(choices, " or "));
}

}  // namespace skybake
