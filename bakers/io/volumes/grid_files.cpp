#include "bakers/io/volumes/grid_files.h"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/nvdb/nvdb_file.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"
#include "bakers/io/formats/nvdb/nvdb_source.h"
#include "bakers/io/formats/vdb/vdb_source.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

bool holds_vectors(const VdbGrid& grid) { return grid.value_type == "vec3s"; }

bool is_nanovdb(const fs::path& path) {
    Outcome<FileInput> file = FileInput::open(path);
    return file.value && file_part(*file.value, 0, 7) == "NanoVDB";
}

// Passes voxels on, eight planes at a time, so that each leaf is read once.
bool visit_slabs(const std::vector<FileVoxels>& grids, const std::array<int, 3>& size,
                 const VoxelVisitor& visit) {
    std::vector<float> channel, voxels;
    for (int z = 0; z < size[2]; z += nvdb_leaf_edge) {
        const VoxelBox slab{{0, 0, z}, {size[0], size[1], std::min(nvdb_leaf_edge, size[2] - z)}};
        channel.resize(static_cast<std::size_t>(slab.count()));
        voxels.resize(channel.size() * grids.size());
        for (std::size_t c = 0; c < grids.size(); ++c) {
            grids[c].voxels->fill(slab, {channel.data()});
            float* to = voxels.data() + c;
            for (const float value : channel) {
                *to = value;
                to += grids.size();
            }
        }
        const std::int64_t first = slab.count() / slab.size[2] * z;
        if (!visit(first, slab.count(), voxels.data())) return false;
    }
    return true;
}

}  // namespace

bool has_grids(const fs::path& path) {
    return path.extension() == ".vdb" || path.extension() == ".nvdb";
}

std::vector<std::string> channels_of(const VdbGrid& grid) {
    if (!holds_vectors(grid)) return {grid.name};
    return {grid.name + ".x", grid.name + ".y", grid.name + ".z"};
}

Outcome<VdbFile> read_grids(const fs::path& path) {
    return is_nanovdb(path) ? read_nvdb_facts(path) : read_vdb(path);
}

Outcome<FileVoxels> open_numbers(const fs::path& path, const std::string& grid) {
    return is_nanovdb(path) ? open_nvdb_grid(path, grid, VolumePart::numbers)
                            : open_vdb_grid(path, grid, VolumePart::numbers);
}

Outcome<FileFacts> inspect_grids(FileInput& input) {
    const fs::path& path = input.path();
    const Outcome<VdbFile> file = read_grids(path);
    if (!file.value) return {{}, file.diagnostics};
    FileFacts facts;
    std::string type;
    for (const VdbGrid& grid : file.value->grids) {
        const std::vector<std::string> channels = channels_of(grid);
        facts.names.insert(facts.names.end(), channels.begin(), channels.end());
        const std::string own = !holds_vectors(grid) ? grid.value_type
                                : grid.half          ? "half"
                                                     : "float";
        if (type.empty()) type = own;
        if (own != type) return damaged_file(path, "VDB", "its grids are of different types");
    }
    if (type == to_string(PixelType::half)) facts.pixel_type = PixelType::half;
    if (!facts.pixel_type && !is_nanovdb(path)) facts.pixel_type = PixelType::float32;
    facts.channels = facts.names.size();
    for (const auto& [name, text] : file.value->attributes) {
        if (name == metadata_name) facts.metadata = text;
    }
    return {std::move(facts), {}};
}

Outcome<bool> read_grid_voxels(FileInput& input, const FileShape& shape, int,
                               const VoxelVisitor& visit) {
    const fs::path& path = input.path();
    const Outcome<FileFacts> facts = inspect_grids(input);
    if (!facts.value) return {{}, facts.diagnostics};
    const bool is_open = is_nanovdb(path);  // its size is not stated
    bool fits = facts.value->channels == shape.channels;
    std::vector<FileVoxels> grids;
    for (const std::string& name : facts.value->names) {
        Outcome<FileVoxels> grid = open_numbers(path, name);
        if (!grid.value) return {{}, std::move(grid.diagnostics)};
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t end = std::int64_t{grid.value->first[a]} + grid.value->size[a];
            fits = fits && grid.value->first[a] >= 0 && end <= shape.size[a];
        }
        fits = fits && (is_open || grid.value->size == shape.size);
        grids.push_back(std::move(*grid.value));
    }
    if (!fits) return other_size(path);
    try {
        return {visit_slabs(grids, shape.size, visit), {}};
    } catch (const std::exception& error) {
        return damaged_file(path, "VDB", error.what());
    }
}

}  // namespace skybake
