#include "bakers/io/manifest/manifest.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bakers/io/manifest/claimed_files.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using testing::Random;

std::string sample_text() {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance", "second"});
    manifest.assets[1].error.reset();
    return manifest_json(manifest);
}

// Returns a manifest with one piece of its text replaced.
config::Outcome<Manifest> parsed_with(const std::string& piece, const std::string& other,
                                      std::string text) {
    const std::size_t at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    return parse_manifest(text.replace(at, piece.size(), other), "manifest.json");
}

// Returns the message about it.
std::string message_with(const std::string& piece, const std::string& other,
                         const std::string& text = sample_text()) {
    const auto manifest = parsed_with(piece, other, text);
    EXPECT_FALSE(manifest.value.has_value()) << other;
    EXPECT_EQ(testing::first_code(manifest.diagnostics), "E0304");
    return manifest.diagnostics.empty() ? "" : manifest.diagnostics[0].message;
}

TEST(Manifest, ReadsBackAsItWasWritten) {
    const std::string text = sample_text();
    const Manifest manifest = test::without_errors(parse_manifest(text, "manifest.json"));
    EXPECT_EQ(manifest_json(manifest), text);
    ASSERT_EQ(manifest.assets.size(), 2u);
    EXPECT_EQ(manifest.assets[0].levels[0].probes.size(), 16u);
    EXPECT_FALSE(manifest.assets[1].error.has_value());
    EXPECT_EQ(manifest.assets[0].lookup_cost.value().operations, 70);
    EXPECT_EQ(text.back(), '\n');
}

// The text of a manifest with a volume of three levels in two formats.
std::string volume_text() {
    const TemporaryFolder folder;
    Baked volume = testing::sample_volume(
        {12, 10, 7}, 3, config::PixelType::half,
        {config::FileFormat::exr, config::FileFormat::bin, config::FileFormat::vdb}, 3);
    volume.layout = config::SheetLayout::atlas;
    volume.columns = 3;
    volume.seam_error = 1.0 / 3;
    volume.certificate.sky =
        SkyError{0.1, 0.2, 0.7, 30, "9 paths", 0.05, 3, "altitude_km 1", -4, "moments"};
    return manifest_json(testing::write_sample_volume(folder.path(), volume));
}

