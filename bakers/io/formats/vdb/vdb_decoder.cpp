// What a VDB file says of itself and of its grids.
#include "bakers/io/formats/vdb/vdb_library.h"

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include "bakers/io/formats/vdb/vdb_input.h"

namespace skybake::vdb {
namespace {

namespace io = openvdb::io;

// "float", "half", "int32", "vec3s", "bool", "points", "mask".
std::string value_type_of(const openvdb::GridBase& grid, bool half) {
    // The library calls the values of a mask bool; its tree is Tree_mask_5_4_3.
    const std::string tree = grid.type();
    const std::size_t begin = tree.find('_') + 1;
    const std::string type = tree.substr(begin, tree.find('_', begin) - begin);
    if (type.starts_with("ptdataidx")) return "points";
    return half && type == "float" ? "half" : type;
}

VdbGrid describe(const Grid& head) {
    using openvdb::GridBase;
    const GridBase& grid = *head.grid;
    VdbGrid described;
    described.name = io::GridDescriptor::nameAsString(head.descriptor.uniqueName());
    described.half = head.descriptor.saveFloatAsHalf();
    described.type = grid.type();
    described.value_type = value_type_of(grid, described.half);
    described.grid_class = GridBase::gridClassToString(grid.getGridClass());
    described.compression = io::compressionToString(head.compression);
    const openvdb::Vec3d edges = grid.voxelSize();
    const openvdb::Vec3d centre = grid.transform().indexToWorld(openvdb::Coord(0, 0, 0));
    described.voxel_size = {edges[0], edges[1], edges[2]};
    described.first_centre = std::array{centre[0], centre[1], centre[2]};
    const auto first = stated_vector(grid, GridBase::META_FILE_BBOX_MIN);
    const auto last = stated_vector(grid, GridBase::META_FILE_BBOX_MAX);
    described.states_active = first && last;
    for (std::size_t i = 0; described.states_active && i < 3; ++i) {
        described.first_active[i] = (*first)[i];
        described.last_active[i] = (*last)[i];
        described.empty = described.empty || (*last)[i] < (*first)[i];
    }
    using openvdb::Int64Metadata;
    const auto count = grid.getMetadata<Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
    if (count) described.active_voxels = count->value();
    described.empty = described.empty || (count && count->value() == 0);
    described.metadata = texts_of(grid);
    return described;
}

}  // namespace

Outcome<VdbFile> read(const std::filesystem::path& path) {
    return reported<VdbFile>(path, [&] {
        Input input(path);
        VdbFile file;
        file.uuid = input.getUniqueTag();
        file.library = input.version();
        openvdb::MetaMap metadata;
        input.read_metadata(metadata);
        file.attributes = texts_of(metadata);
        for (const Grid& grid : read_grid_heads(input)) file.grids.push_back(describe(grid));
        return file;
    });
}

}  // namespace skybake::vdb
