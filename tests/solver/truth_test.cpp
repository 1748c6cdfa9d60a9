// Solved light against light that was traced path by path (tests/data/truth_*.csv).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/number_rows.h"

namespace skybake {
namespace {

SkyMedium black_earth() {
    return test::preset_sky("earth_hillaire", {"atmosphere.ground_albedo=0"});
}

TEST(SolvedLightTruth, MeanRadiance) {
    const SolvedLight light = solve_light(black_earth(), {}, 0);
    double chi_square = 0;
    int count = 0;
    for (const auto& row : test::number_rows(SKYBAKE_TEST_DATA "/truth_mslut_setH0.csv")) {
        const auto channel = static_cast<std::size_t>(row[2]);
        const double value =
            light.mean_radiance_at(row[0], std::cos(row[1] * test::kDegree))[channel];
        // The grid's own error beside the standard error; where a few paths found all the light,
        // that says nothing.
        if (row[5] > 0.1 * row[4]) continue;
        const double sigma = std::hypot(row[5], 2e-3 * row[4]);
        chi_square += std::pow((value - row[4]) / sigma, 2);
        EXPECT_LT(std::fabs(value - row[4]), 5 * sigma) << row[0] << ' ' << row[1];
        ++count;
    }
    EXPECT_GT(count, 100);
    EXPECT_LT(chi_square / count, 1.6);
}

// With these paths' own standard error a perfect sky would have 0.1 and 1.3 %, and 0.1 and 0.2 % up to
// the sun at the horizon.
TEST(SolvedLightTruth, Sky) {
    const SkyMedium medium = black_earth();
    const auto truth = test::sky_truth_of(SKYBAKE_TEST_DATA "/truth_sky_setH0_h0.5.csv");
    SolverSettings settings;
    settings.degree = 8;
    const SolvedLight light = solve_light(medium, settings, 0);
    const auto errors = [&](const HigherOrders& orders, double last_sun) {
        return test::SkyErrors(SkyIntegrator(medium, &orders), truth, 0, last_sun);
    };
    const auto moments = [&](int degree) {
        return errors(SolvedOrders(medium, light, degree), 90);
    };
    EXPECT_LT(moments(8).median(), 1.5e-3);
    EXPECT_LT(moments(8).ninth_decile(), 4e-3);
    EXPECT_LT(moments(4).median(), 2.5e-3);
    EXPECT_LT(moments(4).ninth_decile(), 7e-3);
    EXPECT_LT(moments(2).median(), 4e-3);
    EXPECT_LT(moments(2).ninth_decile(), 1.5e-2);
    const test::SkyErrors all = errors(SolvedOrders(medium, light, 8), 96);
    EXPECT_LT(all.median(), 2.5e-3);
    EXPECT_LT(all.ninth_decile(), 1.8e-2);
    const IsotropicOrders mean(medium.air, [&](double altitude_km, double sun_cos_zenith) {
        return light.mean_radiance_at(altitude_km, sun_cos_zenith);
    });
    const test::SkyErrors drop_in = errors(mean, 96);
    EXPECT_LT(drop_in.median(), 0.021);
    EXPECT_LT(drop_in.ninth_decile(), 0.057);
}

// Twilight from 5, 20 and 80 km. With these paths' own standard error a perfect sky would have 90th
// percentiles of 0.9, 0.5 and 0.1 % up to 96 degrees and of 2.6, 1.8 and 0.2 % beyond. Cells as long
// as by day, with as few directions, leave 2.1, 1.2 and 0.1 %, and 6.5, 4.3 and 0.2 %.
TEST(SolvedLightTruth, TwilightFromHigh) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const auto truth = test::sky_truth_of(SKYBAKE_TEST_DATA "/truth_sky_earth_twilight.csv");
    const SolvedLight light = solve_light(medium, {}, 0);
    const SolvedOrders orders(medium, light, light.degree());
    const auto from = [&](double altitude_km, double first_sun, double last_sun) {
        std::vector<SkyTruth> rows;
        std::ranges::copy_if(truth, std::back_inserter(rows), [&](const SkyTruth& row) {
            return row.direction.altitude_km == altitude_km;
        });
        return test::SkyErrors(SkyIntegrator(medium, &orders), rows, first_sun, last_sun);
    };
    EXPECT_LT(from(5, 92, 96).median(), 3e-3);
    EXPECT_LT(from(5, 92, 96).ninth_decile(), 1.7e-2);
    EXPECT_LT(from(5, 97, 99).median(), 9e-3);
    EXPECT_LT(from(5, 97, 99).ninth_decile(), 4.2e-2);
    EXPECT_LT(from(20, 92, 96).ninth_decile(), 8.5e-3);
    EXPECT_LT(from(20, 97, 99).ninth_decile(), 2.8e-2);
    EXPECT_LT(from(80, 92, 96).ninth_decile(), 2e-3);
    EXPECT_LT(from(80, 97, 99).ninth_decile(), 2e-3);
}

// In a shell of 125 scale heights rays in the thin air above the tenth are cut as below it.
TEST(SolvedLightTruth, RaysOfTallShells) {
    const SkyMedium medium =
        test::preset_sky("earth_hillaire", {"atmosphere.top_radius=\"7360 km\""});
    const SkyIntegrator integrator(medium, nullptr);
    const Shell shell = shell_of(medium.air);
    for (const double altitude_km : {60.0, 85.0, 110.0, 150.0}) {
        for (const double sun_degrees : {30.0, 88.0, 94.0, 97.0}) {
            for (const double view_degrees : {60.0, 90.0, 93.0, 97.0}) {
                const test::View view = test::view_at(altitude_km, sun_degrees, view_degrees, 60);
                const SkyRay ray = sky_ray(shell, altitude_km, view.sun, view.direction);
                std::vector<double> fine;
                for (int i = 1; i <= 300; ++i) fine.push_back(ray.length_km * i / 300);
                const double expected = integrator.up_to(ray, fine).back().single[1];
                if (expected < 1e-9) continue;  // black
                EXPECT_NEAR(integrator.radiance(ray).single[1] / expected, 1, 2e-4)
                    << altitude_km << ' ' << sun_degrees << ' ' << view_degrees;
            }
        }
    }
}

}  // namespace
}  // namespace skybake
