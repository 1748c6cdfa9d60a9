#include "config/assets/target_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "config/assets/asset_kind.h"
#include "config/assets/bruneton.h"
#include "config/sections/targets.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::codes_and_places;
using testing::parse;
using testing::valid;
using testing::valid_with_warnings;
using testing::value_at;
using Codes = std::vector<std::string>;

// A recipe with one section of that asset, which gives these keys.
std::string recipe_of(std::string_view asset, const std::string& keys) {
    std::string more;
    if (asset == "noise_volume") more = "noise = 'n'\nsize = [16, 16, 16]\n";
    if (asset == "weather_map") more = "noise = 'n'\n";
    if (asset == "cloud_volume") more = "cloud = 'c'\nsize = [16, 16, 16]\n";
    if (asset == "occupancy" || asset == "cloud_distance") more = "of = 'v'\n";
    if (asset == "cloud_light") more = "of = 'v'\nsun_elevations = '30 deg'\n";
    if (asset == "flipbook") more = "of = 'v'\n";
    const bool needs_frames = asset == "flipbook";
    const std::string moving = needs_frames ? "[noise.n]\nperiod = 1\n" : "";
    const std::string volume = needs_frames ? "[bake.v_0001]\nframe = 1\n" : "[bake.v]\n";
    if (asset == "sky_view") more = "sun_elevations = '30 deg'\n";
    if (asset == "phase") more = "layer = 'mie'\n";
    if (asset == "aerial_perspective" || asset == "environment")
        more = "sun_elevation = '30 deg'\n";
    return "preset = 'takram'\n" + moving +
           "[noise.n.channels.Y]\ntype = 'perlin'\nremap = [-1, 1, 0, 1]\n[clouds.c]\n"
           "noise = 'n'\nextent = ['1 m', '1 m', '1 m']\n" +
           volume +
           "asset = 'cloud_volume'\ncloud = 'c'\n"
           "size = [16, 16, 16]\n[bake.a]\nasset = '" +
           std::string(asset) + "'\n" + keys + more;
}

std::string target_key(const TargetFacts& target) {
    return "target = '" + std::string(target.name) + "'\n";
}

