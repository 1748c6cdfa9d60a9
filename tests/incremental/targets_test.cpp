// The files that targets have besides those of assets are outputs like all others.
#include <regex>

#include "bakers/io/files/output_folder.h"
#include "bakers/io/manifest/verify.h"
#include "bakers/io/targets/sidecar.h"
#include "config/assets/asset_kind.h"
#include "config/sections/targets.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
using States = std::vector<AssetState>;
constexpr AssetState up_to_date = AssetState::up_to_date;
constexpr AssetState baked = AssetState::baked;

// One asset of each kind that bakes in milliseconds.
const std::string assets = R"(
preset = "earth_hillaire"
[noise.shape]
size = [8, 8, 8]
[noise.shape.channels.Y]
type = "worley"
[clouds.c]
noise = "shape"
extent = ["800 m", "400 m", "200 m"]
extinction_scale = "0.05 /m"
base_altitude = "1 km"
[bake.transmittance]
size = [8, 8]
[bake.my-sky]
asset = "environment"
orders = "single"
sun_elevation = "20 deg"
size = [8, 4]
[bake.shape]
asset = "noise_volume"
noise = "shape"
[bake.cloud]
asset = "cloud_volume"
cloud = "c"
size = [16, 8, 4]
)";

// Assets that only targets of skies load.
const std::string skies = assets + R"(
[bake.layer]
asset = "phase"
layer = "mie"
size = 8
[bake.to_top]
asset = "bruneton"
table = "transmittance"
size = [8, 4, 1]
[bake.seen]
asset = "bruneton"
table = "single_mie"
nu_size = 2
size = [8, 4, 2]
)";

// The sections of `skies` that the target loads, with the wavelengths that it loads.
config::Recipe loaded_by(const config::TargetFacts& target) {
    const config::Recipe recipe = recipe_of(skies);
    std::string text = skies.substr(0, skies.find("[bake."));
    if (target.target == config::Target::stellarium) {
        text.replace(0, text.find("[noise"),
                     "preset = \"earth\"\nwavelengths = \"best 4\"\n[color]\nspace = \"none\"\n");
    }
    for (const config::Bake& bake : recipe.parameters.bakes) {
        const config::TargetUse* use = config::find_use(target, config::kind_of(bake).facts.name);
        if (use == nullptr) continue;
        const std::size_t begin = skies.find("[bake." + bake.name);
        std::string section = skies.substr(begin, skies.find("[bake.", begin + 1) - begin);
        const std::string size = "size = [8, 4]";
        for (const auto& [mapping, its_size] :
             {std::pair{"cube", "size = [4, 24]"}, {"equal_area", "size = [8, 8]"}}) {
            if (use->mappings != std::vector<std::string_view>{mapping}) continue;
            section.replace(section.find(size), size.size(), its_size);
        }
        text += section;
    }
    return recipe_of(text, {}, {"target=\"" + std::string(target.name) + "\""});
}

TEST(TargetFiles, AreListedAndVerifiedAndNameWhatLiesBesideThem) {
    static const std::regex key(R"(\$(if |[A-Z_]+\$))");
    for (const config::TargetFacts& target : config::targets()) {
        const TemporaryFolder folder;
        TestBake bake(loaded_by(target), folder / "out");
        ASSERT_TRUE(bake.run().value) << target.name;
        const auto manifest = read_manifest(folder / "out");
        ASSERT_TRUE(manifest.value) << target.name;
        for (const ManifestAsset& asset : manifest.value->assets) {
            for (const ManifestFile& file : asset.files) {
                if (file.format != sidecar_format) continue;
                const std::string text = read_bytes(folder / "out" / file.path);
                EXPECT_NE(text.find(asset.files[0].path), std::string::npos) << file.path;
                EXPECT_FALSE(std::regex_search(text, key)) << file.path << ":\n" << text;
                EXPECT_EQ(file.bytes, text.size());
            }
        }
        const auto report = verify_bake(folder / "out", {}, {});
        ASSERT_TRUE(report.value) << target.name;
        EXPECT_TRUE(report.value->failures.empty()) << target.name;
        EXPECT_EQ(bake.states(), States(bake.bake.bakes.size(), up_to_date)) << target.name;
    }
}

TEST(TargetFiles, AreTheSameInEveryBake) {
    const TemporaryFolder folder;
    for (const char* name : {"one", "two"}) {
        TestBake bake(loaded_by(config::facts_of(config::Target::godot)), folder / name);
        ASSERT_TRUE(bake.run().value);
    }
    EXPECT_EQ(read_bytes(folder / "one/cloud.tscn"), read_bytes(folder / "two/cloud.tscn"));
}

