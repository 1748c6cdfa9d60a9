// A cumulus seen from outside in the light of the sky and of the ground, marched with the textures of
// cloud_light, against paths of light. It prints a table of examples/assets/cloud_light.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/layer_sky.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "config/assets/cloud_volume.h"
#include "config/recipe/recipe.h"
#include "tests/cloud_light/view_pixels.h"

namespace skybake {
namespace {

using namespace test;
using cloud_light::CloudLayer;
using cloud_light::LayerSources;

constexpr double kMostRms = 0.05;
// A part of the preset's tile under the sky of the Earth with the sun at 30 degrees.
constexpr const char* kRecipe =
    "preset = 'earth'\n[clouds.c]\npreset = 'cumulus_humilis'\n"
    "extent = ['3 km', '3 km', '0.75 km']\ndetail_scale = [8, 8, 2]\n"
    "[clouds.c.convection]\ncells = [96, 96, 24]\npatches = 10\n"
    "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [256, 256, 64]\n"
    "[bake.l]\nasset = 'cloud_light'\nof = 'v'\ncontents = 'clear_sky_radiance'\n"
    "sun_elevations = '30 deg'\nsun_azimuths = '17 deg'\ndegree = 3\ncell = 4\n";

void print(const std::string& light, const Figures& found) {
    fmt::print("| {} | {:.1f} % | {:.1f} % | {:.1f} % |\n", light, 100 * found.rms,
               100 * found.noise, 100 * found.p99);
}

TEST(SlowSkyPictures, CumulusFromOutsideIsThatOfPaths) {
    const auto recipe = config::parse_recipe(kRecipe, "pictures");
    ASSERT_TRUE(recipe.value);
    const config::Parameters& parameters = recipe.value->parameters;
    const auto& bake = parameters.bakes[1].as<config::CloudLightBake>();
    const auto& of = parameters.bakes[0].as<config::CloudVolumeBake>();
    CloudLayer layer = layer_of(parameters);
    ASSERT_FALSE(cloud_light::add_sky(parameters, bake, spanned_cloud(parameters, of), "l",
                                      with_threads(), layer));
    const auto& scattering = cloud_light::scattering_of(layer, bake);
    LayerSources uniform, clear, seen_clear, ground;
    uniform.sky = clear.sky = seen_clear.sky = ground.ground = 1;
    clear.sky_shape = layer.sky.shape;
    seen_clear.sky_shape = layer.sky.reference;
    LightTextures textures;
    textures.depth_size = {1, 1, 1};
    textures.depth = {0};
    textures.size = cloud_light_size(layer.size, bake);

    textures.of_sky = radiance_texels(layer, bake, uniform);
    std::vector<Pixel> pixels = covered_pixels(layer, textures, scattering, uniform);
    ASSERT_GT(pixels.size(), 50U);
    trace(layer, scattering, uniform, kPathsOfPixel, pixels);
    const Figures of_uniform = figures_of(pixels);
    print("`sky_radiance`, uniform sky", of_uniform);
    EXPECT_LT(of_uniform.rms, kMostRms);

    // The same texture under a sky that is not uniform.
    std::vector<Pixel> of_wrong_sky = covered_pixels(layer, textures, scattering, seen_clear);
    textures.of_sky = radiance_texels(layer, bake, clear);
    pixels = covered_pixels(layer, textures, scattering, seen_clear);
    trace(layer, scattering, seen_clear, kPathsOfPixel, pixels);
    for (std::size_t n = 0; n < pixels.size(); ++n) of_wrong_sky[n].traced = pixels[n].traced;
    const Figures of_clear = figures_of(pixels);
    const Figures of_wrong = figures_of(of_wrong_sky);
    print("`clear_sky_radiance`, clear sky", of_clear);
    print("`sky_radiance`, clear sky", of_wrong);
    EXPECT_LT(of_clear.rms, kMostRms);
    EXPECT_LT(of_clear.rms, of_wrong.rms);
    double squares = 0;
    double mean = 0;
    for (std::size_t n = 0; n < pixels.size(); ++n) {
        const double difference = of_wrong_sky[n].marched - pixels[n].marched;
        squares += difference * difference / static_cast<double>(pixels.size());
        mean += pixels[n].marched / static_cast<double>(pixels.size());
    }
    fmt::print("between the two: {:.1f} %\n", 100 * std::sqrt(squares) / mean);

    textures.of_sky.clear();
    textures.of_ground = radiance_texels(layer, bake, ground);
    pixels = covered_pixels(layer, textures, scattering, ground);
    trace(layer, scattering, ground, kPathsOfPixel, pixels);
    const Figures of_ground = figures_of(pixels);
    print("`ground_radiance`", of_ground);
    EXPECT_LT(of_ground.rms, kMostRms);
}

}  // namespace
}  // namespace skybake
