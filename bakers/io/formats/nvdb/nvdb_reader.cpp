#include "bakers/io/formats/nvdb/nvdb_file.h"

#include <utility>

#include "bakers/io/formats/nvdb/nvdb_input.h"
#include "bakers/io/volumes/grid_files.h"
#include "config/sections/file_formats.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

std::string class_name(nanovdb::GridClass grid_class) {
    constexpr std::array names = {"unknown", "level set", "fog volume", "staggered"};
    const auto number = static_cast<std::size_t>(grid_class);
    return number < names.size() ? names[number] : fmt::format("class {}", number);
}

}  // namespace

Outcome<VdbFile> read_nvdb_facts(const fs::path& path) {
    return with_nvdb_file<VdbFile>(path, [&](NvdbInput& file) -> Outcome<VdbFile> {
        VdbFile facts;
        for (const NvdbGrid& grid : file.grids()) {
            const NvdbGridHead& head = grid.head;
            facts.library =
                fmt::format("NanoVDB {}.{}", head.version.getMajor(), head.version.getMinor());
            constexpr std::array codecs = {"none", "zip", "blosc"};
            VdbGrid& one = facts.grids.emplace_back();
            one.name = grid.name;
            one.type = one.value_type = nvdb_type_name(head.type);
            one.grid_class = class_name(head.grid_class);
            one.compression = head.codec < codecs.size() ? codecs[head.codec] : "unknown";
            one.active_voxels = static_cast<std::int64_t>(head.active_voxels);
            one.states_active = true;
            one.empty = one.active_voxels == 0;
            one.voxel_size = head.voxel_size;
            for (nanovdb::Coord::IndexType a = 0; a < 3; ++a) {
                one.first_active[static_cast<std::size_t>(a)] = head.bounds.min()[a];
                one.last_active[static_cast<std::size_t>(a)] = head.bounds.max()[a];
            }
        }
        const std::string description = file.description();
        if (!description.empty()) facts.attributes.emplace_back(metadata_name, description);
        return {std::move(facts), {}};
    });
}

Format nvdb_format() {
    return {.format = config::FileFormat::nvdb,
            .write = write_nvdb,
            .inspect = inspect_grids,
            .read = read_grid_voxels,
            .grids = vdb_grid_names};
}

}  // namespace skybake
