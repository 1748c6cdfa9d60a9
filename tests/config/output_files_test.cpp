// Names of files that cannot be are found before anything is baked.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "config/assets/asset_kind.h"
#include "config/assets/output_files.h"
#include "config/fields/section_decoder.h"
#include "config/sections/files.h"
#include "tests/config/recipes.h"

namespace skybake::config {

namespace {

// Returns "CODE LINE" of each diagnostic.
std::vector<std::string> told(const std::string& text) {
    std::vector<std::string> codes;
    for (const Diagnostic& diagnostic : parse("preset = 'earth_hillaire'\n" + text).diagnostics) {
        codes.push_back(diagnostic.code + " " + std::to_string(diagnostic.where.line));
    }
    return codes;
}

using Told = std::vector<std::string>;

std::string table(const std::string& name, const std::string& more = "") {
    return "[bake." + name + "]\nasset = 'transmittance'\n" + more;
}

std::string environment(const std::string& name, const std::string& more) {
    return "[bake." + name +
           "]\nasset = 'environment'\nmapping = 'longitude_latitude'\n"
           "size = [16, 8]\nsun_elevation = '20 deg'\n" +
           more;
}

std::string noise(const std::string& name, const std::string& more) {
    return "[bake." + name + "]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [8, 8, 8]\n" + more;
}

const std::string a_noise =
    "[noise.n]\nperiod = 2\ndrift = [1, 0, 0]\n[noise.n.channels.Y]\ntype = 'worley'\nfrequency = "
    "1\n";

// 255 bytes are what file systems allow, whatever the files of an asset end with.
TEST(OutputFiles, HaveAtMostTwoHundredAndFiftyFiveBytes) {
    const auto longest = [](const std::string& ending) { return 255 - ending.size(); };
    const auto told_of = [](std::size_t length, const std::string& formats) {
        return told(table(std::string(length, 'n'), formats));
    };
    EXPECT_EQ(told_of(longest(".exr"), ""), Told());
    EXPECT_EQ(told_of(longest(".exr") + 1, ""), Told{"E0178 2"});
    EXPECT_EQ(told_of(longest(".ktx2"), "formats = ['exr', 'ktx2']\n"), Told());
    EXPECT_EQ(told_of(longest(".ktx2") + 1, "formats = ['exr', 'ktx2']\n"), Told{"E0178 2"});
    EXPECT_EQ(told(a_noise +
                   noise(std::string(longest(".mip3.exr"), 'n'), "formats = ['exr']\nmips = 4\n")),
              Told());
    EXPECT_EQ(told(a_noise + noise(std::string(longest(".mip3.exr") + 1, 'n'),
                                   "formats = ['exr']\nmips = 4\n")),
              Told{"E0178 8"});
}

// Each file of each target is counted: the names are those that a bake writes.
TEST(OutputFiles, OfTargetsAreCounted) {
    const auto outcome =
        parse("preset = 'earth_hillaire'\n" + environment("sky", "target = 'three'\n"));
    ASSERT_TRUE(outcome.value);
    const auto names = file_names(outcome.value->parameters.bakes.at(0));
    const auto longest =
        std::max_element(names.begin(), names.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const std::size_t ending = longest->size() - 3;
    ASSERT_GT(ending, 4U) << "a target has files of its own";
    EXPECT_EQ(told(environment(std::string(255 - ending, 'n'), "target = 'three'\n")), Told());
    EXPECT_EQ(told(environment(std::string(256 - ending, 'n'), "target = 'three'\n")),
              Told{"E0178 2"});
}

using Size = std::array<int, 3>;

std::array<int, 2> atlas_of(const Size& size, int columns = 0) {
    const SliceSheet sheet = slice_sheet(size, SheetLayout::atlas, columns);
    return {sheet.columns, sheet.rows};
}

std::int64_t longer_edge(const Size& size, const std::array<int, 2>& cells) {
    return std::max(std::int64_t{size[0]} * cells[0], std::int64_t{size[1]} * cells[1]);
}

TEST(SliceSheet, AStackIsOneColumn) {
    const SliceSheet sheet = slice_sheet({128, 64, 32}, SheetLayout::stack, 0);
    EXPECT_EQ(sheet.columns, 1);
    EXPECT_EQ(sheet.rows, 32);
}

// Tests the sheets that Unreal, Unity and Godot want.
TEST(SliceSheet, PowersOfTwoMakeSheetsOfPowersOfTwo) {
    EXPECT_EQ(atlas_of({128, 128, 128}), (std::array{16, 8}));
    EXPECT_EQ(atlas_of({32, 32, 32}), (std::array{8, 4}));
    EXPECT_EQ(atlas_of({64, 64, 64}), (std::array{8, 8}));
    EXPECT_EQ(atlas_of({512, 512, 128}), (std::array{16, 8}));
    EXPECT_EQ(atlas_of({256, 128, 32}), (std::array{4, 8}));
    EXPECT_EQ(atlas_of({1, 1, 1}), (std::array{1, 1}));
}

TEST(SliceSheet, HasTheColumnsThatWereAskedFor) {
    EXPECT_EQ(atlas_of({16, 8, 10}, 4), (std::array{4, 3}));
    EXPECT_EQ(atlas_of({16, 8, 10}, 25), (std::array{25, 1}));
}

// Tries all columns, whether they divide or not.
TEST(SliceSheet, NoFullSheetIsNearerToASquare) {
    EXPECT_TRUE(rc::check([] {
        Size size;
        for (int& side : size) side = *rc::gen::inRange(1, 120);
        const std::array<int, 2> chosen = atlas_of(size);
        RC_ASSERT(chosen[0] * chosen[1] == size[2]);
        for (int columns = 1; columns <= size[2]; ++columns) {
            if (size[2] % columns != 0) continue;
            RC_ASSERT(longer_edge(size, chosen) <= longer_edge(size, {columns, size[2] / columns}));
        }
    }));
}

// One row of 131 slices would be 16768 texels wide.
TEST(SliceSheet, PrimesLeaveCellsEmptyWhereOneRowIsTooLong) {
    EXPECT_EQ(atlas_of({128, 128, 127}), (std::array{127, 1}));
    EXPECT_EQ(atlas_of({128, 128, 131}), (std::array{12, 11}));
}

// Where nothing fits: full, unless a row of cells would be too long to be made.
TEST(SliceSheet, LargeVolumesAreFullToo) {
    EXPECT_EQ(atlas_of({1024, 1024, 512}), (std::array{32, 16}));
    const std::array<int, 2> huge = atlas_of({16384, 256, 8191});
    EXPECT_LE(std::int64_t{huge[0]} * 16384, widest_sheet);
    EXPECT_GE(huge[0] * huge[1], 8191);
}

TEST(SliceSheet, SizesDoNotOverflow) {
    const Size size = {16384, 16384, 16384};
    const SliceSheet sheet = slice_sheet(size, SheetLayout::stack, 0);
    EXPECT_EQ(sheet_size(size, sheet)[1], std::int64_t{1} << 28);
}

}  // namespace

}  // namespace skybake::config
