#include "bakers/workspace/folder_plan.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "bakers/io/manifest/release.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
namespace fs = std::filesystem;

std::string key(const config::Recipe& recipe, std::size_t bake,
                Certification certification = Certification::quick) {
    const auto identity = asset_identity(recipe, recipe.parameters.bakes.at(bake), certification);
    return identity.value ? identity.value->key : "";
}

TEST(AssetIdentity, WordingDoesNotMatter) {
    const std::string plain = "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\n";
    const std::string reworded =
        "# the same\npreset = \"earth_hillaire\"\n[atmosphere.layers.rayleigh]\nscale_height = "
        "\"8000 m\"\n"
        "[bake]\ntransmittance = { size = [0x20, 8], pixel_type = \"float\" }\n";
    EXPECT_EQ(key(recipe_of(plain), 0), key(recipe_of(reworded), 0));
}

TEST(AssetIdentity, EachThingThatDecidesBytesMatters) {
    const auto with = [](const std::string& setting) {
        return key(recipe_of(small_recipe, {}, {setting}), 1);
    };
    const std::set<std::string> keys = {
        key(recipe_of(small_recipe), 1),
        with("atmosphere.ground_albedo=0.1"),
        with("atmosphere.layers.mie.scale_height=1.3 km"),
        with("bake.multiple_scattering.size=[8, 9]"),
        with("bake.multiple_scattering.pixel_type=half"),
        with("bake.multiple_scattering.compression=piz"),
        key(recipe_of(small_recipe), 1, Certification::full),
        key(recipe_of(small_recipe), 1, Certification::off),
        key(recipe_of(small_recipe), 0),
    };
    EXPECT_EQ(keys.size(), 9U);
    EXPECT_EQ(key(recipe_of(small_recipe), 1), with("noise.shape.seed=77"));
    EXPECT_EQ(key(recipe_of(small_recipe), 1), with("bake.transmittance.size=[64, 8]"));
}

TEST(AssetIdentity, ReleaseAndVersionAreInTheKey) {
    const config::Recipe recipe = recipe_of(small_recipe);
    for (const config::Bake& bake : recipe.parameters.bakes) {
        const AssetIdentity now = *asset_identity(recipe, bake, Certification::quick).value;
        EXPECT_EQ(now.release, release());
        EXPECT_EQ(key_of(now), now.key);
        AssetIdentity other = now;
        other.release += "1";
        EXPECT_NE(key_of(other), now.key);
        other = now;
        ++other.baker_version;
        EXPECT_NE(key_of(other), now.key);
    }
}

constexpr const char* cloud_recipe = R"(
[noise.shape.channels.Y]
type = "worley"
frequency = 4
[clouds.c]
noise = "shape"
extent = ["6 km", "6 km", "1 km"]
coverage_map = { file = "coverage.png" }
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [16, 16, 8]
[bake.grid]
asset = "occupancy"
of = "c"
)";

TEST(AssetIdentity, AMapMattersByItsContentAlone) {
    const TemporaryFolder folder;
    const fs::path picture = folder / "coverage.png";
    write_bytes(picture, "one content");
    const config::Recipe recipe = recipe_of(cloud_recipe, folder.path());
    const std::string volume = key(recipe, 0);
    const std::string grid = key(recipe, 1);
    fs::last_write_time(picture, fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(key(recipe, 0), volume);
    write_bytes(picture, "other content");
    EXPECT_NE(key(recipe, 0), volume);
    EXPECT_NE(key(recipe, 1), grid);
    fs::remove(picture);
    const auto lost = asset_identity(recipe, recipe.parameters.bakes[0], Certification::quick);
    ASSERT_FALSE(lost.value.has_value());
    EXPECT_EQ(lost.diagnostics.at(0).code, "E0300");
}

TEST(AssetIdentity, DifferencesNameWhatHasChanged) {
    const TemporaryFolder folder;
    const fs::path picture = folder / "coverage.png";
    write_bytes(picture, "one content");
    const config::Recipe recipe = recipe_of(cloud_recipe, folder.path());
    const auto identity = asset_identity(recipe, recipe.parameters.bakes[0], Certification::quick);
    ManifestAsset entry;
    entry.parameters = identity.value->parameters;
    entry.release = release();
    entry.details = {{"baker_version", static_cast<double>(identity.value->baker_version)}};
    sign(*identity.value, entry);
    EXPECT_EQ(differences(*identity.value, entry), std::vector<std::string>{});

    write_bytes(picture, "other content");
    const config::Recipe changed = recipe_of(cloud_recipe, folder.path(),
                                             {"clouds.c.threshold=0.25", "clouds.c.coverage=0.5",
                                              "noise.shape.seed=3", "bake.c.pixel_type=float"});
    const auto other = asset_identity(changed, changed.parameters.bakes[0], Certification::off);
    const std::vector<std::string> all = differences(*other.value, entry, 99);
    EXPECT_EQ(all, (std::vector<std::string>{
                       "bake.c.pixel_type \"half\" → \"float\"", "clouds.c.coverage 1 → 0.5",
                       "clouds.c.threshold 0 → 0.25", "noise.shape.seed 0 → 3",
                       "coverage.png has changed content", "--certify quick → off"}));
    EXPECT_EQ(differences(*other.value, entry, 2),
              (std::vector<std::string>{all[0], all[1], "4 more"}));
    entry.release = "0.0.1";
    entry.details = {{"baker_version", 0.0}};
    EXPECT_EQ(differences(*identity.value, entry), std::vector<std::string>{});  // the key decides
    entry.key = "another";
    EXPECT_EQ(differences(*identity.value, entry),
              (std::vector<std::string>{fmt::format("release 0.0.1 → {}", release()),
                                        fmt::format("cloud_volume baker version 0 → {}",
                                                    identity.value->baker_version)}));
    entry.key.clear();
    EXPECT_EQ(differences(*other.value, entry),
              std::vector<std::string>{"baked by a release without keys"});
}

}  // namespace
}  // namespace skybake
