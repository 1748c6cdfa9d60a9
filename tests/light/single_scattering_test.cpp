// Light that is scattered once, where it is hard to compute: in the sunlit skin of a fog with a hard
// top, and of layers with forward peaks.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/light/sky_radiance.h"
#include "config/assets/sky_view.h"
#include "tests/light/single_scattering_reference.h"
#include "tests/light/sky_media.h"
#include "tests/support/shared_bakes.h"

namespace skybake {
namespace {

using test::kDegree;

constexpr double kRadius = 6360;
constexpr double kThickness = 100;

// Rayleigh's air, and a layer of Henyey and Greenstein's phase function.
std::string recipe(const std::string& profile, const std::string& scattering, double g,
                   const std::string& bakes) {
    return fmt::format(
        "[atmosphere]\nground_radius = '6360 km'\ntop_radius = '6460 km'\nground_albedo = 0.2\n"
        "[atmosphere.layers.rayleigh]\nphase = 'rayleigh'\nprofile = 'exponential'\n"
        "scale_height = '8 km'\n"
        "scattering = ['5.802e-6 /m', '1.3558e-5 /m', '3.31e-5 /m']\n"
        "[atmosphere.layers.fog]\nphase = 'henyey_greenstein'\ng = {}\n{}"
        "scattering = '{}'\n{}",
        g, profile, scattering, bakes);
}

struct Errors {
    double rms = 0;
    double largest = 0;
};

// Returns the errors of a view's texels, relative to the light but at least to a thousandth of its
// table's brightest.
Errors errors_of(const config::Recipe& recipe, const test::PlainLayer& fog) {
    const config::Bake& bake = recipe.parameters.bakes.front();
    const auto& asset = bake.as<config::SkyViewBake>();
    const Baked baked = test::SharedBakes().baked(recipe, bake);
    const Image2<float>& image = baked.image();
    const SkyViewCamera camera({kRadius, kThickness}, asset.altitude.kilometers());
    // In red, which the air above dims least.
    test::PlainLayer rayleigh;
    rayleigh.scattering = 5.802e-3;
    rayleigh.scale_height = 8;
    rayleigh.rayleigh = true;
    const test::PlainAir air = {kRadius, kRadius + kThickness, {rayleigh, fog}};
    Errors errors;
    int count = 0;
    for (std::size_t sun = 0; sun < asset.sun_elevations.size(); ++sun) {
        const double sun_zenith = 90 * kDegree - asset.sun_elevations[sun].radians;
        std::vector<std::array<double, 2>> pairs;  // found, right
        for (int y = 0; y < asset.size[1]; ++y) {
            // On its side of the horizon.
            const double v = camera.off_the_edges(static_cast<double>(y) / (asset.size[1] - 1));
            const double zenith = 90 * kDegree - (camera.angle_at(v) - camera.dip());
            for (int x = 0; x < asset.size[0]; ++x) {
                const double azimuth = 180 * kDegree * x / (asset.size[0] - 1);
                const int row = static_cast<int>(sun) * asset.size[1] + y;
                if (v != static_cast<double>(y) / (asset.size[1] - 1)) continue;
                pairs.push_back({image.texel(x, row)[0],
                                 static_cast<double>(air.radiance(asset.altitude.kilometers(),
                                                                  zenith, azimuth, sun_zenith))});
            }
        }
        double brightest = 0;
        for (const auto& [found, right] : pairs) brightest = std::max(brightest, right);
        for (const auto& [found, right] : pairs) {
            const double error = (found - right) / std::max(right, 1e-3 * brightest);
            errors.rms += error * error;
            errors.largest = std::max(errors.largest, std::fabs(error));
            ++count;
        }
    }
    errors.rms = std::sqrt(errors.rms / count);
    return errors;
}

// From above, where the sun's rays reach some centimetres into the fog.
TEST(SingleScattering, LightsTheSkinOfFogWithAHardTop) {
    const std::string bakes =
        "[bake.s]\nasset = 'sky_view'\norders = 'single'\naltitude = '3 km'\nsize = [5, 6]\n"
        "pixel_type = 'float'\nsun_elevations = ['{} deg']\n";
    test::PlainLayer slab;
    slab.scattering = 30;
    slab.top = 0.1;
    slab.g = 0.8;
    for (const double elevation : {0.0, 1.0, 3.0, 5.0, 10.0}) {
        const Errors errors = errors_of(
            test::recipe_of(recipe("profile = 'slab'\nbottom_altitude = '0 km'\n"
                                   "top_altitude = '0.1 km'\n",
                                   "0.03 /m", 0.8, fmt::format(fmt::runtime(bakes), elevation))),
            slab);
        EXPECT_LT(errors.rms, 0.01) << "sun " << elevation;
        EXPECT_LT(errors.largest, 0.05) << "sun " << elevation;
    }
}

// Only air that begins or ends abruptly pays for its skins.
TEST(SingleScattering, SmoothAirHasNoSkins) {
    for (const char* preset : {"earth", "earth_hillaire", "earth_bruneton", "earth_urban_haze",
                               "mars", "tiny_planet", "dense_earth"}) {
        EXPECT_TRUE(lit_skins(test::preset_medium(preset)).layers.empty()) << preset;
    }
}

// Nothing counts as not scattered where light is scattered once.
TEST(SingleScattering, KnowsNoForwardPeaks) {
    for (const double g : {0.9, 0.99}) {
        test::PlainLayer layer;
        layer.scattering = 0.1;
        layer.scale_height = 1.2;
        layer.g = g;
        const Errors errors = errors_of(
            test::recipe_of(recipe(
                "profile = 'exponential'\nscale_height = '1.2 km'\n", "0.1 /km", g,
                "[bake.s]\nasset = 'sky_view'\norders = 'single'\naltitude = '0.5 km'\n"
                "size = [5, 6]\npixel_type = 'float'\nsun_elevations = ['60 deg', '0 deg']\n")),
            layer);
        EXPECT_LT(errors.rms, 2e-3) << g;
        EXPECT_LT(errors.largest, 1e-2) << g;
    }
}

// Light scattered once and light scattered more often add up to all light, in tables and around cameras.
TEST(SingleScattering, AddsUpWithTheRest) {
    std::string bakes;
    const auto sections = [](const char* orders) {
        return fmt::format(
            "[bake.view_{0}]\nasset = 'sky_view'\norders = '{0}'\nsize = [5, 7]\n"
            "pixel_type = 'float'\nsun_elevations = ['30 deg', '2 deg']\n"
            "[bake.map_{0}]\nasset = 'environment'\norders = '{0}'\nsize = [16, 8]\n"
            "pixel_type = 'float'\nsun_elevation = '30 deg'\n"
            "[bake.ground_{0}]\nasset = 'irradiance'\norders = '{0}'\ncontent = 'sky'\n"
            "size = [8, 3]\npixel_type = 'float'\nmax_texel_error = 1\n",
            orders);
    };
    for (const char* orders : {"single", "multiple", "all"}) bakes += sections(orders);
    const config::Recipe peaked = test::earth_with_drops(bakes);
    test::SharedBakes shared;
    std::vector<Baked> made;
    for (const config::Bake& bake : peaked.parameters.bakes) {
        made.push_back(shared.baked(peaked, bake));
    }
    for (std::size_t kind = 0; kind < 3; ++kind) {
        const Image2<float>& all = made[kind + 6].image();
        for (std::size_t i = 0; i < all.texels.size(); ++i) {
            const double sum = made[kind].image().texels[i] + made[kind + 3].image().texels[i];
            // Where the parts are less than nothing they end at 0.
            EXPECT_NEAR(sum, all.texels[i], 1e-5 * std::fabs(all.texels[i]) + 1e-9)
                << made[kind].name << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace skybake
