// NanoVDB files that are compressed by zip: NanoVDB's own files, compressed by zlib.
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include "bakers/io/formats/nvdb/nvdb_source.h"
#include "bakers/io/manifest/compare.h"
#include "tests/support/zipped_nvdb.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

// Two grids, the second of which is `density`.
class NvdbZip : public ::testing::Test {
  protected:
    NvdbZip() {
        other_->setName("other");
        other_->tree().setValue(testing::Coord(1, 2, 3), 7);
        nanovdb::OpenToNanoVDB<float, nanovdb::Fp8> coded;
        nanovdb::OpenToNanoVDB<float, float> plain;
        const auto with = [](auto& convert, const FloatGrid& grid) {
            return convert(grid, nanovdb::StatsMode::All, nanovdb::ChecksumMode::Full, 0);
        };
        std::vector<nanovdb::GridHandle<>> grids;
        grids.push_back(with(coded, *other_));
        grids.push_back(with(plain, *grid_));
        const auto path = folder_ / "plain.nvdb";
        nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(path.string(), grids);
        zipped_ = testing::zipped_nvdb(testing::read_bytes(path));
    }
    std::string problem_of(const std::string& bytes) const {
        testing::write_bytes(folder_ / "zip.nvdb", bytes);
        return testing::reason_of(
            open_nvdb_grid(folder_ / "zip.nvdb", "density", VolumePart::voxels));
    }
    void expect_same() const {
        const auto found = compare_volumes(folder_ / "zip.nvdb", folder_ / "plain.nvdb");
        ASSERT_TRUE(found.value) << found.diagnostics.at(0).message;
        EXPECT_TRUE(equal_within(*found.value, 0)) << found.value->layout;
        EXPECT_EQ(found.value->channels.size(), 2U);
    }
    // The file in which the head of `density` says another size of the grid.
    std::string with_size(std::uint64_t size) const {
        std::string bytes = zipped_;
        std::memcpy(&bytes[second_head], &size, sizeof size);
        return bytes;
    }
    static constexpr std::size_t first_head = sizeof(NvdbSegment);
    static constexpr std::size_t second_head = first_head + sizeof(NvdbGridHead) + sizeof "other";
    static constexpr std::size_t first_grid = second_head + sizeof(NvdbGridHead) + sizeof "density";
    std::uint64_t number_at(std::size_t at) const {
        std::uint64_t number = 0;
        std::memcpy(&number, &zipped_[at], sizeof number);
        return number;
    }
    std::size_t second_grid() const {
        return first_grid + number_at(first_head + offsetof(NvdbGridHead, file_size));
    }
    testing::TemporaryFolder folder_;
    FloatGrid::Ptr grid_ = any_grid(0.125F);
    FloatGrid::Ptr other_ = grid_->deepCopy();
    std::string zipped_;
};

TEST_F(NvdbZip, HasTheVoxelsOfThePlainFile) {
    EXPECT_LT(zipped_.size(), std::filesystem::file_size(folder_ / "plain.nvdb") / 2);
    EXPECT_EQ(problem_of(zipped_), "");
    expect_same();
    const auto file = open_nvdb_grid(folder_ / "zip.nvdb", "density", VolumePart::voxels);
    EXPECT_EQ(file.value->background, 0.125F);
    testing::expect_same_voxels(*grid_, *file.value, {{-40, -30, -9}, {90, 80, 60}});
}

TEST_F(NvdbZip, IsRefusedWhereItsSizesContradictIt) {
    const std::uint64_t size = number_at(second_head);
    EXPECT_EQ(problem_of(with_size(size)), "");
    EXPECT_EQ(problem_of(with_size(size + 32)), "a compressed grid is damaged");
    EXPECT_EQ(problem_of(with_size(size - 32)), "a compressed grid is damaged");
    constexpr std::uint64_t gib = std::uint64_t{1} << 30;
    EXPECT_EQ(problem_of(with_size(3 * gib)), "a compressed grid is too short for its size");
    EXPECT_EQ(problem_of(with_size(4 * gib + 1)), "a compressed grid is larger than 4 GiB");
    std::string bytes = zipped_;
    ++bytes[second_grid()];
    EXPECT_EQ(problem_of(bytes), "a compressed grid contradicts its head");
}

TEST_F(NvdbZip, IsRefusedWhereverItIsDamagedOrEnds) {
    int harmless = 0;
    for (std::size_t at = second_grid() + 8; at < zipped_.size(); at += 97) {
        EXPECT_EQ(problem_of(zipped_.substr(0, at)), "it ends within a grid") << at;
        std::string changed = zipped_;
        changed[at] = static_cast<char>(changed[at] ^ 0x11);
        const std::string problem = problem_of(changed);
        if (problem == "a compressed grid is damaged") continue;
        EXPECT_EQ(problem, "") << at;
        expect_same();  // a step back of another length may find the same bytes
        ++harmless;
    }
    EXPECT_LT(harmless, 10);
}

}  // namespace
}  // namespace skybake
