// VDB files that OpenVDB itself writes, and the voxels that it finds in them.
#pragma once

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <filesystem>
#include <string>

#include "bakers/io/formats/vdb/vdb_source.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake::testing {

using openvdb::Coord;
using openvdb::FloatGrid;

// A grid with leaves, active and inactive voxels, and tiles on all levels, around the origin.
inline FloatGrid::Ptr any_grid(float background = 0) {
    openvdb::initialize();
    FloatGrid::Ptr grid = FloatGrid::create(background);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    FloatGrid::Accessor voxels = grid->getAccessor();
    for (int i = 0; i < 400; ++i) {
        const Coord at(i * 7 % 61 - 20, i * 13 % 45 - 5, i * 29 % 37);
        const float value = static_cast<float>(i % 97) / 97;
        if (i % 5 == 0) {
            voxels.setValueOff(at, value);
        } else {
            voxels.setValueOn(at, value);
        }
    }
    grid->fill({Coord(-32, 0, 8), Coord(-25, 7, 15)}, 0.75F);      // a tile of 8
    grid->fill({Coord(0, -16, 0), Coord(7, -9, 7)}, 0.5F, false);  // an inactive one
    return grid;
}

// Tiles of 128, 4096 and 8 voxels.
inline FloatGrid::Ptr tiles_of_every_size() {
    FloatGrid::Ptr grid = FloatGrid::create(0);
    grid->setName("density");
    grid->tree().addTile(2, Coord(128, 0, 0), 0.25F, true);
    grid->tree().addTile(3, Coord(-4096, 0, 0), 0.5F, true);
    grid->tree().addTile(1, Coord(0, 0, 0), 0.75F, true);
    return grid;
}

// any_grid() with voxels of 0.5, and what `change` makes of its transform.
template <class Change>
FloatGrid::Ptr transformed_grid(const Change& change) {
    FloatGrid::Ptr grid = any_grid();
    const auto transform = openvdb::math::Transform::createLinearTransform(0.5);
    change(*transform);
    grid->setTransform(transform);
    return grid;
}

// Voxels of 2 x 3 x 4, the centre of voxel (0, 0, 0) at (10, 20, 30).
inline FloatGrid::Ptr scaled_and_moved_grid() {
    return transformed_grid([](openvdb::math::Transform& transform) {
        transform.preScale(openvdb::Vec3d(4, 6, 8));
        transform.postTranslate(openvdb::Vec3d(10, 20, 30));
    });
}

// Returns what a reader says of a file that it refuses; empty where it opens the file.
inline std::string reason_of(const config::Outcome<FileVoxels>& voxels) {
    if (voxels.value) return "";
    const std::string& message = voxels.diagnostics.at(0).message;
    const std::size_t at = message.find(" file: ");
    return at == std::string::npos ? message : message.substr(at + 7);
}

inline void write_grid(const openvdb::GridBase::Ptr& grid, const std::filesystem::path& path,
                       std::uint32_t compression = openvdb::io::COMPRESS_BLOSC |
                                                   openvdb::io::COMPRESS_ACTIVE_MASK) {
    openvdb::io::File file(path.string());
    file.setCompression(compression);
    file.write({grid});
}

inline FileVoxels opened(const std::filesystem::path& path, const std::string& grid = "density") {
    return test::without_diagnostics(open_vdb_grid(path, grid, VolumePart::voxels));
}

// A grid as its file has it, which is gone again.
inline FileVoxels written(const openvdb::GridBase::Ptr& grid,
                          std::uint32_t compression = openvdb::io::COMPRESS_BLOSC |
                                                      openvdb::io::COMPRESS_ACTIVE_MASK) {
    const TemporaryFolder folder;
    write_grid(grid, folder / "v.vdb", compression);
    return opened(folder / "v.vdb");
}

// Expects that voxels of a box are those that a library finds at an index of the file.
template <class Index, class Wanted>
void expect_voxels_at(const FileVoxels& file, const VoxelBox& box, const Wanted& wanted,
                      float tolerance = 0) {
    ASSERT_NE(file.voxels, nullptr);
    const std::vector<float> values = planes_of(*file.voxels, box, 1)[0];
    std::size_t i = 0;
    int wrong = 0;
    for_each_voxel(box.size, [&](int x, int y, int z) {
        const Index at(box.origin[0] + x, box.origin[1] + y, box.origin[2] + z);
        if (std::abs(values[i++] - wanted(at)) > tolerance) ++wrong;
    });
    EXPECT_EQ(wrong, 0) << "of " << values.size();
}

inline void expect_same_voxels(const FloatGrid& grid, const FileVoxels& file, const VoxelBox& box,
                               float tolerance = 0) {
    const FloatGrid::ConstAccessor voxels = grid.getConstAccessor();
    expect_voxels_at<Coord>(
        file, box, [&](const Coord& at) { return voxels.getValue(at); }, tolerance);
}

// Expects that the volume is the box of the active voxels.
inline void expect_active_box(const FloatGrid& grid, const FileVoxels& file) {
    const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        EXPECT_EQ(file.first[axis], active.min()[i]);
        EXPECT_EQ(file.size[axis], active.dim()[i]);
    }
}

}  // namespace skybake::testing

namespace skybake {

// Tests speak of these.
using testing::any_grid;
using testing::Coord;
using testing::FloatGrid;
using testing::write_grid;

}  // namespace skybake
