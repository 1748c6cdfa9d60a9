// Grids of vectors of write_vdb against OpenVDB's own reader, and read again by component.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "bakers/io/volumes/grid_files.h"
#include "tests/io/vdb_samples.h"
#include "tests/support/outcomes.h"
#include "tests/support/temporary_folder.h"

namespace skybake {
namespace {

using config::PixelType;
using config::VdbCompression;
using openvdb::Coord;
using Size = std::array<int, 3>;

// Of each vector some components are 0, and most vectors are 0 as a whole.
float component(int x, int y, int z, int channel) {
    const int kind = (x / 9 + 2 * (y / 5) + 3 * z) % 8;
    if (kind == 0) return 0;
    return ((kind >> (channel % 3)) & 1) == 0 ? 0 : testing::sample_voxel(x, y, z, channel) - 0.5F;
}

// Density, and a vector behind it.
Baked flow_sample(const Size& size, PixelType type, VdbCompression compression, bool sparse) {
    Baked volume = testing::vdb_sample(size, 4, type, compression);
    volume.channel_names = {"Y", "flow.x", "flow.y", "flow.z"};
    volume.grid_names = {"density", "flow.x", "flow.y", "flow.z"};
    volume.sparse = sparse;
    volume.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(component);
    return volume;
}

openvdb::Vec3f wanted_at(const Baked& volume, int x, int y, int z) {
    const auto stored = [&](int channel) {
        return round_to_pixel_type(double{component(x, y, z, channel)}, volume.pixel_type);
    };
    return {stored(1), stored(2), stored(3)};
}

void expect_flow(const Baked& volume, const std::filesystem::path& path) {
    openvdb::io::File file(path.string());
    file.open();
    EXPECT_TRUE(file.readGrid("density")->isType<openvdb::FloatGrid>());
    const auto grid = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("flow"));
    EXPECT_EQ(grid->getVectorType(), openvdb::VEC_CONTRAVARIANT_RELATIVE);
    EXPECT_EQ(grid->voxelSize()[0], volume.voxel_size_m[0]);
    const auto accessor = grid->getConstAccessor();
    std::int64_t differ = 0, active = 0;
    testing::for_each_voxel(volume.levels[0].size, [&](int x, int y, int z) {
        const openvdb::Vec3f wanted = wanted_at(volume, x, y, z);
        const bool is_active = !volume.sparse || wanted != openvdb::Vec3f(0);
        active += is_active ? 1 : 0;
        const Coord at(x, y, z);
        differ += accessor.getValue(at) != wanted || accessor.isValueOn(at) != is_active ? 1 : 0;
    });
    EXPECT_EQ(differ, 0);
    EXPECT_EQ(static_cast<std::int64_t>(grid->activeVoxelCount()), active);
    EXPECT_EQ(grid->metaValue<openvdb::Int64>("file_voxel_count"), active);
    EXPECT_GT(active, 0);
}

// What the program reads again is each channel under its own name.
void expect_components(const Baked& volume, const std::filesystem::path& path) {
    Outcome<FileInput> file = FileInput::open(path);
    ASSERT_TRUE(file.value);
    const FileFacts facts = test::without_errors(inspect_grids(*file.value));
    EXPECT_EQ(facts.names, volume.grid_names);
    EXPECT_EQ(facts.pixel_type, volume.pixel_type);
    const VoxelBox box{{}, volume.levels[0].size};
    std::vector<float> read(static_cast<std::size_t>(box.count()));
    for (int channel = 1; channel < 4; ++channel) {
        const std::string& name = volume.grid_names[static_cast<std::size_t>(channel)];
        const FileVoxels voxels = test::without_errors(open_numbers(path, name));
        ASSERT_EQ(voxels.size, box.size);
        voxels.voxels->fill(box, {read.data()});
        std::size_t i = 0, differ = 0;
        testing::for_each_voxel(box.size, [&](int x, int y, int z) {
            differ += read[i++] == wanted_at(volume, x, y, z)[channel - 1] ? 0 : 1;
        });
        EXPECT_EQ(differ, 0U) << name;
    }
}

TEST(VdbVectors, AreWhatOpenVdbReads) {
    openvdb::initialize();
    const testing::TemporaryFolder folder;
    for (const PixelType type : {PixelType::half, PixelType::float32}) {
        for (const auto compression :
             {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
            for (const bool sparse : {false, true}) {
                // Several nodes, strips and parts of leaves.
                const Baked volume = flow_sample({139, 37, 11}, type, compression, sparse);
                ASSERT_TRUE(testing::write_sample(volume, folder / "v.vdb").value);
                expect_flow(volume, folder / "v.vdb");
                expect_components(volume, folder / "v.vdb");
            }
        }
    }
}

TEST(VdbVectors, NeedThreeNeighboursOfOneName) {
    Baked volume;
    volume.grid_names = {"v.x", "v.y", "v.z", "w.x", "w.y", "u.x", "u.y", "v.z"};
    volume.channel_names = volume.grid_names;
    std::string names;
    for (const VdbGridChannels& grid : vdb_grids(volume)) {
        names +=
            grid.name + ":" + std::to_string(grid.first) + "+" + std::to_string(grid.count) + " ";
    }
    EXPECT_EQ(names, "v:0+3 w.x:3+1 w.y:4+1 u.x:5+1 u.y:6+1 v.z:7+1 ");
}

}  // namespace
}  // namespace skybake
