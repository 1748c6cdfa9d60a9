// Tests the page of a sweep: its index and times, the sheets of its pictures, the plots.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/preview/load_sweep.h"
#include "bakers/preview/sweep_sheet.h"
#include "bakers/preview/sweep_table.h"
#include "tests/io/files.h"
#include "tests/plot/pixels.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using nlohmann::json;

// A sweep along axes of these lengths, whose keys are "k0", "k1" and so on, with values from 0 on.
// The asset "air" is larger and better from variant to variant, and "sun" is the same in all.
json sweep_of(const std::vector<int>& lengths) {
    json sweep = {{"format", 2}, {"tool", {{"name", "skybake"}}}, {"variants", json::array()}};
    int count = 1;
    for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
        json values = json::array();
        for (int i = 0; i < lengths[axis]; ++i) values.push_back({i});
        sweep["axes"].push_back({{"paths", {"a.k" + std::to_string(axis)}}, {"values", values}});
        count *= lengths[axis];
    }
    for (int index = 0; index < count; ++index) {
        json values;
        int rest = index;
        for (std::size_t axis = lengths.size(); axis-- > 0; rest /= lengths[axis]) {
            values["a.k" + std::to_string(axis)] = rest % lengths[axis];
        }
        const json error = {{"max", 0.5}, {"rms", 0.25}};
        const double sky = std::exp2(-index);
        const json air = {{"name", "air"},
                          {"bytes", 1024 << index},
                          {"lookup_error", error},
                          {"sky_error", {{"median", sky}, {"ninth_decile", 2 * sky}, {"max", 3}}}};
        const json sun = {
            {"name", "sun"}, {"bytes", 10}, {"lookup_error", error}, {"sky_error", nullptr}};
        sweep["variants"].push_back({{"index", index},
                                     {"name", "000" + std::to_string(index) + "_a,b"},
                                     {"status", "done"},
                                     {"values", values},
                                     {"assets", {sun, air}}});
    }
    return sweep;
}

PreviewSweep loaded(const json& sweep, const std::string& times = "") {
    const TemporaryFolder folder;
    write_bytes(folder / "sweep.json", sweep.dump());
    if (!times.empty()) write_bytes(folder / "timing.csv", times);
    return test::without_errors(load_sweep(folder.path()));
}

TEST(LoadSweep, KnowsThePlacesOfVariantsAndWhatWasMeasured) {
    const PreviewSweep sweep =
        loaded(sweep_of({2, 3}),
               "index,asset,texels_s,write_s,threads,name\n"
               "4,air,1.5,0.25,2,\"0004_a,b\"\n5,air,1e-3,0,2,x\n9,air,7,7,2,y\n");
    ASSERT_EQ(sweep.variants.size(), 6u);
    EXPECT_EQ(sweep.axes[1], (std::vector<std::string>{"k1 0", "k1 1", "k1 2"}));
    const SweepVariant& fifth = sweep.variants[4];
    EXPECT_EQ(sweep.place(fifth, 0), 1u);
    EXPECT_EQ(sweep.place(fifth, 1), 1u);
    EXPECT_EQ(sweep.label(fifth), "k0 1, k1 1");
    EXPECT_EQ(sweep.label(fifth, 1), "k1 1");
    EXPECT_EQ(figure_of(fifth, "air", "sky_p90"), 2 * std::exp2(-4));
    EXPECT_EQ(figure_of(fifth, "air", "texels_s"), 1.5);
    EXPECT_EQ(figure_of(sweep.variants[5], "air", "texels_s"), 1e-3);
    EXPECT_FALSE(figure_of(fifth, "air", "threads"));
    EXPECT_FALSE(figure_of(fifth, "sun", "sky_median"));
    EXPECT_FALSE(figure_of(sweep.variants[0], "air", "texels_s"));
}

TEST(LoadSweep, RefusesWhatItCannotPlace) {
    const TemporaryFolder folder;
    for (const auto& [pointer, value] : {std::pair<const char*, json>{"/format", 1},
                                         {"/variants/0/index", 6},
                                         {"/variants/0/index", -1},
                                         {"/variants/1/assets/0/bytes", "many"},
                                         {"/axes/0/values", json::array()}}) {
        json sweep = sweep_of({2, 3});
        sweep[json::json_pointer(pointer)] = value;
        write_bytes(folder / "sweep.json", sweep.dump());
        const auto read = load_sweep(folder.path());
        EXPECT_FALSE(read.value.has_value()) << pointer;
        EXPECT_EQ(testing::first_code(read.diagnostics), "E0304") << pointer;
    }
}

// Each variant has its own colour.
Colour colour_of(std::size_t index) { return {static_cast<std::uint8_t>(40 + 8 * index), 200, 9}; }

std::vector<Picture> coloured_pictures(const PreviewSweep& sweep) {
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < sweep.variants.size(); ++i) {
        pictures.emplace_back(80, 50);
        for (std::size_t at = 0; at < pictures[i].rgb.size(); ++at) {
            pictures[i].rgb[at] = colour_of(i)[at % 3];
        }
    }
    return pictures;
}

PixelBox box_on(const PreviewPicture& sheet, std::size_t variant) {
    return box_of(sheet.picture, colour_of(variant), sheet.picture.width);
}

