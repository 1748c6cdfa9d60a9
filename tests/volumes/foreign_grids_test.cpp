// Grids as other programs write them: of other numbers, as streams, turned by right angles, under any
// name, with values that are no densities. OpenVDB's own accessors and transforms say what is right.
#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "bakers/io/formats/vdb/vdb_file.h"
#include "tests/support/outcomes.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using testing::expect_same_voxels;
using testing::opened;

std::string message_of(const std::filesystem::path& path, const std::string& grid = "") {
    const auto voxels = open_vdb_grid(path, grid, VolumePart::voxels);
    return voxels.value ? "" : voxels.diagnostics.at(0).message;
}

// Numbers that a float holds exactly, so that the float grid beside it says what is right.
template <class Grid>
void expect_numbers_of(const char* value_type) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto grid = Grid::create(2);
    const FloatGrid::Ptr wanted = FloatGrid::create(2);
    grid->setName("density");
    const auto set_numbers = []<class T>(T& tree) {
        for (int i = 0; i < 500; ++i) {
            const Coord at(i * 7 % 61 - 20, i * 13 % 45 - 5, i * 29 % 37);
            const auto value = static_cast<typename T::ValueType>(i % 97 - 3);
            i % 5 == 0 ? tree.setValueOff(at, value) : tree.setValueOn(at, value);
        }
        tree.fill({Coord(-32, 0, 8), Coord(-25, 7, 15)}, 5);
    };
    set_numbers(grid->tree());
    set_numbers(wanted->tree());
    for (const std::uint32_t compression :
         {std::uint32_t{openvdb::io::COMPRESS_NONE}, std::uint32_t{openvdb::io::COMPRESS_ZIP},
          openvdb::io::COMPRESS_BLOSC | std::uint32_t{openvdb::io::COMPRESS_ACTIVE_MASK}}) {
        write_grid(grid, folder / "v.vdb", compression);
        const FileVoxels file = opened(folder / "v.vdb");
        expect_same_voxels(*wanted, file, {{-40, -30, -9}, {90, 80, 60}});
        EXPECT_EQ(file.background, 2);
    }
    const auto described = read_vdb(folder / "v.vdb");
    EXPECT_EQ(described.value.value().grids.at(0).value_type, value_type);
}

TEST(ForeignGrid, HoldsNumbersOfAnyType) {
    expect_numbers_of<openvdb::DoubleGrid>("double");
    expect_numbers_of<openvdb::Int32Grid>("int32");
    expect_numbers_of<openvdb::Int64Grid>("int64");
}

TEST(ForeignGrid, OfDoublesMayBeStoredAsHalves) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto grid = openvdb::DoubleGrid::create(0);
    grid->setName("density");
    grid->setSaveFloatAsHalf(true);
    const FloatGrid::Ptr wanted = FloatGrid::create(0);
    for (int i = 0; i < 100; ++i) {
        grid->tree().setValue(Coord(i, 2 * i, 3), i / 128.0);
        wanted->tree().setValue(Coord(i, 2 * i, 3), static_cast<float>(i) / 128);
    }
    write_grid(grid, folder / "v.vdb");
    expect_same_voxels(*wanted, opened(folder / "v.vdb"), {{0, 0, 0}, {100, 200, 8}});
}

