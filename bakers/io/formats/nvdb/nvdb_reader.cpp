#include "bakers/io/formats/nvdb/nvdb_reader.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bakers/io/formats/nvdb/nvdb_input.h"
#include "bakers/io/formats/nvdb/nvdb_tree.h"

namespace skybake {
namespace {

using config::Outcome;
namespace fs = std::filesystem;

// Writes the voxels of a cube to their places in eight slices, of which the first is the cube's.
void copy_to_slab(const NvdbLeafValues& values, const FileShape& shape,
                  const std::array<int, 3>& corner, float* slab) {
    std::array<int, 3> count;
    for (std::size_t a = 0; a < 3; ++a) {
        count[a] = std::min(nvdb_leaf_edge, shape.size[a] - corner[a]);
    }
    for (int k = 0; k < count[2]; ++k) {
        for (int j = 0; j < count[1]; ++j) {
            const std::int64_t row =
                (std::int64_t{k} * shape.size[1] + corner[1] + j) * shape.size[0] + corner[0];
            float* out = slab + static_cast<std::size_t>(row) * shape.channels;
            for (int i = 0; i < count[0]; ++i, out += shape.channels) {
                *out = values[static_cast<std::size_t>(64 * i + 8 * j + k)];
            }
        }
    }
}

void expect_within(const NvdbTree& tree, const FileShape& shape) {
    for (const NvdbCube& cube : tree.leaf_cubes()) {
        for (std::size_t a = 0; a < 3; ++a) {
            expect_nvdb(cube.corner[a] >= 0 && cube.corner[a] < shape.size[a],
                        "a leaf lies beyond the volume");
        }
    }
}

// Passes the voxels to `visit`, eight slices at a time. Returns false once it has returned false.
bool visit_nvdb_slabs(NvdbInput& file, const FileShape& shape, const VoxelVisitor& visit) {
    std::vector<NvdbTree> trees;
    for (const NvdbGrid& grid : file.grids()) {
        trees.emplace_back(file, grid);
        expect_within(trees.back(), shape);
    }
    const std::int64_t slice = std::int64_t{shape.size[0]} * shape.size[1];
    std::vector<float> slab;
    std::vector<NvdbUnit> memory;
    NvdbLeafValues values;
    for (int z = 0; z < shape.size[2]; z += nvdb_leaf_edge) {
        const int depth = std::min(nvdb_leaf_edge, shape.size[2] - z);
        slab.assign(static_cast<std::size_t>(slice * depth) * shape.channels, 0.0F);
        for (std::size_t c = 0; c < trees.size(); ++c) {
            for (int y = 0; y < shape.size[1]; y += nvdb_leaf_edge) {
                for (int x = 0; x < shape.size[0]; x += nvdb_leaf_edge) {
                    const NvdbCube* cube = trees[c].find({x, y, z});
                    if (cube == nullptr) continue;
                    values.fill(cube->value);
                    if (cube->leaf != 0) {
                        read_nvdb_leaf(file, file.grids()[c].head.type, cube->leaf, memory, values);
                    }
                    copy_to_slab(values, shape, {x, y, z}, slab.data() + c);
                }
            }
        }
        if (!visit(z * slice, depth * slice, slab.data())) return false;
    }
    return true;
}

std::string class_name(nanovdb::GridClass grid_class) {
    constexpr std::array names = {"unknown", "level set", "fog volume", "staggered"};
    const auto number = static_cast<std::size_t>(grid_class);
    return number < names.size() ? names[number] : fmt::format("class {}", number);
}

}  // namespace

Outcome<NvdbFacts> read_nvdb_facts(const fs::path& path) {
    return with_nvdb_file<NvdbFacts>(path, [&](NvdbInput& file) -> Outcome<NvdbFacts> {
        NvdbFacts facts;
        for (const NvdbGrid& grid : file.grids()) {
            const NvdbGridHead& head = grid.head;
            facts.version =
                fmt::format("NanoVDB {}.{}", head.version.getMajor(), head.version.getMinor());
            constexpr std::array codecs = {"none", "zip", "blosc"};
            NvdbGridFacts one{grid.name, nvdb_type_name(head.type), class_name(head.grid_class),
                              head.codec < codecs.size() ? codecs[head.codec] : "unknown"};
            one.active_voxels = static_cast<std::int64_t>(head.active_voxels);
            one.voxel_size = head.voxel_size;
            for (nanovdb::Coord::IndexType a = 0; a < 3; ++a) {
                one.first[static_cast<std::size_t>(a)] = head.bounds.min()[a];
                one.last[static_cast<std::size_t>(a)] = head.bounds.max()[a];
            }
            facts.grids.push_back(std::move(one));
        }
        return {std::move(facts), {}};
    });
}

Outcome<FileFacts> inspect_nvdb(const fs::path& path) {
    return with_nvdb_file<FileFacts>(path, [&](NvdbInput& file) -> Outcome<FileFacts> {
        FileFacts facts;
        const nanovdb::GridType type = file.grids().front().head.type;
        for (const NvdbGrid& grid : file.grids()) {
            file.grid_data(grid);
            expect_nvdb(grid.head.type == type, "its grids are of different types");
            facts.names.push_back(grid.name);
        }
        facts.channels = facts.names.size();
        if (type == nanovdb::GridType::Fp8) facts.pixel_type = config::PixelType::fp8;
        if (type == nanovdb::GridType::Fp16) facts.pixel_type = config::PixelType::fp16;
        facts.metadata = file.description();
        return {std::move(facts), {}};
    });
}

Outcome<bool> read_nvdb(const fs::path& path, const FileShape& shape, const VoxelVisitor& visit) {
    return with_nvdb_file<bool>(path, [&](NvdbInput& file) -> Outcome<bool> {
        for (const NvdbGrid& grid : file.grids()) {
            const bool fits = file.grids().size() == shape.channels &&
                              grid.head.type == nvdb_grid_type(shape.pixel_type);
            if (!fits) return {{}, {other_size(path)}};
        }
        return {visit_nvdb_slabs(file, shape, visit), {}};
    });
}

}  // namespace skybake
