// Media, rays through them, and the mappings of their tables.
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/air/medium.h"
#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/air/view_ray.h"
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "config/assets/transmittance.h"
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

using config::MultipleScatteringMapping;

TEST(MultipleScatteringMapping, RoundTripsAndEndPoints) {
    for (const auto mapping :
         {MultipleScatteringMapping::hillaire, MultipleScatteringMapping::twilight}) {
        for (const int size : {2, 3, 32, 33}) {
            for (int i = 0; i < size; ++i) {
                const double x = static_cast<double>(i) / (size - 1);
                EXPECT_NEAR(sun_coordinate(mapping, sun_cos_zenith_at(mapping, x)), x, 1e-12);
            }
        }
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0), -1);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0.5), 0);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 1), 1);
    }
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::hillaire, 0.75), 0.5);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.75), 0.25);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.25), -0.25);
}

TEST(TransmittanceMapping, RoundTripsAtEachTexelCentre) {
    for (const std::string& preset : test::preset_list()) {
        const Shell shell = shell_of(test::preset_medium(preset));
        for (const int size : {1, 2, 3, 17, 64}) {
            for (int j = 0; j < size; ++j) {
                for (int i = 0; i < size; ++i) {
                    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
                    const UnitCoordinates x = {texel_coordinate(kConvention, i, size),
                                               texel_coordinate(kConvention, j, size)};
                    const TransmittanceRay ray = transmittance_ray(shell, x);
                    const UnitCoordinates back = transmittance_coordinates(
                        shell, ray.altitude_km, cos_zenith_of(shell, ray));
                    EXPECT_NEAR(back.x_r, x.x_r, 1e-12) << preset << ' ' << i << ' ' << j;
                    EXPECT_NEAR(back.x_mu, x.x_mu, 1e-12) << preset << ' ' << i << ' ' << j;
                }
            }
        }
    }
}

TEST(TransmittanceMapping, EndPoints) {
    const Shell earth = {6360, 100};
    EXPECT_EQ(cos_zenith_of(earth, transmittance_ray(earth, {0, 0})), 1);
    EXPECT_EQ(transmittance_ray(earth, {1, 0}).s_km, 0);
    EXPECT_EQ(cos_zenith_of(earth, transmittance_ray(earth, {0, 1})), 1);
    const TransmittanceRay horizon = transmittance_ray(earth, {1, 1});
    EXPECT_EQ(horizon.altitude_km, 100);
    EXPECT_NEAR(horizon.s_km, -horizon_distance_km(earth, 100), 1e-9);
}

TEST(TransmittanceMapping, IsBrunetonsFormula) {
    // Written as in the paper, in plain double, at moderate places where it does not cancel.
    const Shell earth = {6360, 100};
    for (const double h : {1.0, 20.0, 77.0}) {
        for (const double mu : {0.9, 0.3, 0.02}) {
            const double r = 6360 + h;
            const double big_h = std::sqrt(6460.0 * 6460 - 6360.0 * 6360);
            const double rho = std::sqrt(r * r - 6360.0 * 6360);
            const double d = -r * mu + std::sqrt(r * r * (mu * mu - 1) + 6460.0 * 6460);
            const UnitCoordinates x = transmittance_coordinates(earth, h, mu);
            EXPECT_NEAR(x.x_mu, (d - (6460 - r)) / (rho + big_h - (6460 - r)), 1e-11);
            EXPECT_NEAR(x.x_r, rho / big_h, 1e-11);
        }
    }
}

// Everything that enters a ray is scattered, absorbed or comes out.
TEST(ViewRay, KeepsEnergyAndAgreesWithTheOpticalDepth) {
    for (const std::string& preset : test::preset_list()) {
        const Medium medium = test::preset_medium(preset);
        const Shell shell = shell_of(medium);
        const std::vector<double> altitudes = break_altitudes_km(medium, {0.5, 1, 2, 3.5, 6, 10});
        const double altitude = 0.3 * medium.thickness_km;
        const double r = shell.ground_radius_km + altitude;
        const double horizon = -horizon_distance_km(shell, altitude) / r;
        for (const double mu : {1.0, 0.1, 0.0, 0.5 * horizon, 1.1 * horizon, -1.0}) {
            const bool below = mu < horizon;
            ViewRay ray = trace_view_ray(medium, altitudes, altitude, r * mu, below);
            Spectrum whole{};
            for (const RayCell& cell : ray.cells) {
                whole += cell.near_weight + cell.far_weight;
            }
            refine_view_ray(medium, whole, 1e-4, ray);
            const Spectrum exact = optical_depth_along(medium, altitude, mu, ray.length_km);
            for (std::size_t c = 0; c < 3; ++c) {
                double depth = 0;
                double kept = 0;
                for (const RayCell& cell : ray.cells) {
                    depth += cell.optical_depth[c];
                    kept += cell.near_weight[c] + cell.far_weight[c] + cell.absorbed[c];
                }
                EXPECT_NEAR(depth, exact[c], 1e-5 * exact[c] + 1e-12) << preset << " mu " << mu;
                EXPECT_NEAR(kept + exponential(-depth), 1, 1e-5) << preset << " mu " << mu;
            }
        }
    }
}

TEST(ViewRay, NodesAreExactForLinearLight) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const std::vector<double> altitudes = break_altitudes_km(earth, {0.5, 1, 2, 3.5, 6, 10});
    ViewRay ray = trace_view_ray(earth, altitudes, 2, 6362 * 0.2, false);
    refine_view_ray(earth, {1, 1, 1, 0}, 1e-5, ray);
    Spectrum sum{};
    for (const RayNode& node : nodes_of(earth, ray)) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_GE(node.weight[c], 0);
            sum[c] += node.weight[c] * (1 + 0.01 * node.distance_km);
        }
    }
    const Shell shell = shell_of(earth);
    const auto integrand = [&](double x) {
        const double altitude = altitude_along_km(shell, 2, 6362 * 0.2, x);
        Spectrum value = scattering_at(earth, altitude);
        const Spectrum depth = optical_depth_along(earth, 2, 0.2, x);
        value *= exponential(-depth) * (1 + 0.01 * x);
        return value;
    };
    Spectrum exact{};
    double from = 0;
    for (double to : {5.0, 20.0, 60.0, 150.0, ray.length_km}) {
        const Spectrum part = adaptive_integral<Spectrum>(integrand, from, to, 1e-9, 0, 20);
        exact += part;
        from = to;
    }
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], exact[c], 1e-6 * exact[c]);
}

TEST(ViewRay, ARayWithoutLengthHasOneNodeAndNoWeight) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const ViewRay ray = trace_view_ray(earth, break_altitudes_km(earth, {1}), 0, -6360, true);
    EXPECT_TRUE(ray.cells.empty());
    EXPECT_EQ(nodes_of(earth, ray).size(), 1U);
}

}  // namespace

}  // namespace skybake
