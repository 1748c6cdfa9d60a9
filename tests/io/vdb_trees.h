// Trees as OpenVDB writes them, and files of write_vdb held to them.
#pragma once

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "config/sections/file_formats.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/vdb_samples.h"

namespace skybake::testing {

// The bytes that OpenVDB makes of a tree.
inline std::string tree_bytes(const openvdb::FloatGrid& grid, config::VdbCompression compression,
                              config::PixelType type) {
    std::uint32_t flags = openvdb::io::COMPRESS_ACTIVE_MASK;
    if (compression == config::VdbCompression::zip) flags |= openvdb::io::COMPRESS_ZIP;
    if (compression == config::VdbCompression::blosc) flags |= openvdb::io::COMPRESS_BLOSC;
    std::ostringstream out;
    openvdb::io::setDataCompression(out, flags);
    const bool half = type == config::PixelType::half;
    grid.tree().writeTopology(out, half);
    grid.tree().writeBuffers(out, half);
    return out.str();
}

// Returns the values that the file is to hold of a channel: x fastest, then y, then z.
inline std::vector<float> stored_values(const Baked& volume, int channel) {
    std::vector<float> values = voxels_of(volume, static_cast<std::size_t>(channel));
    for (float& value : values) {
        value = round_to_pixel_type(double{value}, volume.pixel_type);
        if (value == 0) value = 0;  // not -0
    }
    return values;
}

// The plain way: a tree in which voxels are set; of a sparse volume those that are not 0.
inline openvdb::FloatGrid::Ptr plain_grid(const std::vector<float>& values, const Baked& volume) {
    openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0F);
    openvdb::FloatGrid::Accessor accessor = grid->getAccessor();
    std::size_t i = 0;
    for_each_voxel(volume.levels[0].size, [&](int x, int y, int z) {
        const float value = values[i++];
        if (value != 0 || !volume.sparse) accessor.setValueOn(openvdb::Coord(x, y, z), value);
    });
    return grid;
}

// Whether two trees have the same nodes, active voxels and values, bit by bit.
inline bool are_equal(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
    if (!a.tree().hasSameTopology(b.tree())) return false;
    auto other = b.cbeginValueAll();
    for (auto value = a.cbeginValueAll(); value; ++value, ++other) {
        if (!other || *value != *other || std::signbit(*value) != std::signbit(*other)) {
            return false;
        }
    }
    return !other;
}

inline std::vector<std::string> grid_names(const Baked& volume) {
    if (!volume.grid_names.empty()) return volume.grid_names;
    if (volume.channel_names.size() == 1) return {"density"};
    return volume.channel_names;
}

// Returns the faults of a file that write_vdb made of the volume, as OpenVDB reads it.
inline std::string wrong_for_openvdb(const Baked& volume, const std::filesystem::path& path) {
    openvdb::initialize();
    const auto& size = volume.levels[0].size;
    openvdb::io::File file(path.string());
    file.open();
    for (std::size_t channel = 0; channel < volume.channel_names.size(); ++channel) {
        const std::vector<float> values = stored_values(volume, static_cast<int>(channel));
        const openvdb::FloatGrid::Ptr wanted = plain_grid(values, volume);
        const auto grid =
            openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(grid_names(volume)[channel]));
        if (!are_equal(*grid, *wanted)) return "the tree of a grid";
        if (grid->getGridClass() != openvdb::GRID_FOG_VOLUME) return "the class";
        openvdb::CoordBBox bounds = wanted->evalActiveVoxelBoundingBox();
        if (wanted->empty())
            bounds = {openvdb::Coord(0), openvdb::Coord(size[0], size[1], size[2]).offsetBy(-1)};
        if (grid->metaValue<openvdb::Vec3i>("file_bbox_min") != bounds.min().asVec3i() ||
            grid->metaValue<openvdb::Vec3i>("file_bbox_max") != bounds.max().asVec3i()) {
            return "the bounds";
        }
        const auto count = static_cast<std::int64_t>(wanted->activeVoxelCount());
        if (grid->metaValue<openvdb::Int64>("file_voxel_count") != count) return "the count";
        if (volume.sparse &&
            grid->metaValue<openvdb::Vec3i>("skybake/size") != openvdb::Vec3i(size.data())) {
            return "the size";
        }
        if (channel + 1 < volume.channel_names.size()) continue;
        const std::string bytes = read_bytes(path);
        if (!bytes.ends_with(tree_bytes(*wanted, volume.vdb_compression, volume.pixel_type)))
            return "the bytes of the last tree";
    }
    return "";
}

// Returns the faults of the file as verify reads it.
inline std::string wrong_for_us(const Baked& volume, const std::filesystem::path& path) {
    const std::size_t channels = volume.channel_names.size();
    const std::vector<float> found = texels_of(config::FileFormat::vdb, volume, 0, path);
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::vector<float> wanted = stored_values(volume, static_cast<int>(channel));
        if (found.size() != channels * wanted.size()) return "the number of voxels";
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (found[channels * i + channel] != wanted[i]) return "the voxels";
        }
    }
    return "";
}

// Returns the faults of the file that write_vdb makes of the volume; empty if there are none.
inline std::string wrong_with(const Baked& volume) {
    const TemporaryFolder folder;
    const auto path = folder / "v.vdb";
    const auto written = write_sample(volume, path);
    if (!written.value) return written.diagnostics.at(0).message;
    const std::string wrong = wrong_for_openvdb(volume, path);
    return wrong.empty() ? wrong_for_us(volume, path) : wrong;
}

}  // namespace skybake::testing
