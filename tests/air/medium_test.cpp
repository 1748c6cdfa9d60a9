#include "bakers/air/medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

TEST(Medium, EarthAtTheGroundAndInTheOzone) {
    const Medium earth = test::preset_medium("earth_hillaire");
    EXPECT_EQ(earth.channels, 3);
    EXPECT_EQ(earth.ground_radius_km, 6360);
    EXPECT_EQ(earth.thickness_km, 100);
    EXPECT_EQ(earth.exponential_layers.size(), 2U);
    EXPECT_EQ(earth.piecewise_layers.size(), 1U);
    EXPECT_NEAR(extinction_at(earth, 0)[2], 3.31e-2 + 4.44e-3, 1e-15);
    EXPECT_NEAR(scattering_at(earth, 0)[0], 5.802e-3 + 3.996e-3, 1e-15);
    const double rayleigh = 1.3558e-2 * std::exp(-25 / 8.0);
    const double mie = 4.44e-3 * std::exp(-25 / 1.2);
    EXPECT_NEAR(extinction_at(earth, 25)[1], rayleigh + mie + 1.881e-3, 1e-15);
    EXPECT_NEAR(extinction_at(earth, 32.5)[1] - scattering_at(earth, 32.5)[1],
                0.5 * 1.881e-3 + 4.44e-4 * std::exp(-32.5 / 1.2), 1e-15);
}

TEST(Medium, ManyAltitudesAtOnceHaveTheSameBits) {
    const Medium earth = test::preset_medium("earth_hillaire");
    std::vector<double> altitudes;
    for (int i = 0; i <= 37; ++i) altitudes.push_back(i * 2.7);
    const std::vector<Coefficients> many = coefficients_at(earth, altitudes);
    for (std::size_t i = 0; i < altitudes.size(); ++i) {
        const Coefficients one = coefficients_at(earth, altitudes[i]);
        EXPECT_EQ(many[i].extinction_per_km, one.extinction_per_km);
        EXPECT_EQ(many[i].scattering_per_km, one.scattering_per_km);
    }
}

TEST(Medium, LayersWithoutExtinctionCostNothing) {
    const Medium earth = test::preset_medium(
        "earth_hillaire",
        {"atmosphere.layers.ozone.absorption=\"0 /m\"", "atmosphere.layers.mie.enabled=false"});
    EXPECT_EQ(earth.exponential_layers.size(), 1U);
    EXPECT_TRUE(earth.piecewise_layers.empty());
}

TEST(Medium, PiecesAreCutAtGroundAndTop) {
    const Medium medium = test::preset_medium(
        "vacuum",
        {"atmosphere.layers.a={profile=\"tent\", center_altitude=\"95 km\", half_width=\"20 km\", "
         "absorption=\"1e-6 /m\"}",
         "atmosphere.layers.b={profile=\"slab\", bottom_altitude=\"200 km\", "
         "top_altitude=\"300 km\", absorption=\"1e-6 /m\"}"});
    ASSERT_EQ(medium.piecewise_layers.size(), 1U);
    const auto& pieces = medium.piecewise_layers[0].pieces;
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].bottom_km, 75);
    EXPECT_EQ(pieces[1].top_km, medium.thickness_km);
    EXPECT_NEAR(pieces[1].density_at_top, 0.75, 1e-15);
    EXPECT_EQ(kink_altitudes_km(medium), (std::vector<double>{75, 95, medium.thickness_km}));
}

}  // namespace
}  // namespace skybake