TEST(Manifest, ReadsAVolumeBackAsItWasWritten) {
    const std::string text = volume_text();
    const Manifest manifest = test::without_errors(parse_manifest(text, "manifest.json"));
    EXPECT_EQ(manifest_json(manifest), text);
    const ManifestAsset& asset = manifest.assets[0];
    EXPECT_TRUE(asset.is_volume());
    EXPECT_EQ(asset.size, (std::vector<int>{12, 10, 7}));
    EXPECT_EQ(asset.axes.size(), 3u);
    ASSERT_EQ(asset.levels.size(), 3u);
    EXPECT_EQ(asset.levels[2].size, (std::array<int, 3>{3, 2, 1}));
    EXPECT_EQ(asset.levels[0].content_hash, asset.content_hash);
    EXPECT_EQ(asset.levels[1].statistics[2].histogram.size(), 32u);
    ASSERT_EQ(asset.files.size(), 9u);
    EXPECT_EQ(asset.files[2].level, 2);
    EXPECT_EQ(asset.files[0].layout->columns, 3);
    EXPECT_EQ(asset.files[0].layout->rows, 3);
    EXPECT_FALSE(asset.files[3].layout.has_value());
    EXPECT_EQ(asset.files[3].compression, "none");
    EXPECT_EQ(asset.error.value().sky.value().worst, "altitude_km 1");
    EXPECT_EQ(asset.error.value().sky.value().worst_sun_deg, -4);
    EXPECT_EQ(asset.error.value().sky.value().better, "moments");
    EXPECT_EQ(asset.error.value().sky.value().standard_error, 0.05);
    EXPECT_EQ(asset.files[6].grids, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(asset.seam_error, 1.0 / 3);
}

struct Damage {
    std::string piece, other, named;
};

void expect_named(const std::vector<Damage>& all, const std::string& text) {
    for (const auto& [piece, other, named] : all) {
        const std::string message = message_with(piece, other, text);
        EXPECT_NE(message.find(named), std::string::npos) << message;
    }
}

TEST(Manifest, NamesThePlaceOfDamage) {
    expect_named({{"\"bytes\": ", "\"bytes\": -", "assets[0].files[0].bytes"},
                  {"\"quantity\"", "\"quality\"", "assets[0].mapping.u"},
                  {"\"assets\"", "\"asset\"", "`assets` is missing"},
                  {"\"skybake\"", "\"other\"", "not of skybake's"},
                  {"\"uv\": [", "\"uv\": [1, ", "2 values"},
                  {"\"assets\": [", "\"assets\": [[", "not JSON at line"}},
                 sample_text());
    expect_named({{"\"level\": 2", "\"level\": 3", "of level 3"},
                  {"\"level\": 0", "\"level\": -1", "assets[0].files[0].level"},
                  {"\"atlas\"", "\"heap\"", "there is no such layout"},
                  {"\"columns\": 3", "\"columns\": 99999999", "files[0].layout.columns"},
                  {"\"counts\": [", "\"counts\": [1.5, ", "histogram.counts[0]"},
                  {"\"uvw\": [", "\"uvw\": [1, ", "3 values"},
                  {"\"mips\"", "\"mops\"", "`mips` is missing"},
                  {"\"bin\"", "\"raw\"", "there is no such format"},
                  {"\"grids\": [", "\"grids\": [\"A\", ", "4 grids for 3 channels"},
                  {"\"w\": {", "\"x\": {", "`w` is missing"}},
                 volume_text());
}

TEST(Manifest, KeepsEveryBitOfANumber) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    const std::vector<double> numbers = {
        0.1, 1.0 / 3, 680, 5e-324, std::numeric_limits<double>::max(), 9.1e15, -0.0, -12.0, 1e300};
    manifest.assets[0].conventions.wavelengths_nm = numbers;
    manifest.assets[0].axes[1].constants = {{"a", 0.0}, {"b", numbers}, {"c", "12"}};
    manifest.assets[0].details = {{"list", std::vector<double>()}, {"one", std::vector<double>{1}}};
    const auto read = parse_manifest(manifest_json(manifest), "manifest.json");
    ASSERT_TRUE(read.value.has_value());
    const ManifestAsset& asset = read.value->assets[0];
    EXPECT_EQ(asset.conventions.wavelengths_nm, numbers);
    EXPECT_TRUE(std::signbit(asset.conventions.wavelengths_nm[6]));
    EXPECT_EQ(asset.axes[1].constants, manifest.assets[0].axes[1].constants);
    EXPECT_EQ(asset.details, manifest.assets[0].details);
}