// Every target either loads an asset with what it chooses by itself, or the recipe is told so.
TEST(Targets, LoadEveryAssetOrSayThatTheyDoNot) {
    for (const TargetFacts& target : targets()) {
        for (const AssetKind* kind : asset_kinds()) {
            const auto recipe = parse(recipe_of(kind->facts.name, target_key(target)));
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

// Light of other wavelengths than the program's textures hold is an error, with a way out.
TEST(Targets, RefuseLightOfOtherChannels) {
    const auto errors = [](const std::string& head, const std::string& keys) {
        return parse(head + "[bake.a]\nasset = 'bruneton'\n" + keys).diagnostics;
    };
    const std::string four = "preset = 'earth'\nwavelengths = 'best 4'\n[color]\nspace = 'none'\n";
    const std::string three = "preset = 'earth_hillaire'\n";
    EXPECT_EQ(codes_and_places(errors(three, "target = 'cosmoscout'\n")), Codes{});
    EXPECT_EQ(codes_and_places(errors(four, "target = 'stellarium'\n")), Codes{});
    const auto many = errors(four, "target = 'cosmoscout'\n");
    ASSERT_EQ(codes_and_places(many), (Codes{"E0160 7:10"}));
    EXPECT_EQ(many[0].message,
              "[bake.a]: cosmoscout loads light of 3 channels, and this recipe has 4");
    const auto few = errors(three, "target = 'stellarium'\n");
    ASSERT_EQ(codes_and_places(few), (Codes{"E0160 4:10"}));
    EXPECT_EQ(few[0].label, "give `wavelengths` in multiples of four, and no [color]");
    const auto combined = errors(three, "target = 'cosmoscout'\ncombined = true\n");
    ASSERT_EQ(codes_and_places(combined), (Codes{"E0160 5:12"}));
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
    EXPECT_EQ(codes_and_places(parse(head + "sun_cos_zenith_min = -0.2\n").diagnostics),
              (Codes{"E0110 8:22"}));
}

TEST(Targets, StandForAllSectionsThatNameNone) {
    const Recipe recipe = valid(
        "preset = 'earth_hillaire'\ntarget = 'blender'\n[bake.transmittance]\ntarget = 'three'\n"
        "[bake.environment]\nsun_elevation = '30 deg'\n");
    EXPECT_EQ(files_of(recipe.parameters.bakes[0]).formats, std::vector{FileFormat::ktx2});
    EXPECT_EQ(files_of(recipe.parameters.bakes[1]).formats, std::vector{FileFormat::exr});
    EXPECT_EQ(value_at(recipe, "bake.environment.target").canonical, "\"blender\"");
    EXPECT_EQ(value_at(recipe, "bake.environment.target").origin, "derived");
}

TEST(Targets, YieldToGivenKeysThatTheyLoad) {
    const Recipe recipe = valid(
        recipe_of("noise_volume", "target = 'unreal'\npixel_type = 'unorm8'\nmips = 'all'\n"));
    const AssetFiles& files = files_of(recipe.parameters.bakes[1]);
    EXPECT_EQ(files.pixel_type, PixelType::unorm8);
    EXPECT_EQ(files.mips, 5);
    EXPECT_EQ(files.formats, std::vector{FileFormat::dds});
    const Recipe cloud = valid(recipe_of("cloud_volume", "target = 'unreal'\nformats = ['dds']\n"));
    EXPECT_EQ(files_of(cloud.parameters.bakes[1]).formats, std::vector{FileFormat::dds});
    const Recipe bevy =
        valid(recipe_of("noise_volume", "target = 'bevy'\nktx2_compression = 'zstd'\n"));
    EXPECT_EQ(files_of(bevy.parameters.bakes[1]).ktx2_compression, Ktx2Compression::zstd);
}

TEST(Targets, RefuseGivenKeysThatTheyDoNotLoad) {
    const auto errors = [](std::string_view asset, const std::string& keys) {
        return parse(recipe_of(asset, keys)).diagnostics;
    };
    const auto formats = errors("noise_volume", "target = 'godot'\nformats = ['dds', 'exr']\n");
    ASSERT_EQ(codes_and_places(formats), (Codes{"E0160 15:11"}));
    EXPECT_EQ(formats[0].message, "`bake.a.formats`: godot cannot load noise_volume with \"exr\"");
    EXPECT_EQ(formats[0].label, "it loads dds");
    const auto types = errors("noise_volume", "pixel_type = 'unorm16'\ntarget = 'three'\n");
    ASSERT_EQ(codes_and_places(types), (Codes{"E0160 14:14"}));
    EXPECT_EQ(types[0].label, "it loads float, half, unorm8");
    const auto convention = errors("bruneton", "target = 'takram'\nconvention = 'bruneton'\n");
    ASSERT_EQ(codes_and_places(convention), (Codes{"E0160 15:14"}));
    EXPECT_EQ(convention[0].label, "it loads takram");
}

// Godot takes the number of levels for that of the size.
TEST(Targets, RefuseLevelsThatEndEarlyWhereTheProgramDoes) {
    const std::string keys = "mips = ";
    const auto errors = [&](const std::string& levels, const std::string& target) {
        return parse(recipe_of("noise_volume", keys + levels + "\ntarget = '" + target + "'\n"))
            .diagnostics;
    };
    EXPECT_EQ(codes_and_places(errors("1", "godot")), Codes{});
    EXPECT_EQ(codes_and_places(errors("5", "godot")), Codes{});
    EXPECT_EQ(codes_and_places(errors("'all'", "godot")), Codes{});
    EXPECT_EQ(codes_and_places(errors("3", "three")), Codes{});
    const auto refused = errors("3", "godot");
    ASSERT_EQ(codes_and_places(refused), (Codes{"E0160 14:8"}));
    EXPECT_EQ(refused[0].label, "it loads 1 level, or all 5");
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

TEST(Targets, RefuseAssetsWithWhatTheyLoadInstead) {
    const auto refused = parse(recipe_of("transmittance", "target = 'pbrt'\n")).diagnostics;
    ASSERT_EQ(codes_and_places(refused), (Codes{"E0160 14:10"}));
    EXPECT_EQ(refused[0].message, "[bake.a]: pbrt has no use for the asset transmittance");
    EXPECT_EQ(refused[0].label, "it loads cloud_volume, noise_volume");
    const auto usual =
        parse("preset = 'vacuum'\ntarget = 'pbrt'\n[bake.transmittance]\n").diagnostics;
    EXPECT_EQ(codes_and_places(usual), (Codes{"E0160 3:7"}));
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