TEST(TargetFiles, AreMadeAgainWhenTheyWereChangedAndFailVerification) {
    const TemporaryFolder folder;
    TestBake bake(loaded_by(config::facts_of(config::Target::pbrt)), folder / "out");
    ASSERT_TRUE(bake.run().value);
    const std::string whole = read_bytes(folder / "out/cloud.pbrt");
    write_bytes(folder / "out/cloud.pbrt", whole + "#");
    EXPECT_EQ(verify_bake(folder / "out", {}, {}).value->failures.size(), 2U);  // length and hash
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, baked}));
    EXPECT_EQ(read_bytes(folder / "out/cloud.pbrt"), whole);
}

TEST(TargetFiles, AreRetiredWithTheirTarget) {
    const TemporaryFolder folder;
    TestBake first(loaded_by(config::facts_of(config::Target::mitsuba)), folder / "out");
    ASSERT_TRUE(first.run().value);
    EXPECT_TRUE(std::filesystem::exists(folder / "out/cloud.mitsuba.xml"));
    TestBake second(loaded_by(config::facts_of(config::Target::blender)), folder / "out");
    second.bake.prune = true;
    ASSERT_TRUE(second.run().value);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/cloud.mitsuba.xml"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/cloud.vol"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/cloud.blender.py"));
}

// Unity finds files by identifiers, which follow from the names of the files alone.
TEST(TargetFiles, OfUnityHaveIdentifiersThatStay) {
    const TemporaryFolder folder;
    static const std::regex guid("\nguid: [0-9a-f]{32}\n");
    TestBake first(loaded_by(config::facts_of(config::Target::unity)), folder / "one");
    ASSERT_TRUE(first.run().value);
    TestBake second(recipe_of(skies, {}, {"target=\"unity\"", "bake.cloud.size=[8, 8, 4]"}),
                    folder / "two");
    ASSERT_TRUE(second.run().value);
    for (const char* name : {"cloud.bin.meta", "cloud.unity.cs.meta"}) {
        const std::string text = read_bytes(folder / "one" / name);
        EXPECT_TRUE(std::regex_search(text, guid)) << text;
        EXPECT_EQ(text, read_bytes(folder / "two" / name));
    }
    EXPECT_NE(read_bytes(folder / "one/cloud.bin"), read_bytes(folder / "two/cloud.bin"));
    EXPECT_NE(read_bytes(folder / "one/cloud.bin.meta").substr(0, 60),
              read_bytes(folder / "one/shape.bin.meta").substr(0, 60));
}

// The place of the cloud and the number that makes extinction of its density, in another program's words.
TEST(TargetFiles, SayWhereTheVolumeIsAndWhatItMeans) {
    const TemporaryFolder folder;
    TestBake bake(loaded_by(config::facts_of(config::Target::godot)), folder / "out");
    ASSERT_TRUE(bake.run().value);
    const std::string text = read_bytes(folder / "out/cloud.tscn");
    EXPECT_NE(text.find("size = Vector3(800, 400, 200)"), std::string::npos) << text;
    EXPECT_NE(text.find(", 400, 1100, -200)"), std::string::npos) << text;
    EXPECT_NE(text.find("density = 0.05\n"), std::string::npos) << text;
}

// Where the sun stands follows the recipe's azimuth.
TEST(TargetFiles, SayWhereTheSunStands) {
    for (const auto& [azimuth, words] :
         {std::pair{"0 deg", "over +x"}, std::pair{"40 deg", "40 degrees to the right of +x"},
          std::pair{"-90 deg", "90 degrees to the left of +x"}}) {
        for (const auto& [target, name] :
             {std::pair{"three", "sky.three.js"}, std::pair{"blender", "sky.blender.py"},
              std::pair{"mitsuba", "sky.mitsuba.xml"}}) {
            const TemporaryFolder folder;
            TestBake bake(
                recipe_of("preset = \"earth_hillaire\"\ntarget = \"" + std::string(target) +
                          "\"\n[bake.sky]\nasset = \"environment\"\norders = \"single\"\n"
                          "mapping = \"longitude_latitude\"\nformats = [\"exr\"]\n"
                          "sun_elevation = \"20 deg\"\nsize = [8, 4]\nsun_azimuth = \"" +
                          azimuth + "\"\n"),
                folder / "out");
            ASSERT_TRUE(bake.run().value);
            const std::string text = read_bytes(folder / "out" / name);
            EXPECT_NE(text.find(words), std::string::npos)
                << azimuth << ": " << text.substr(0, 400);
        }
    }
}

}  // namespace
}  // namespace skybake