TEST(Manifest, ConventionsAndAxesReadBack) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    manifest.assets[0].axes[0].wrap = AxisWrap::repeat;
    manifest.assets[0].axes[1].filter = AxisFilter::nearest;
    manifest.assets[0].axes[1].end_points = TexelConvention::end_points_on_edges;
    const auto read = parse_manifest(manifest_json(manifest), "manifest.json");
    ASSERT_TRUE(read.value.has_value());
    const ManifestAsset& asset = read.value->assets[0];
    EXPECT_EQ(asset.conventions.length_unit, "km");
    EXPECT_EQ(asset.conventions.coefficient_unit, "1/km");
    EXPECT_EQ(asset.conventions.angle_unit, "cosine");
    EXPECT_EQ(asset.conventions.radiance_unit, "1/sr");
    EXPECT_EQ(asset.conventions.solar_irradiance, (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(asset.conventions.up_axis, "");
    EXPECT_EQ(asset.axes[0].wrap, AxisWrap::repeat);
    EXPECT_EQ(asset.axes[0].filter, AxisFilter::linear);
    EXPECT_EQ(asset.axes[0].end_points, TexelConvention::end_points_on_texel_centres);
    EXPECT_EQ(asset.axes[1].wrap, AxisWrap::clamp);
    EXPECT_EQ(asset.axes[1].filter, AxisFilter::nearest);
    EXPECT_EQ(asset.axes[1].end_points, TexelConvention::end_points_on_edges);
}

// Returns the alterations of the text with one piece replaced, which can still be read.
std::vector<std::string> alterations_with(const std::string& piece, const std::string& other) {
    return test::without_errors(parsed_with(piece, other, sample_text())).alterations;
}

TEST(Manifest, NamesTheEntryThatHasBeenChanged) {
    const auto changed = alterations_with("\"error\": null", "\"error\": null, \"extra\": 1");
    ASSERT_EQ(changed.size(), 1u);
    EXPECT_TRUE(changed[0].starts_with("`assets[1]`, the entry of `second`, has been changed"));
}

TEST(Manifest, HashesAreNotTakenFromTheirOwnEntry) {
    const auto json = nlohmann::ordered_json::parse(sample_text());
    auto without = json;
    without["assets"][0].erase("hash");
    EXPECT_EQ(entry_hash(json["assets"][0]), json["assets"][0]["hash"]);
    EXPECT_EQ(entry_hash(without["assets"][0]), json["assets"][0]["hash"]);
    EXPECT_EQ(manifest_hash(json), json["hash"]);
    auto swapped = json;
    std::swap(swapped["assets"][0], swapped["assets"][1]);
    EXPECT_NE(manifest_hash(swapped), json["hash"]);
}

// A manifest as release 0.1.0 wrote it, as far as its claims go.
constexpr const char* earlier_text = R"({
  "format": 1,
  "tool": {"name": "skybake", "version": "0.1.0"},
  "conventions": {"length_unit": "km", "wavelengths_nm": [680, 550, 440]},
  "parameters": {},
  "assets": [{"name": "t", "files": [{"path": "t.exr", "xxh3": "0123"}]},
             {"name": "n", "files": [{"path": "n.exr", "xxh3": "45"}, {"path": "n.bin", "xxh3": "67"}]}],
  "retired": [{"path": "old.exr", "xxh3": "89"}]
})";

TEST(Manifest, SaysWhatToDoAboutOtherFormats) {
    const auto earlier = parse_manifest(earlier_text, "manifest.json");
    ASSERT_EQ(testing::first_code(earlier.diagnostics), "E0304");
    const std::string& message = earlier.diagnostics[0].message;
    EXPECT_NE(message.find("release 0.1.0 wrote format 1"), std::string::npos) << message;
    EXPECT_NE(message.find("bake the recipe into this folder again"), std::string::npos) << message;
    EXPECT_NE(message_with("\"format\": 3", "\"format\": 4").find("a later one"),
              std::string::npos);
}

TEST(Manifest, ClaimsOfEarlierFormatsAreFiles) {
    const auto claimed = parse_earlier_claims(earlier_text);
    ASSERT_TRUE(claimed.has_value());
    EXPECT_TRUE(claimed->assets.empty());
    std::string files;
    for (const RetiredFile& file : claimed->retired) files += file.path + ":" + file.xxh3 + " ";
    EXPECT_EQ(files, "t.exr:0123 n.exr:45 n.bin:67 old.exr:89 ");
    EXPECT_FALSE(parse_earlier_claims(sample_text()).has_value());  // of this format
    for (const auto& [piece, other] : {std::pair{"t.exr", "../t.exr"},
                                       {"skybake", "other"},
                                       {"\"xxh3\": \"45\"", "\"xxh3\": 45"}}) {
        std::string text = earlier_text;
        text.replace(text.find(piece), std::string_view(piece).size(), other);
        EXPECT_FALSE(parse_earlier_claims(text).has_value()) << other;
    }
}

TEST(Manifest, NestsParametersByPath) {
    const std::vector<config::ResolvedValue> values = {
        {"wavelengths", "", "[\"680 nm\", \"550 nm\"]", ""},
        {"atmosphere.ground_radius", "", "\"6360000 m\"", ""},
        {"atmosphere.layers.\"sea fog\".g", "", "0.8", ""},
        {"bake.transmittance.size", "", "[256, 64]", ""},
    };
    EXPECT_EQ(parameters_json(values),
              R"({"wavelengths":["680 nm","550 nm"],"atmosphere":{"ground_radius":"6360000 m",)"
              R"("layers":{"sea fog":{"g":0.8}}},"bake":{"transmittance":{"size":[256,64]}}})");
}

