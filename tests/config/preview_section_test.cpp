#include <gtest/gtest.h>

#include <numbers>

#include "config/recipe/schema.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

constexpr double degree = std::numbers::pi / 180;

// A sky and a cloud, with [preview] on line 17.
const std::string base = R"(preset = "earth_hillaire"
[noise.n.channels.Y]
type = "worley"
frequency = 2
octaves = 1
[clouds.c]
noise = "n"
extent = ["2 km", "2 km", "1 km"]
[bake.transmittance]
size = [32, 8]
[bake.multiple_scattering]
size = [8, 8]
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [16, 16, 8]
[preview]
)";

TEST(PreviewSection, IsRead) {
    const Recipe recipe = valid(base + R"(size = [1920, 1080]
single = true
altitude = "2 km"
sun_elevation = ["20 deg", "-4 deg"]
sun_azimuth = "150 deg"
exposure = 2.5
tone_curve = "agx"
glare = "camera"
[preview.camera]
position = ["2 km", "-3 km", "200 m"]
heading = "120 deg"
pitch = "-5 deg"
fov = "40 deg"
)");
    const auto& preview = recipe.preview;
    ASSERT_TRUE(preview);
    EXPECT_EQ(preview->size, (std::array{1920, 1080}));
    EXPECT_TRUE(preview->single);
    EXPECT_EQ(preview->altitude, 2000);
    ASSERT_EQ(preview->sun_elevation.size(), 2U);
    EXPECT_DOUBLE_EQ(preview->sun_elevation[1].radians, -4 * degree);
    EXPECT_DOUBLE_EQ(preview->sun_azimuth.value(), 150 * degree);
    EXPECT_EQ(preview->exposure, 2.5);
    EXPECT_EQ(preview->tone_curve, ToneCurve::agx);
    EXPECT_EQ(preview->glare, Glare::camera);
    EXPECT_EQ(preview->camera.position, (std::array<double, 3>{2000, -3000, 200}));
    EXPECT_DOUBLE_EQ(preview->camera.heading.value(), 120 * degree);
    EXPECT_DOUBLE_EQ(preview->camera.pitch.value(), -5 * degree);
    EXPECT_DOUBLE_EQ(preview->camera.fov.value(), 40 * degree);
    EXPECT_EQ(value_at(recipe, "preview.camera.heading").origin, "test.toml:28");
}

TEST(PreviewSection, SaysNothingThatItIsNotTold) {
    EXPECT_FALSE(valid("preset = 'earth_hillaire'").preview);
    const auto preview = valid(base + "[preview.camera]\nfov = '40 deg'\n").preview;
    ASSERT_TRUE(preview);
    EXPECT_FALSE(preview->size || preview->at || preview->exposure || preview->camera.heading);
    EXPECT_TRUE(preview->sun_elevation.empty());
}

TEST(PreviewSection, TakesATimeAtAPlace) {
    const std::string place = "\nlatitude = '47.4 deg'\nlongitude = '8.5 deg'";
    const auto preview = valid(base + "at = '2026-06-21 18:30 +02:00'" + place).preview;
    ASSERT_TRUE(preview);
    EXPECT_EQ(preview->at, "2026-06-21 18:30 +02:00");
    EXPECT_DOUBLE_EQ(preview->latitude.value(), 47.4 * degree);
    EXPECT_DOUBLE_EQ(preview->longitude.value(), 8.5 * degree);
}

// A cloud's preset brings its camera and its suns, which the recipe overrides key by key; two clouds
// have one camera, which is neither's.
TEST(PreviewSection, ComesWithTheOnlyCloudsPreset) {
    const std::string storm = "[clouds.c]\npreset = 'cumulonimbus'\n";
    const auto preview = valid(storm + "[preview.camera]\nfov = '30 deg'\n").preview;
    ASSERT_TRUE(preview);
    EXPECT_TRUE(preview->single);
    EXPECT_FALSE(preview->sun_elevation.empty());
    EXPECT_TRUE(preview->camera.heading);
    EXPECT_DOUBLE_EQ(preview->camera.fov.value(), 30 * degree);
    EXPECT_FALSE(valid(storm + "[preview]\nsingle = false\n").preview->single);
    EXPECT_FALSE(valid(storm + "[clouds.d]\npreset = 'cirrus'\n").preview);
}

TEST(PreviewSection, IsNotPartOfWhatAssetsAreMadeFrom) {
    const Recipe plain = valid(base);
    const Recipe recipe = valid(base + "exposure = 3\n[preview.camera]\nheading = '3 deg'\n");
    EXPECT_EQ(plain.values.size() + 2, recipe.values.size());
    for (const Section& section : sections()) {
        const Read read = {std::string(section.path), Roles::all()};
        if (section.path.starts_with("preview")) continue;
        EXPECT_EQ(parameters_toml(recipe, std::span(&read, 1)),
                  parameters_toml(plain, std::span(&read, 1)));
    }
}

TEST(PreviewSection, IsInTheSchema) {
    const std::string schema = recipe_schema();
    EXPECT_NE(schema.find("\"sun_elevation\""), std::string::npos);
    EXPECT_NE(schema.find("\"heading\""), std::string::npos);
}

}  // namespace
}  // namespace skybake::config