// The longer of the last two axes runs across, and those before them name blocks.
TEST(SweepSheets, AxesAreRowsAndColumns) {
    const PreviewSweep sweep = loaded(sweep_of({2, 3, 2}));
    std::vector<Picture> pictures = coloured_pictures(sweep);
    pictures[9] = {};  // failed
    const PreviewPicture sheet = sweep_sheets(sweep, pictures, "").at(0);
    EXPECT_EQ(sheet.title, "11 of 12 variants");
    for (std::size_t i = 0; i < 12; ++i) {
        const PixelBox box = box_on(sheet, i);
        EXPECT_EQ(box.count, i == 9 ? 0 : 80 * 50);
        if (i == 9) continue;
        const std::size_t block = i / 6, column = i / 2 % 3, row = i % 2;
        // Variants 0, 2 and 4 are the first row, 0 and 1 the first column.
        EXPECT_EQ(box.left, box_on(sheet, 2 * column).left);
        EXPECT_EQ(box.top, box_on(sheet, 6 * block + row).top);
        EXPECT_TRUE(column == 0 || box.left > box_on(sheet, 2 * column - 2).right);
        EXPECT_TRUE(row == 0 || box.top > box_on(sheet, 6 * block).bottom);
        EXPECT_TRUE(block == 0 || box.top > box_on(sheet, 1).bottom);
    }
}

TEST(SweepSheets, ShowHowFarPicturesAreFromTheFirst) {
    const PreviewSweep sweep = loaded(sweep_of({1, 3}));
    std::vector<Picture> pictures(3, Picture(80, 50));
    EXPECT_EQ(sweep_sheets(sweep, pictures, "").size(), 1u) << "all are equal";
    pictures[2].rgb[0] = 25;
    pictures[2].rgb[4] = 10;
    const auto sheets = sweep_sheets(sweep, pictures, "");
    ASSERT_EQ(sheets.size(), 2u);
    EXPECT_EQ(sheets[0].group, sheets[1].group);
    const Picture& difference = sheets[1].picture;
    const Colour grey = {128, 128, 128}, more = {128 + 5 * 25, 128, 128},
                 less = {128, 128 + 5 * 10, 128};
    EXPECT_EQ(box_of(difference, grey, difference.width).count, 3 * 80 * 50 - 2);
    EXPECT_EQ(box_of(difference, more, difference.width).count, 1);
    EXPECT_EQ(box_of(difference, less, difference.width).count, 1);
    EXPECT_NE(sheets[1].caption.find("25 of 255"), std::string::npos);
    EXPECT_EQ(rms_difference(pictures[0], pictures[1]), 0);
    EXPECT_EQ(rms_difference(pictures[2], pictures[0]),
              std::sqrt((25 * 25 + 10 * 10) / (3.0 * 80 * 50)));
    EXPECT_FALSE(rms_difference(pictures[0], Picture(50, 80)));
    EXPECT_FALSE(rms_difference(Picture(), Picture()));
}

// The asset that is the same in all variants has nothing to plot.
TEST(SweepPlots, AreOfAssetsThatVary) {
    const auto bytes_only = sweep_plots(loaded(sweep_of({2, 2})));
    ASSERT_EQ(bytes_only.size(), 1u);
    EXPECT_EQ(bytes_only[0].name, "air_variants");
    EXPECT_EQ(bytes_only[0].kind, PictureKind::plot);
    const std::string times = "index,asset,texels_s\n0,air,1\n1,air,2\n2,air,3\n3,air,4\n";
    const auto with_times = sweep_plots(loaded(sweep_of({2, 2}), times));
    ASSERT_EQ(with_times.size(), 1u);
    EXPECT_GT(with_times[0].picture.width, 3 * bytes_only[0].picture.width / 2) << "a second chart";
}

TEST(SweepTable, SaysWhatIsMeasuredOfWhat) {
    const PreviewSweep sweep = loaded(sweep_of({2}), "index,asset,texels_s\n1,air,2.5\n");
    const SweepTable table(sweep);
    std::string titles;  // "air", which varies, comes before "sun"
    for (const PageTable::Column& column : table.columns()) titles += column.title + "\n";
    EXPECT_EQ(titles,
              "k0\nair: sky error, median\nair: sky error, 9 in 10\nair: sky error, max\n"
              "air: lookup error, max\nair: lookup error, RMS\nair: files\nair: texels\n"
              "sun: lookup error, max\nsun: lookup error, RMS\nsun: files\n"
              "Picture: difference, RMS of 255\nStatus\n");
    const PageVariant row = table.row(sweep.variants[1], 0.5, "../sweep");
    EXPECT_EQ(row.folder, "../sweep/0001_a,b/");
    ASSERT_EQ(row.cells.size(), table.columns().size());
    EXPECT_EQ(row.cells[0].number, 1);
    EXPECT_EQ(row.cells[1].number, 0.5);
    EXPECT_EQ(row.cells[6].number, 2048);
    EXPECT_EQ(row.cells[7].number, 2.5);
    EXPECT_FALSE(table.row(sweep.variants[0], 0, "").cells[7].number);
    EXPECT_EQ(row.cells[11].number, 0.5);
    EXPECT_EQ(row.cells[12].text, "done");
}

}  // namespace
}  // namespace skybake
