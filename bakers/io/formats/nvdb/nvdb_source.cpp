#include "bakers/io/formats/nvdb/nvdb_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bakers/io/formats/nvdb/nvdb_input.h"
#include "bakers/io/formats/nvdb/nvdb_tree.h"
#include "bakers/io/volumes/file_voxels.h"
#include "bakers/io/volumes/grid_voxels.h"

namespace skybake {
namespace {

// The tree's corner that a part of a box lies in.
std::array<int, 3> leaf_of(const VoxelBox& part) {
    std::array<int, 3> corner = part.origin;
    for (int& i : corner) i &= ~(nvdb_leaf_edge - 1);
    return corner;
}

class NvdbVoxels : public VoxelSource {
  public:
    // Without `makes_densities`, values stay as the file has them.
    NvdbVoxels(NvdbInput file, nanovdb::GridType type, NvdbTree tree, const DensityRamp& density,
               bool makes_densities)
        : file_(std::move(file)),
          type_(type),
          tree_(std::move(tree)),
          makes_densities_(makes_densities),
          density_(density) {}

    // Decodes every leaf once, for the largest value of the grid and the faults, and makes those tiles
    // that hold only zeros.
    void survey(FileVoxels& voxels) {
        expect_nvdb(tree_.has_finite_tiles, "a tile of it is not finite");
        voxels.largest = std::max(density_(tree_.least_tile), density_(tree_.largest_tile));
        std::vector<NvdbUnit> memory;
        LeafValues values;
        for (NvdbCube& cube : tree_.cubes[0]) {
            if (cube.leaf == 0) continue;
            read_nvdb_leaf(file_, type_, cube.leaf, memory, values);
            expect_in_bounds(cube, memory);
            const bool is_zero =
                survey_leaf(cube.corner, density_, tree_.background, values, voxels);
            if (is_zero) cube = {cube.corner, 0, 0};
        }
        if (density_.changes()) voxels.faults.negative = {};
    }

    // Last, because other checks say what is wrong.
    void expect_checksum(const NvdbGrid& grid) { expect_nvdb_checksum(file_, grid); }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        std::vector<NvdbUnit> memory;
        LeafValues values;
        for_cubes(box, nvdb_leaf_edge, [&](const VoxelBox& part) {
            const NvdbCube* cube = tree_.find(leaf_of(part));
            if (cube == nullptr || cube->leaf == 0) {
                const float value = tile_density(cube);
                copy_leaf(
                    part, box, [&](auto) { return value; }, channels[0]);
            } else {
                read(*cube, memory, values);
                if (makes_densities_) make_densities(density_, tree_.background, values);
                copy_leaf(
                    part, box, [&](auto at) { return values[at]; }, channels[0]);
            }
            return true;
        });
    }

    bool is_empty(const VoxelBox& box) const override {
        bool empty = true;
        for_cubes(box, nvdb_leaf_edge, [&](const VoxelBox& part) {
            const NvdbCube* cube = tree_.find(leaf_of(part));
            empty = (cube == nullptr || cube->leaf == 0) && tile_density(cube) == 0;
            return empty;
        });
        return empty;
    }

  private:
    float tile_density(const NvdbCube* cube) const {
        return density_(cube == nullptr ? tree_.background : cube->value);
    }

    // A leaf with active voxels reaches into the bounds that the root states.
    void expect_in_bounds(const NvdbCube& cube, const std::vector<NvdbUnit>& memory) const {
        const auto& leaf = *reinterpret_cast<const NvdbLeaf<float>*>(memory.data());
        if (leaf.mValueMask.isOff()) return;
        for (std::size_t a = 0; a < 3; ++a) {
            expect_nvdb(
                cube.corner[a] <= tree_.last[a] && cube.corner[a] + nvdb_leaf_edge > tree_.first[a],
                "it has active voxels beyond its bounds");
        }
    }

