#include "bakers/io/formats/exr/exr_heads.h"

#include <rapidcheck.h>

#include <set>

#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/manifest/metadata.h"
#include "config/text/text.h"
#include "tests/io/exr_bytes.h"

namespace skybake {
namespace {

std::string text_of(std::size_t size) {
    std::string text;
    for (std::size_t i = 0; i < size; ++i) text += static_cast<char>('a' + i % 26);
    return text;
}

TEST(AttributePieces, ShortTextsStayAsTheyAre) {
    const Attributes attributes = {{"skybake/a", ""}, {"skybake/b", text_of(249)}};
    EXPECT_EQ(split_attributes(attributes), attributes);
    EXPECT_EQ(joined_attributes(attributes), attributes);
}

TEST(AttributePieces, LongTextsAreNumberedPieces) {
    const std::string text = text_of(249 + 249 + 7);
    const Attributes split = split_attributes({{"skybake/b", "x"}, {"skybake/a", text}});
    ASSERT_EQ(split.size(), 4u);
    EXPECT_EQ(split[0], (std::pair<std::string, std::string>{"skybake/a.0", text.substr(0, 249)}));
    EXPECT_EQ(split[1].second, text.substr(249, 249));
    EXPECT_EQ(split[2], (std::pair<std::string, std::string>{"skybake/a.2", text.substr(498)}));
    EXPECT_EQ(split[3].first, "skybake/b");
    EXPECT_EQ(split_attributes({{"skybake/a", text_of(250)}}).size(), 2u);
}

// Sorted by name, .10 comes before .2.
TEST(AttributePieces, JoinInTheOrderOfTheirNumbers) {
    const Attributes whole = {{"skybake/a", text_of(20000)}};
    const Attributes split = split_attributes(whole);
    EXPECT_EQ(split[2].first, "skybake/a.10");
    EXPECT_EQ(joined_attributes(split), whole);
}

TEST(AttributePieces, NoCharacterIsCut) {
    for (const std::string sign : {"µ", "→", "😀"}) {
        for (std::size_t before = 240; before < 250; ++before) {
            std::string text = text_of(before);
            for (int i = 0; i < 200; ++i) text += sign;
            const Attributes split = split_attributes({{"skybake/a", text}});
            for (const auto& [name, piece] : split) {
                EXPECT_FALSE(config::find_invalid_utf8(piece)) << sign << " after " << before;
                EXPECT_LT(piece.size(), 250u);
            }
            EXPECT_EQ(joined_attributes(split), (Attributes{{"skybake/a", text}}));
        }
    }
}

TEST(AttributePieces, AnyTextsComeBack) {
    EXPECT_TRUE(rc::check([] {
        Attributes whole;
        const int count = *rc::gen::inRange(0, 5);
        for (int i = 0; i < count; ++i) {
            const auto size = *rc::gen::inRange<std::size_t>(0, 3000);
            whole.emplace_back("skybake/" + std::string(1, static_cast<char>('a' + i)),
                               *rc::gen::container<std::string>(size, rc::gen::arbitrary<char>()));
        }
        const Attributes split = split_attributes(whole);
        std::set<std::string> names;
        for (const auto& [name, piece] : split) {
            RC_ASSERT(piece.size() < 250);
            RC_ASSERT(names.insert(name).second);
        }
        RC_ASSERT(std::is_sorted(split.begin(), split.end()));
        RC_ASSERT(joined_attributes(split) == whole);
    }));
}

// Nothing is lost of files that are damaged, or that others have written.
TEST(AttributePieces, WhatIsNotOursOrNotCompleteKeepsItsName) {
    for (const Attributes& attributes : std::vector<Attributes>{
             {{"skybake/a.0", "x"}, {"skybake/a.2", "y"}},
             {{"skybake/a.1", "x"}},
             {{"skybake/a.00", "x"}},
             {{"skybake/a.x", "x"}},
             {{"skybake/a.", "x"}},
             {{"skybake/a", "x"}, {"skybake/a.0", "y"}},
             {{"other.0", "x"}, {"other.1", "y"}},
             {{"skybake/a.99999999999999999999999", "x"}},
         }) {
        EXPECT_EQ(joined_attributes(attributes), attributes) << attributes[0].first;
    }
}

// --- In files, whose headers are read here byte by byte -----------------------------------------

// How many texts there are in pieces.
int expect_short(const std::string& file) {
    int split = 0;
    for (const testing::ExrAttribute& attribute : testing::exr_attributes(file)) {
        EXPECT_LT(attribute.size, 250u) << attribute.name;
        EXPECT_LE(attribute.name.size(), 31u) << attribute.name;
        split += attribute.name.ends_with(".0") ? 1 : 0;
    }
    return split;
}

// A page of parameters, with signs of several bytes.
std::string long_parameters() {
    std::string text = "[atmosphere]\n";
    for (int i = 0; i < 300; ++i) text += "ground_radius = \"6360000 m\"  # µ → 😀\n";
    return text;
}

TEST(AttributePieces, TablesHaveNoLongAttribute) {
    Baked table = testing::sample_table();
    table.parameters = long_parameters();
    const testing::TemporaryFolder folder;
    const ManifestAsset asset = describe_with_files(table);
    testing::write_bytes(folder / "a.exr", "");
    ASSERT_EQ(write_asset_file(table, asset, asset.files[0], 1, nullptr, folder / "a.exr").value,
              true);
    EXPECT_EQ(expect_short(testing::read_bytes(folder / "a.exr")), 1);
    const auto entry = entry_of_file(folder / "a.exr");
    ASSERT_TRUE(entry.value.has_value());
    EXPECT_EQ(entry.value->parameters, table.parameters);
}

TEST(AttributePieces, VolumesHaveNoLongAttribute) {
    const testing::TemporaryFolder folder;
    Baked volume = testing::sample_volume();
    volume.parameters = long_parameters();
    const Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    const std::string path = folder / manifest.assets[0].files[0].path;
    EXPECT_EQ(expect_short(testing::read_bytes(path)), 1);
    const auto rows = ExrRows::open(path);
    ASSERT_TRUE(rows.value.has_value());
    EXPECT_EQ(rows.value->facts().attributes,
              (Attributes{{"skybake/asset",
                           file_entry_json(manifest.assets[0], manifest.assets[0].files[0])}}));
}

}  // namespace
}  // namespace skybake
