// NanoVDB files, read back by the library's own readers and by the format's reader.
#include <iostream>  // GridValidator.h needs it

#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>

#include <cstring>

#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using testing::plain_volume;
using testing::written;

constexpr FileFormat kFormat = FileFormat::nvdb;

Baked placed_volume(const std::array<int, 3>& size, int channels, PixelType type,
                    testing::FunctionVoxels::Function function = testing::sample_voxel) {
    Baked volume = plain_volume(size, channels, type, std::move(function));
    volume.voxel_size_m = {10, 20, 5};
    volume.minimum_m = {-100, 300, 1000};
    return volume;
}

std::vector<nanovdb::GridHandle<>> grids_of(const TemporaryFolder& folder) {
    return nanovdb::io::readGrids((folder / "a.file").string());
}

// Whether a voxel of a sparse volume has a value: blobs with empty leaves and nodes between them.
float blobs(int x, int y, int z, int channel) {
    const bool is_inside = (x / 40 + y / 40 + z / 20 + channel) % 3 == 0 && x % 7 != 3;
    return is_inside ? 0.25F + testing::sample_voxel(x, y, z, channel) / 2 : 0.0F;
}

void expect_grid(const nanovdb::GridHandle<>& handle, const Baked& volume, int channel) {
    const auto* grid = handle.grid<float>();
    ASSERT_NE(grid, nullptr);
    EXPECT_TRUE(nanovdb::isValid(*grid, true, true));
    const std::array<int, 3>& size = volume.levels[0].size;
    const auto accessor = grid->getAccessor();
    const auto planes =
        testing::planes_of(*volume.levels[0].voxels, {{}, size}, volume.channel_names.size());
    auto value = planes[static_cast<std::size_t>(channel)].begin();
    long wrong = 0;
    std::uint64_t active = 0;
    float least = 1e9F;
    float largest = -1e9F;
    nanovdb::CoordBBox bounds;
    testing::for_each_voxel({size[0] + 2, size[1] + 2, size[2] + 2}, [&](int i, int j, int k) {
        const nanovdb::Coord at(i - 1, j - 1, k - 1);
        const bool is_inside =
            i > 0 && j > 0 && k > 0 && i <= size[0] && j <= size[1] && k <= size[2];
        const float wanted = is_inside ? round_to_pixel_type(*value++, volume.pixel_type) : 0.0F;
        const bool is_active = is_inside && (!volume.sparse || wanted != 0);
        wrong += accessor.getValue(at) == wanted ? 0 : 1;
        wrong += accessor.isActive(at) == is_active ? 0 : 1;
        if (!is_active) return;
        ++active;
        least = std::min(least, wanted);
        largest = std::max(largest, wanted);
        bounds.expand(at);
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(grid->activeVoxelCount(), active);
    EXPECT_EQ(grid->tree().bbox(), bounds);
    EXPECT_EQ(grid->tree().root().minimum(), least);
    EXPECT_EQ(grid->tree().root().maximum(), largest);
}

TEST(Nvdb, LibraryReadsFloatsAndHalves) {
    const TemporaryFolder folder;
    for (const PixelType type : {PixelType::float32, PixelType::half}) {
        for (const std::array<int, 3> size :
             {std::array{1, 1, 1}, {9, 17, 8}, {130, 33, 12}, {16, 16, 140}}) {
            const Baked volume = placed_volume(size, 3, type);
            written(folder, kFormat, volume, 2);
            const auto grids = grids_of(folder);
            ASSERT_EQ(grids.size(), 3U);
            for (int c = 0; c < 3; ++c) {
                expect_grid(grids[static_cast<std::size_t>(c)], volume, c);
            }
            EXPECT_EQ(testing::wrong_values(kFormat, volume, folder / "a.file"), 0);
        }
    }
}

TEST(Nvdb, SparseVolumesHaveOnlyLeavesWithVoxels) {
    const TemporaryFolder folder;
    Baked volume = placed_volume({170, 140, 70}, 1, PixelType::float32, blobs);
    volume.sparse = true;
    const std::string bytes = written(folder, kFormat, volume, 1);
    EXPECT_TRUE(written(folder, kFormat, volume, 3) == bytes);
    const auto grids = grids_of(folder);
    ASSERT_EQ(grids.size(), 1U);
    expect_grid(grids[0], volume, 0);
    const auto& tree = grids[0].grid<float>()->tree();
    std::set<std::array<int, 3>> leaves;
    testing::for_each_voxel({170, 140, 70}, [&](int x, int y, int z) {
        if (blobs(x, y, z, 0) != 0) leaves.insert({x / 8, y / 8, z / 8});
    });
    EXPECT_EQ(tree.nodeCount(0), leaves.size());
    EXPECT_LT(leaves.size(), std::size_t{22 * 18 * 9});
    EXPECT_EQ(testing::texels_of(kFormat, volume, 0, folder / "a.file"),
              testing::voxels_of(volume, 0));
}

TEST(Nvdb, EmptyVolumesAreEmptyTrees) {
    const TemporaryFolder folder;
    Baked volume =
        placed_volume({20, 20, 20}, 1, PixelType::half, [](int, int, int, int) { return 0.0F; });
    volume.sparse = true;
    written(folder, kFormat, volume, 1);
    const auto grids = grids_of(folder);
    ASSERT_EQ(grids.size(), 1U);
    const auto* grid = grids[0].grid<float>();
    EXPECT_TRUE(nanovdb::isValid(*grid, true, true));
    EXPECT_EQ(grid->activeVoxelCount(), 0U);
    EXPECT_EQ(grid->tree().getValue({3, 3, 3}), 0.0F);
}

TEST(Nvdb, PlacesVoxelsAsVdbFilesDo) {
    const TemporaryFolder folder;
    written(folder, kFormat, placed_volume({9, 17, 8}, 1, PixelType::float32), 1);
    const auto grids = grids_of(folder);
    const auto& grid = *grids.at(0).grid<float>();
    EXPECT_STREQ(grid.gridName(), "density");
    EXPECT_TRUE(grid.isFogVolume());
    EXPECT_TRUE(grid.isBreadthFirst());
    const nanovdb::Vec3d centre = grid.indexToWorld(nanovdb::Vec3d(2, 3, 4));
    EXPECT_EQ(centre[0], -100 + 2.5 * 10);
    EXPECT_EQ(centre[1], 300 + 3.5 * 20);
    EXPECT_EQ(centre[2], 1000 + 4.5 * 5);
    EXPECT_EQ(grid.voxelSize()[1], 20);
    EXPECT_EQ(grid.worldBBox()[1][2] - grid.worldBBox()[0][2], 8 * 5);
    const auto heads = nanovdb::io::readGridMetaData((folder / "a.file").string());
    ASSERT_EQ(heads.size(), 1U);
    EXPECT_EQ(heads[0].voxelCount, 9U * 17 * 8);
    EXPECT_EQ(heads[0].gridName, "density");
    EXPECT_TRUE(nanovdb::io::hasGrid((folder / "a.file").string(), "density"));
    const std::string bytes = testing::read_bytes(folder / "a.file");
    EXPECT_EQ(bytes.substr(0, 8), "NanoVDB0");
}

TEST(Nvdb, SaysWhatItHolds) {
    const TemporaryFolder folder;
    written(folder, kFormat, placed_volume({9, 17, 8}, 3, PixelType::half), 1);
    const auto facts = testing::inspect_file(format_of(kFormat), folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->metadata, "{}");
    EXPECT_EQ(facts.value->names, (std::vector<std::string>{"R", "G", "B"}));
    const auto grids = grids_of(folder);
    const auto* grid = grids.at(0).grid<float>();
    ASSERT_EQ(grid->blindDataCount(), 1U);
    EXPECT_STREQ(grid->blindMetaData(0).mName, "skybake/asset");
    EXPECT_EQ(std::memcmp(grid->blindData(0), "{}", 2), 0);
}

TEST(Nvdb, DoesNotDependOnThreads) {
    testing::expect_reads_back(kFormat, placed_volume({300, 140, 20}, 1, PixelType::half));
}

TEST(Nvdb, RefusesDamagedFiles) {
    testing::expect_refuses_damage(kFormat, placed_volume({9, 7, 3}, 1, PixelType::float32), false);
}

}  // namespace
}  // namespace skybake
