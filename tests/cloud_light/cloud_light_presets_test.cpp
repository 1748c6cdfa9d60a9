// Light at 1/8 of the voxels of every preset of clouds, at the preset's own size.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

// The RMS error of the sunlight that depths leave within cloud, as a share of the sun.
constexpr double kMostRms = 0.05;

TEST(SlowCloudLightPresets, OpticalDepthsAreWithinFivePercentOfTheSun) {
    for (const config::Preset& preset : config::cloud_presets()) {
        if (preset.name == "thesis") continue;  // has no volume of its own size
        const std::string text =
            config::cloud_init_text(preset) +
            fmt::format(
                "\n[bake.light]\nasset = \"cloud_light\"\nof = \"{}\"\n"
                "sun_elevations = [\"60 deg\", \"30 deg\", \"10 deg\"]\n"
                "sun_azimuths = [\"17 deg\", \"17 deg\", \"17 deg\"]\npixel_type = \"half\"\n",
                preset.name);
        const auto recipe = config::parse_recipe(text, std::string(preset.name));
        ASSERT_TRUE(recipe.value) << preset.name;
        const auto baked = bake_asset(*recipe.value, recipe.value->parameters.bakes.back(), {});
        ASSERT_TRUE(baked.value) << preset.name;
        const Certificate& certificate = baked.value->certificate;
        fmt::print("{}: {:.2f} % RMS, {:.1f} % at most, of {} points\n", preset.name,
                   100 * certificate.lookup.rms, 100 * certificate.lookup.max,
                   certificate.lookup_points);
        EXPECT_LE(certificate.lookup.rms, kMostRms) << preset.name;
        EXPECT_GT(certificate.lookup.rms, 0) << preset.name;
    }
}

}  // namespace
}  // namespace skybake
