#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "config/assets/asset_kind.h"
#include "config/assets/bruneton.h"
#include "config/sections/targets.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using Codes = std::vector<std::string>;

// A recipe with one section of that asset, which gives these keys.
// The keys that an asset needs besides its name.
const std::map<std::string_view, std::string> NEEDED_KEYS = {
    {"noise_volume", "noise = 'n'\nsize = [16, 16, 16]\n"},
    {"weather_map", "noise = 'n'\n"},
    {"cloud_volume", "cloud = 'c'\nsize = [16, 16, 16]\n"},
    {"occupancy", "of = 'v'\n"},
    {"cloud_distance", "of = 'v'\n"},
    {"cloud_light", "of = 'v'\nsun_elevations = '30 deg'\n"},
    {"flipbook", "of = 'v'\n"},
    {"sky_view", "sun_elevations = '30 deg'\n"},
    {"phase", "layer = 'mie'\n"},
    {"aerial_perspective", "sun_elevation = '30 deg'\n"},
    {"environment", "sun_elevation = '30 deg'\n"}};

std::string recipe_of(std::string_view asset, const std::string& keys) {
    const bool frames = asset == "flipbook";
    const auto needed = NEEDED_KEYS.find(asset);
    return "preset = 'takram'\n[noise.n]\n" + std::string(frames ? "period = 1\n" : "") +
           "[noise.n.channels.Y]\ntype = 'perlin'\nremap = [-1, 1, 0, 1]\n[clouds.c]\n"
           "noise = 'n'\nextent = ['1 m', '1 m', '1 m']\n" +
           (frames ? "[bake.v_0001]\nframe = 1\n" : "[bake.v]\n") +
           "asset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n[bake.a]\nasset = '" +
           std::string(asset) + "'\n" + keys + (needed == NEEDED_KEYS.end() ? "" : needed->second);
}

// Every target either loads an asset with what it chooses by itself, or the recipe is told so.
TEST(Targets, LoadEveryAssetOrSayThatTheyDoNot) {
    for (const TargetFacts& target : targets()) {
        for (const AssetKind* kind : asset_kinds()) {
            const auto recipe =
                parse(recipe_of(kind->facts.name, fmt::format("target = '{}'\n", target.name)));
            const TargetUse* use = find_use(target, kind->facts.name);
            if (use && use->light_channels > 3) use = nullptr;  // the preset has three
            Codes errors;
            for (const Diagnostic& diagnostic : recipe.diagnostics) {
                if (diagnostic.severity == Severity::error) errors.push_back(diagnostic.code);
            }
            EXPECT_EQ(errors, use ? Codes{} : Codes{"E0160"})
                << target.name << ' ' << kind->facts.name;
            if (!use || !recipe.value) continue;
            const AssetFiles& files = files_of(recipe.value->parameters.bakes[1]);
            EXPECT_EQ(files.target, target.target);
            EXPECT_EQ(files.formats.size(), use->written);
            EXPECT_EQ(files.formats[0], use->formats[0]);
            EXPECT_TRUE(use->pixel_types.contains(files.pixel_type));
        }
    }
}

TEST(Bakes, EveryAssetOfTheTablesHasItsStruct) {
    for (const std::string_view asset : asset_names()) {
        const Recipe recipe = valid(recipe_of(asset, ""));
        ASSERT_EQ(recipe.parameters.bakes.size(), 2u) << asset;
        EXPECT_EQ(kind_of(recipe.parameters.bakes[1]).facts.name, asset);
    }
}

TEST(Targets, NameOnlyAssetsThatThereAre) {
    const std::vector<std::string_view> assets = asset_names();
    for (const TargetFacts& target : targets()) {
        for (const TargetUse& use : target.uses) {
            for (const std::string_view asset : use.assets) {
                EXPECT_EQ(std::count(assets.begin(), assets.end(), asset), 1) << asset;
            }
        }
    }
}

// The page has a row for what each target writes and one for how that is known.
TEST(Targets, AreAllOnTheirPage) {
    std::ifstream file(SKYBAKE_EXAMPLES "/targets.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    for (const TargetFacts& target : targets()) {
        const std::string word = "`" + std::string(target.name) + "`";
        std::size_t rows = 0;
        for (std::size_t at = page.find('\n'); at != page.npos; at = page.find('\n', at + 1)) {
            const std::string line = page.substr(at + 1, page.find('\n', at + 1) - at - 1);
            rows += line.starts_with("| ") && line.find(word) != line.npos ? 1 : 0;
        }
        EXPECT_GE(rows, 3U) << target.name << ": its files, its proof and its runtime";
    }
}

// CalcMySky's axis of the sun follows from the planet.
TEST(Targets, StellariumHasTheSunsAxisOfCalcMySky) {
    const std::string head =
        "preset = 'earth'\nwavelengths = 'best 8'\ntarget = 'stellarium'\n[color]\nspace = 'none'\n"
        "[bake.a]\nasset = 'bruneton'\n";
    const Recipe recipe = valid(head);
    ASSERT_EQ(recipe.parameters.bakes.size(), 2U) << "packets of four";
    const auto& bake = recipe.parameters.bakes[1].as<BrunetonBake>();
    EXPECT_NEAR(bake.sun_cos_zenith_min, -6371.0 / (2 * 6471), 1e-12);
    EXPECT_EQ(bake.formats, std::vector{FileFormat::f32});
}

// The files beside an asset's follow from the asset, whatever its mapping.
TEST(Targets, HaveTheSameSidecarsInAllUsesOfAnAsset) {
    for (const TargetFacts& target : targets()) {
        for (const TargetUse& use : target.uses) {
            for (const std::string_view asset : use.assets) {
                const TargetUse* first = find_use(target, asset);
                ASSERT_NE(first, nullptr);
                if (use.mappings.empty()) {
                    EXPECT_EQ(first, &use) << asset;
                }
                EXPECT_EQ(first->sidecars, use.sidecars) << target.name << ' ' << asset;
                for (const std::string_view mapping : use.mappings) {
                    EXPECT_EQ(find_use(target, asset, mapping), &use) << target.name;
                }
            }
        }
    }
}

TEST(Targets, HaveFilesNamedAfterTheSection) {
    AssetFiles files;
    EXPECT_TRUE(sidecar_names(files, "cloud_volume", "cirrus").empty());
    files.target = Target::godot;
    EXPECT_EQ(sidecar_names(files, "cloud_volume", "cirrus"),
              (std::vector<std::string>{"cirrus.gdshaderinc", "cirrus.tscn"}));
}

}  // namespace
}  // namespace skybake::config