    void read(const NvdbCube& cube, std::vector<NvdbUnit>& memory, LeafValues& values) const {
        const std::lock_guard lock(mutex_);
        try {
            read_nvdb_leaf(file_, type_, cube.leaf, memory, values);
        } catch (const NvdbDamage&) {
            throw std::runtime_error("a volume's file has changed while it was read");
        }
    }

    mutable std::mutex mutex_;  // guards the file
    mutable NvdbInput file_;
    const nanovdb::GridType type_;
    NvdbTree tree_;
    const bool makes_densities_;
    const DensityRamp density_;
};

const NvdbGrid& find_grid(const NvdbInput& file, const std::string& asked) {
    std::vector<GridName> names;
    for (const NvdbGrid& grid : file.grids()) {
        names.push_back({grid.name, nvdb_leaf_bytes(grid.head.type) != 0});
    }
    std::size_t number = 0;
    if (const auto reason = find_grid_name(names, asked, number)) throw NvdbDamage{*reason};
    return file.grids()[number];
}

IndexAxes read_map(const nanovdb::Map& map, FileVoxels& voxels) {
    IndexMap of_indices;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) of_indices.steps[j][i] = map.mMatD[3 * i + j];
        of_indices.centre[i] = map.mVecD[i];
    }
    IndexAxes axes;
    if (const auto reason = read_index_map(of_indices, voxels, axes)) throw NvdbDamage{*reason};
    return axes;
}

void read_bounds(const NvdbTree& tree, VolumePart part, FileVoxels& voxels) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t size = std::int64_t{tree.last[i]} - tree.first[i] + 1;
        if (size <= 0 && part == VolumePart::numbers) {
            voxels.first = voxels.size = {};
            return;
        }
        expect_nvdb(size > 0, "it has no active voxels");
        expect_nvdb(size <= std::numeric_limits<int>::max(), "its active voxels lie too far apart");
        voxels.first[i] = tree.first[i];
        voxels.size[i] = static_cast<int>(size);
    }
}

// The half width of a level set's band (vdb_grid_tree.cpp).
DensityRamp ramp_of(const NvdbTree& tree, nanovdb::GridClass grid_class) {
    if (grid_class != nanovdb::GridClass::LevelSet) return {};
    const DensityRamp ramp(tree.least_tile < 0 ? -tree.least_tile : tree.background);
    expect_nvdb(ramp.is_valid(), "its level set has no half width");
    return ramp;
}

}  // namespace

Outcome<FileVoxels> open_nvdb_grid(const std::filesystem::path& path, const std::string& name,
                                   VolumePart part, config::NotFinite not_finite) {
    return with_nvdb_file<FileVoxels>(path, [&](NvdbInput& file) -> Outcome<FileVoxels> {
        const NvdbGrid grid = find_grid(file, name);
        const nanovdb::GridData data = file.grid_data(grid);
        FileVoxels voxels;
        voxels.has_place = true;
        const IndexAxes axes = read_map(data.mMap, voxels);
        NvdbTree tree(file, grid);
        read_bounds(tree, part, voxels);
        const bool makes_densities = part != VolumePart::numbers;
        const auto density = makes_densities ? ramp_of(tree, data.mGridClass) : DensityRamp();
        voxels.background = density(tree.background);
        if (part != VolumePart::shape) {
            auto source = std::make_shared<NvdbVoxels>(std::move(file), grid.head.type,
                                                       std::move(tree), density, makes_densities);
            if (makes_densities) source->survey(voxels);
            const bool refused =
                not_finite == config::NotFinite::refuse && voxels.faults.not_finite.count > 0;
            if (refused) throw NvdbDamage{refusal_of(voxels.faults)};
            if (makes_densities) source->expect_checksum(grid);
            voxels.voxels = std::move(source);
        }
        turn_to_space(axes, voxels);
        return {std::move(voxels), {}};
    });
}

}  // namespace skybake
