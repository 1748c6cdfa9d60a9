// A cumulus seen from outside in the light of the sky and of the ground, marched with the textures of
// cloud_light, against paths of light. It prints a table of examples/assets/cloud_light.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/layer_sky.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/cloud_light/texel_fit.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "config/assets/cloud_volume.h"
#include "config/recipe/recipe.h"
#include "tests/cloud_light/radiance_view.h"

namespace skybake {
namespace {

using cloud_light::CloudLayer;
using cloud_light::LayerSources;

constexpr double kMostRms = 0.05;
constexpr int kDegree = 3;
constexpr int kColumns = 8;  // of a picture
constexpr int kRows = 6;
constexpr int kPathsOfPixel = 1024;
constexpr int kThreads = 2;

BakeOptions with_threads() { return {.threads = kThreads}; }

// A part of the preset's tile under the sky of the Earth with the sun at 30 degrees.
constexpr const char* kRecipe =
    "preset = 'earth'\n[clouds.c]\npreset = 'cumulus_humilis'\n"
    "extent = ['3 km', '3 km', '0.75 km']\ndetail_scale = [8, 8, 2]\n"
    "[clouds.c.convection]\ncells = [96, 96, 24]\npatches = 10\n"
    "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [256, 256, 64]\n"
    "[bake.l]\nasset = 'cloud_light'\nof = 'v'\ncontents = 'clear_sky_radiance'\n"
    "sun_elevations = '30 deg'\nsun_azimuths = '17 deg'\ndegree = 3\ncell = 4\n";

const config::CloudLightBake& light_of(const config::Parameters& parameters) {
    return parameters.bakes[1].as<config::CloudLightBake>();
}

CloudLayer layer_of(const config::Parameters& parameters) {
    const auto& of = parameters.bakes[0].as<config::CloudVolumeBake>();
    Baked volume;
    const BakeOptions options = with_threads();
    const auto held = hold_source_volume(parameters, "v", options, volume);
    const config::Cloud cloud = spanned_cloud(parameters, of);
    CloudLayer layer = cloud_light::make_layer(*held.value, 0, cloud, options);
    EXPECT_FALSE(
        cloud_light::add_sky(parameters, light_of(parameters), cloud, "l", options, layer));
    return layer;
}

// The coefficients of one source's light, as the baker makes them.
std::vector<std::vector<float>> texels_of(const CloudLayer& layer,
                                          const config::CloudLightBake& bake,
                                          const LayerSources& sources) {
    constexpr float kAny = std::numeric_limits<float>::max();
    const auto cells = cloud_light::place_grid(layer.size, cloud_light_spacing(bake), false);
    const auto solved = cloud_light::solve_radiance(layer, cells, cloud_light::scattering_of(bake),
                                                    kDegree, sources, with_threads());
    const cloud_light::TexelFit fit(cells.count, cloud_light_size(layer.size, bake),
                                    density_around(layer, cells, kThreads), kThreads);
    std::vector<std::vector<float>> texels;
    for (std::size_t c = 0; c < solved.scattered.count(); ++c) {
        texels.push_back(fit.fit(cloud_light::values_of(solved.scattered, c),
                                 cloud_light::ShownAs::itself, {-kAny, kAny}));
        round_values(texels.back().data(), texels.back().size(), config::PixelType::half);
    }
    return texels;
}

struct Pixel {
    glm::dvec3 place{};
    glm::dvec3 look{};
    std::uint32_t number = 0;
    double passed = 1;
    double light = 0;
};

// Four views: from above and from below, near the sun's side and near the other one.
Pixel pixel_of(const CloudLayer& layer, int i) {
    constexpr std::array<double, 4> kElevations = {-0.6, -0.6, 0.6, 0.6};
    constexpr std::array<double, 4> kAzimuths = {1.1, 2.7, 1.1, 2.7};
    const auto view = static_cast<std::size_t>(i / (kColumns * kRows));
    const int row = i / kColumns % kRows;
    Pixel pixel;
    pixel.number = static_cast<std::uint32_t>(i);
    pixel.look = cloud_light::towards(kElevations[view], kAzimuths[view]);
    pixel.place = {(i % kColumns + 0.5) / kColumns * layer.size[0],
                   (row + 0.5) / kRows * layer.size[1], pixel.look.z < 0 ? layer.size[2] : 0};
    return pixel;
}

// The pixels that the cloud covers.
std::vector<Pixel> marched(const CloudLayer& layer, const test::LightTextures& textures,
                           const config::CloudLightBake& bake, const LayerSources& sources) {
    std::vector<Pixel> pixels(4 * kColumns * kRows);
    parallel_for(static_cast<int>(pixels.size()), kThreads, [&](int i) {
        Pixel& pixel = pixels[static_cast<std::size_t>(i)];
        pixel = pixel_of(layer, i);
        pixel.light = test::marched(layer, textures, cloud_light::scattering_of(bake), sources,
                                    kDegree, pixel.place, pixel.look, 0.5, pixel.passed);
    });
    const auto is_clear = [](const Pixel& pixel) { return pixel.passed > 0.99; };
    pixels.erase(std::remove_if(pixels.begin(), pixels.end(), is_clear), pixels.end());
    return pixels;
}

std::vector<cloud_light::TracedRadiance> traced(const CloudLayer& layer,
                                                const config::CloudLightBake& bake,
                                                const LayerSources& sources,
                                                const std::vector<Pixel>& pixels) {
    const cloud_light::CloudPaths paths(layer, cloud_light::scattering_of(bake), sources, kThreads);
    std::vector<cloud_light::TracedRadiance> found(pixels.size());
    parallel_for(static_cast<int>(pixels.size()), kThreads, [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        found[n] = paths.trace(pixels[n].place, pixels[n].look, kPathsOfPixel, 7, pixels[n].number);
    });
    return found;
}

// Shares of the mean radiance.
struct Figures {
    double rms = 0;  // without the noise of the paths
    double noise = 0;
    double p99 = 0;  // with noise
};

Figures figures_of(const std::vector<Pixel>& pixels,
                   const std::vector<cloud_light::TracedRadiance>& wanted) {
    std::vector<double> errors;
    double mean = 0;
    double squares = 0;
    double noise = 0;
    for (std::size_t n = 0; n < pixels.size(); ++n) {
        mean += wanted[n].sum() / static_cast<double>(pixels.size());
        errors.push_back(std::fabs(pixels[n].light - wanted[n].sum()));
        squares += errors.back() * errors.back();
        noise += wanted[n].standard_error * wanted[n].standard_error;
    }
    const auto count = static_cast<double>(errors.size());
    std::sort(errors.begin(), errors.end());
    return {std::sqrt(std::max(squares - noise, 0.0) / count) / mean,
            std::sqrt(noise / count) / mean,
            errors[static_cast<std::size_t>(0.99 * (count - 1))] / mean};
}

void print(const std::string& light, const Figures& found) {
    fmt::print("| {} | {:.1f} % | {:.1f} % | {:.1f} % |\n", light, 100 * found.rms,
               100 * found.noise, 100 * found.p99);
}

TEST(SlowSkyPictures, CumulusFromOutsideIsThatOfPaths) {
    const auto recipe = config::parse_recipe(kRecipe, "pictures");
    ASSERT_TRUE(recipe.value);
    const config::CloudLightBake& bake = light_of(recipe.value->parameters);
    const CloudLayer layer = layer_of(recipe.value->parameters);
    LayerSources uniform, clear, seen_clear, ground;
    uniform.sky = clear.sky = seen_clear.sky = ground.ground = 1;
    clear.sky_shape = layer.sky.shape;
    seen_clear.sky_shape = layer.sky.reference;
    test::LightTextures textures;
    textures.depth_size = {1, 1, 1};
    textures.depth = {0};
    textures.size = cloud_light_size(layer.size, bake);

    textures.of_sky = texels_of(layer, bake, uniform);
    std::vector<Pixel> pixels = marched(layer, textures, bake, uniform);
    ASSERT_GT(pixels.size(), 50U);
    const Figures of_uniform = figures_of(pixels, traced(layer, bake, uniform, pixels));
    print("`sky_radiance`, uniform sky", of_uniform);
    EXPECT_LT(of_uniform.rms, kMostRms);

    // The same texture under a sky that is not uniform.
    const std::vector<Pixel> of_wrong_sky = marched(layer, textures, bake, seen_clear);
    textures.of_sky = texels_of(layer, bake, clear);
    pixels = marched(layer, textures, bake, seen_clear);
    const auto under_sky = traced(layer, bake, seen_clear, pixels);
    const Figures of_clear = figures_of(pixels, under_sky);
    const Figures of_wrong = figures_of(of_wrong_sky, under_sky);
    print("`clear_sky_radiance`, clear sky", of_clear);
    print("`sky_radiance`, clear sky", of_wrong);
    EXPECT_LT(of_clear.rms, kMostRms);
    EXPECT_LT(of_clear.rms, of_wrong.rms);
    double squares = 0;
    double mean = 0;
    for (std::size_t n = 0; n < pixels.size(); ++n) {
        const double difference = of_wrong_sky[n].light - pixels[n].light;
        squares += difference * difference / static_cast<double>(pixels.size());
        mean += pixels[n].light / static_cast<double>(pixels.size());
    }
    fmt::print("between the two: {:.1f} %\n", 100 * std::sqrt(squares) / mean);

    textures.of_sky.clear();
    textures.of_ground = texels_of(layer, bake, ground);
    pixels = marched(layer, textures, bake, ground);
    const Figures of_ground = figures_of(pixels, traced(layer, bake, ground, pixels));
    print("`ground_radiance`", of_ground);
    EXPECT_LT(of_ground.rms, kMostRms);
}

}  // namespace
}  // namespace skybake