TEST(Manifest, MayNotPointOutOfItsFolder) {
    for (const char* path : {"/etc/passwd", "../a.exr", "a/../../b.exr", "", "a\\u0000b"}) {
        const std::string message = message_with("\"path\": \"transmittance.exr\"",
                                                 std::string("\"path\": \"") + path + "\"");
        EXPECT_NE(message.find("within the manifest's folder"), std::string::npos) << message;
    }
}

TEST(Manifest, SurvivesEveryTruncation) {
    const std::string text = sample_text();
    for (std::size_t size = 0; size + 1 < text.size(); size += 7) {
        EXPECT_EQ(testing::first_code(parse_manifest(text.substr(0, size), "cut").diagnostics),
                  "E0304");
    }
}

TEST(Manifest, SurvivesDamage) {
    Random random(3);
    const std::string samples[] = {sample_text(), volume_text()};
    for (int round = 0; round < 1000; ++round) {
        std::string text = samples[round % 2];
        for (std::size_t i = random.below(6) + 1; i > 0; --i) {
            text[random.below(text.size())] = static_cast<char>(random.next());
        }
        const auto read = parse_manifest(text, "damaged");
        EXPECT_NE(read.value.has_value(), !read.diagnostics.empty());
        if (read.value)
            manifest_json(*read.value);  // strings that are not UTF-8 must not throw either
    }
}

TEST(Manifest, SurvivesDeepNesting) {
    const std::string deep(200000, '[');
    EXPECT_EQ(testing::first_code(parse_manifest(deep, "deep").diagnostics), "E0304");
    const std::string closed = deep + std::string(200000, ']');
    EXPECT_EQ(testing::first_code(parse_manifest(closed, "deep").diagnostics), "E0304");
    for (const std::size_t levels : {100U, 101U}) {
        const std::string nested = std::string(levels, '[') + std::string(levels, ']');
        const auto outcome = parse_manifest(nested, "nested");
        ASSERT_EQ(outcome.diagnostics.size(), 1u);
        EXPECT_EQ(outcome.diagnostics[0].message.find("nest more than") != std::string::npos,
                  levels > 100);
    }
    const std::string within = "\"parameters\": {\"a\": " + closed + "}";
    EXPECT_NE(message_with("\"parameters\": {}", within).find("nest more than 100 deep"),
              std::string::npos);
    const std::string brackets(200, '[');
    EXPECT_EQ(alterations_with("\"parameters\": {}",
                               "\"parameters\": {\"a\\\"" + brackets + "\": \"" + brackets + "\"}")
                  .size(),
              1u);  // in texts they do not count
}

TEST(Manifest, MergesByName) {
    const auto named = [](std::vector<std::string> names, const std::string& kind) {
        Manifest manifest = new_manifest({});
        for (const std::string& name : names) {
            manifest.assets.emplace_back();
            manifest.assets.back().name = name;
            manifest.assets.back().kind = kind;
        }
        return manifest;
    };
    const Manifest merged =
        merge_manifests(named({"a", "b", "c"}, "old"), named({"d", "b"}, "new"));
    std::string found;
    for (const ManifestAsset& asset : merged.assets) found += asset.name + ":" + asset.kind + " ";
    EXPECT_EQ(found, "a:old b:new c:old d:new ");
}

TEST(Manifest, ClaimsItsFilesAndItself) {
    const TemporaryFolder folder;
    const Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    const ClaimedFiles claimed(manifest);
    EXPECT_TRUE(claimed.hold("transmittance.exr"));
    EXPECT_TRUE(claimed.hold("./transmittance.exr"));
    EXPECT_TRUE(claimed.hold("manifest.json"));
    EXPECT_FALSE(claimed.hold("other.exr"));
    EXPECT_FALSE(claimed.hold("sub/transmittance.exr"));
}

TEST(Manifest, MissingOneIsNotADamagedOne) {
    const TemporaryFolder folder;
    EXPECT_EQ(testing::first_code(read_manifest(folder.path()).diagnostics), "E0300");
    testing::write_bytes(folder / "manifest.json", "{}");
    EXPECT_EQ(testing::first_code(read_manifest(folder.path()).diagnostics), "E0304");
}

}  // namespace
}  // namespace skybake