TEST(ForeignGrid, OfVectorsIsReadByComponent) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const openvdb::Vec3f background(2, 0, -1);
    for (const bool half : {false, true}) {
        const auto velocity = openvdb::Vec3SGrid::create(background);
        velocity->setName("vel");
        velocity->setSaveFloatAsHalf(half);
        std::array<FloatGrid::Ptr, 3> wanted;
        for (int c = 0; c < 3; ++c)
            wanted[static_cast<std::size_t>(c)] = FloatGrid::create(background[c]);
        const auto change = [&](const auto& to) {
            to(velocity->tree(), [](const openvdb::Vec3f& value) { return value; });
            for (int c = 0; c < 3; ++c) {
                to(wanted[static_cast<std::size_t>(c)]->tree(),
                   [c](const openvdb::Vec3f& value) { return value[c]; });
            }
        };
        change([](auto& tree, const auto& part) {
            for (int i = 0; i < 500; ++i) {
                const Coord at(i * 7 % 61 - 20, i * 13 % 45 - 5, i * 29 % 37);
                const auto value = part({float(i % 97 - 3), float(i % 5) / 8, -float(i)});
                i % 5 == 0 ? tree.setValueOff(at, value) : tree.setValueOn(at, value);
            }
            tree.fill({Coord(-32, 0, 8), Coord(-25, 7, 15)}, part({5, 6, 7}));
        });
        for (const std::uint32_t compression :
             {std::uint32_t{openvdb::io::COMPRESS_NONE}, std::uint32_t{openvdb::io::COMPRESS_ZIP},
              openvdb::io::COMPRESS_BLOSC | std::uint32_t{openvdb::io::COMPRESS_ACTIVE_MASK}}) {
            write_grid(velocity, folder / "v.vdb", compression);
            for (std::size_t c = 0; c < 3; ++c) {
                const std::string name = std::string("vel.") + "xyz"[c];
                expect_same_voxels(*wanted[c], opened(folder / "v.vdb", name),
                                   {{-40, -30, -9}, {90, 80, 60}});
            }
        }
        EXPECT_NE(message_of(folder / "v.vdb", "vel").find("holds vectors; write grid = \"vel.x\""),
                  std::string::npos);
    }
}

void write_stream(const openvdb::GridPtrVec& grids, const std::filesystem::path& path) {
    std::ofstream file(path, std::ios::binary);
    openvdb::io::Stream(file).write(grids);
}

TEST(ForeignGrid, MayStandInAStream) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr first = any_grid(0.125F);
    const auto second = openvdb::DoubleGrid::create(0);
    first->setName("density");
    second->setName("heat");
    second->tree().setValue(Coord(7, 8, 9), 3);
    write_stream({first}, folder / "one.vdb");
    write_stream({second, first}, folder / "two.vdb");
    for (const char* name : {"one.vdb", "two.vdb"}) {
        const FileVoxels file = opened(folder / name);
        expect_same_voxels(*first, file, {{-40, -30, -9}, {90, 80, 60}});
        const auto described = test::without_errors(read_vdb(folder / name));
        EXPECT_EQ(described.grids.back().name, "density");
    }
    const auto mask = openvdb::MaskGrid::create();
    mask->setName("m");
    write_stream({mask, first}, folder / "mask.vdb");
    EXPECT_NE(message_of(folder / "mask.vdb").find("stands before others in a stream"),
              std::string::npos);
}

