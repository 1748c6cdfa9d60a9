// Channels do not see each other: where the atmosphere's values of red, green and blue change
// places, so do those of every asset, and nothing else changes. Air, aerosol, absorption and ground
// each have another value for each channel, so that a value taken from the wrong one is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/light/higher_orders.h"
#include "tests/support/atmospheres.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

// The places of wavelengths among three channels.
struct ChannelOrder {
    std::array<std::size_t, 3> places{};

    std::string of(const std::array<std::string, 3>& values) const {
        return "[" + values[places[0]] + ", " + values[places[1]] + ", " + values[places[2]] + "]";
    }
};

constexpr ChannelOrder kStraight = {{0, 1, 2}};
constexpr ChannelOrder kTurned = {{2, 0, 1}};

std::string atmosphere_of(const ChannelOrder& order) {
    return "preset = \"earth_hillaire\"\nwavelengths = " +
           order.of({"\"680 nm\"", "\"550 nm\"", "\"440 nm\""}) +
           "\n[atmosphere]\nground_albedo = " + order.of({"0.05", "0.9", "0.4"}) +
           "\n[atmosphere.layers.rayleigh]\nscattering = " +
           order.of({"\"5.8e-6 /m\"", "\"1.35e-5 /m\"", "\"3.3e-5 /m\""}) +
           "\n[atmosphere.layers.mie]\nscattering = " +
           order.of({"\"4e-6 /m\"", "\"3e-6 /m\"", "\"6e-6 /m\""}) +
           "\nextinction = " + order.of({"\"5e-6 /m\"", "\"4.4e-6 /m\"", "\"6e-6 /m\""}) +
           "\n[atmosphere.layers.ozone]\nabsorption = " +
           order.of({"\"6.5e-7 /m\"", "\"1.9e-6 /m\"", "\"8.5e-8 /m\""}) + "\n";
}

// Assets small enough for a test; all that need solved light share one solution.
const char* const kAssets = R"(
[bake.transmittance]
size = [4, 4]
pixel_type = "float"
[bake.scattered]
asset = "multiple_scattering"
method = "converged"
mapping = "hillaire"
size = [4, 4]
pixel_type = "float"
[bake.solved]
asset = "multiple_scattering"
method = "solved"
mapping = "twilight"
size = [4, 4]
pixel_type = "float"
[bake.view]
asset = "sky_view"
size = [4, 4]
sun_elevations = ["20 deg"]
pixel_type = "float"
[bake.aerial]
asset = "aerial_perspective"
sun_elevation = "20 deg"
size = [2, 2, 2]
pixel_type = "float"
[bake.fallen]
asset = "irradiance"
size = [4, 2]
pixel_type = "float"
[bake.scattering]
asset = "bruneton"
combined = false
size = [8, 4, 2]
nu_size = 2
pixel_type = "float"
[bake.ground]
asset = "bruneton"
table = "irradiance"
size = [4, 2, 1]
pixel_type = "float"
)";

Baked baked(const config::Recipe& recipe, const config::Bake& bake) {
    return test::without_errors(bake_asset(recipe, bake, {.certification = Certification::off}));
}

// Where the values of channel c of the straight order stand in the turned one.
std::size_t place_in_turned(const std::vector<std::string>& names, std::size_t c) {
    const std::string letters = "RGB";
    const std::size_t at = letters.find(names[c]);
    if (at == std::string::npos) return c;  // of no wavelength
    const auto place = std::find(kTurned.places.begin(), kTurned.places.end(), at);
    const std::string name(1, letters[static_cast<std::size_t>(place - kTurned.places.begin())]);
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// Hillaire's closure: half of the mean radiance at the ground is the sky's, half the ground's, of its
// own albedo in each channel. Without air the sun is not dimmed.
TEST(Channels, TheGroundOfHillairesClosureHasItsOwnAlbedo) {
    Medium air;
    air.channels = 3;
    air.ground_radius_km = 6360;
    air.thickness_km = 100;
    air.ground_albedo = {0.1, 0.4, 0.9, 0};
    const Spectrum sky = {0.2, 0.02, 0.002, 0};
    const double mu = 0.5;
    const IsotropicOrders orders(air, [&](double, double sun) {
        const Spectrum lit = std::max(sun, 0.0) / std::numbers::pi + sky;
        return 0.5 * (sky + air.ground_albedo * lit);
    });
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(orders.sky_irradiance(mu)[c], std::numbers::pi * sky[c], 1e-12) << c;
        EXPECT_NEAR(orders.sky_irradiance(-mu)[c], std::numbers::pi * sky[c], 1e-12) << c;
    }
}

TEST(Channels, ChangePlacesWithTheirValues) {
    const config::Recipe straight = test::recipe_of(atmosphere_of(kStraight) + kAssets);
    const config::Recipe turned = test::recipe_of(atmosphere_of(kTurned) + kAssets);
    ASSERT_EQ(straight.parameters.bakes.size(), 8U);
    for (std::size_t i = 0; i < straight.parameters.bakes.size(); ++i) {
        const Baked straight_asset = baked(straight, straight.parameters.bakes[i]);
        const std::vector<std::string>& names = straight_asset.channel_names;
        const auto before = testing::planes_of(straight_asset);
        const auto after = testing::planes_of(baked(turned, turned.parameters.bakes[i]));
        ASSERT_GE(before.size(), 3U);
        for (std::size_t c = 0; c < before.size(); ++c) {
            const std::vector<float>& a = before[c];
            const std::vector<float>& b = after[place_in_turned(names, c)];
            const float largest = *std::max_element(a.begin(), a.end());
            EXPECT_GT(largest, 0);
            double off = 0;
            for (std::size_t k = 0; k < a.size(); ++k) {
                off = std::max(off, std::fabs(double{a[k]} - double{b[k]}));
            }
            EXPECT_LE(off, 1e-6 * double{largest}) << "section " << i << ", channel " << names[c];
        }
    }
}

}  // namespace
}  // namespace skybake