// Where the voxels of a file lie is where OpenVDB's transform has them.
TEST(ForeignGrid, TurnedByRightAnglesOrMirroredIsPermuted) {
    using openvdb::math::Mat4d;
    using openvdb::math::Transform;
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = any_grid();
    const double quarter = std::acos(-1.0) / 2;
    const auto turned = [&](auto&& change) {
        const auto transform = Transform::createLinearTransform(0.5);
        transform->preScale(openvdb::Vec3d(1, 2, 3));
        change(*transform);
        transform->postTranslate(openvdb::Vec3d(10, -20, 30));
        return transform;
    };
    const std::vector<Transform::Ptr> transforms = {
        turned([&](auto& t) { t.postRotate(quarter, openvdb::math::X_AXIS); }),
        turned([&](auto& t) { t.postRotate(-quarter, openvdb::math::Y_AXIS); }),
        turned([&](auto& t) { t.postRotate(2 * quarter, openvdb::math::Z_AXIS); }),
        turned([&](auto& t) {
            t.postRotate(quarter, openvdb::math::Z_AXIS);
            t.postRotate(quarter, openvdb::math::X_AXIS);
        }),
        turned([](auto& t) { t.preScale(openvdb::Vec3d(1, -1, 1)); }),
        turned([](auto& t) {
            const Mat4d exchange(0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
            t.postMult(exchange);
        })};
    for (const Transform::Ptr& transform : transforms) {
        grid->setTransform(transform);
        write_grid(grid, folder / "v.vdb");
        const FileVoxels file = opened(folder / "v.vdb");
        const VoxelBox box{file.first, file.size};
        double sum = 0;
        testing::expect_voxels_at<Coord>(file, box, [&](const Coord& at) {
            openvdb::Vec3d centre;
            for (int a = 0; a < 3; ++a) {
                const auto axis = static_cast<std::size_t>(a);
                centre[a] = file.index_origin[axis] + (at[a] + 0.5) * file.voxel_size[axis];
            }
            const Coord index = transform->worldToIndexCellCentered(centre);
            sum += grid->tree().getValue(index);
            return grid->tree().getValue(index);
        });
        EXPECT_GT(sum, 100) << "the box holds the voxels";
        for (int x = 0; x < box.size[0]; x += 5) {
            const VoxelBox part{{box.origin[0] + x, box.origin[1], box.origin[2]}, {4, 5, 6}};
            std::vector<float> some(static_cast<std::size_t>(part.count()), 1.0F);
            file.voxels->fill(part, {some.data()});
            if (file.voxels->is_empty(part)) {
                EXPECT_EQ(some, std::vector<float>(some.size(), 0.0F));
            }
        }
    }
}

TEST(ForeignGrid, NeedsNoNameWhereItIsTheOnlyOneOfNumbers) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr smoke = any_grid();
    smoke->setName("smoke");
    const auto velocity = openvdb::Vec3SGrid::create();
    velocity->setName("vel");
    openvdb::io::File((folder / "v.vdb").string()).write({velocity, smoke});
    expect_same_voxels(*smoke, opened(folder / "v.vdb", ""), {{-40, -30, -9}, {90, 80, 60}});
    const FloatGrid::Ptr unnamed = any_grid();
    unnamed->setName("");
    write_grid(unnamed, folder / "v.vdb");
    expect_same_voxels(*unnamed, opened(folder / "v.vdb", ""), {{-40, -30, -9}, {90, 80, 60}});
    const auto heat = FloatGrid::create(0);
    heat->setName("heat");
    openvdb::io::File((folder / "v.vdb").string()).write({velocity, smoke, heat});
    const std::string message = message_of(folder / "v.vdb");
    EXPECT_NE(message.find("it has no grid `density`; write grid = \"smoke\" or grid = \"heat\""),
              std::string::npos)
        << message;
}

TEST(ForeignGrid, SaysWhichVoxelsAreNoDensities) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = any_grid(0.25F);
    grid->tree().setValue(Coord(-19, 8, 5), std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValue(Coord(30, 31, 32), std::numeric_limits<float>::infinity());
    grid->tree().setValue(Coord(9, 9, 9), -0.5F);
    write_grid(grid, folder / "v.vdb");
    const std::string message = message_of(folder / "v.vdb");
    EXPECT_NE(message.find("its voxel (-19, 8, 5) is nan, the first of 2 that are not finite; "
                           "not_finite = \"background\" takes the background in their place"),
              std::string::npos)
        << message;
    const auto file = test::without_errors(open_vdb_grid(
        folder / "v.vdb", "density", VolumePart::voxels, config::NotFinite::background));
    EXPECT_EQ(file.faults.negative.count, 1);
    EXPECT_EQ(file.faults.negative.index, (std::array<std::int64_t, 3>{9, 9, 9}));
    EXPECT_LE(file.largest, 1);
    grid->tree().setValue(Coord(-19, 8, 5), 0.25F);
    grid->tree().setValue(Coord(30, 31, 32), 0.25F);
    expect_same_voxels(*grid, file, {{-40, -30, -9}, {90, 80, 60}});
}

TEST(ForeignGrid, IsDescribedByWhatItHolds) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto named = [](openvdb::GridBase::Ptr grid, const char* name) {
        grid->setName(name);
        return grid;
    };
    openvdb::io::File((folder / "v.vdb").string())
        .write({named(openvdb::BoolGrid::create(), "b"), named(openvdb::MaskGrid::create(), "m"),
                named(openvdb::Vec3SGrid::create(), "v"), named(FloatGrid::create(), "f")});
    const auto file = test::without_errors(read_vdb(folder / "v.vdb"));
    std::string types;
    for (const VdbGrid& grid : file.grids) {
        types += grid.value_type + " ";
        EXPECT_TRUE(grid.empty) << grid.name;
        EXPECT_EQ(grid.active_voxels, 0);
    }
    EXPECT_EQ(types, "bool mask vec3s float ");
}

}  // namespace
}  // namespace skybake
