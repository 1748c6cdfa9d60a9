#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"

namespace skybake {

namespace {

using test::uniform;

SkyRay ray_of(const Shell& shell, const ScatteringView& view, double sun, double nu) {
    SkyRay ray;
    ray.altitude_km = view.altitude_km;
    ray.s_km = view.s_km;
    ray.length_km = view.length_km;
    ray.meets_ground = view.meets_ground;
    ray.sun_s_km = (shell.ground_radius_km + view.altitude_km) * sun;
    ray.cosine_to_sun = nu;
    ray.one_minus_cosine = 1 - nu;
    ray.one_plus_cosine = 1 + nu;
    return ray;
}

double cosine_of(const Shell& shell, const ScatteringView& view) {
    return std::clamp(view.s_km / (shell.ground_radius_km + view.altitude_km), -1.0, 1.0);
}

// The largest difference of a row from direct integration, as a share of `floor` at least.
double worst_error(const SkyMedium& medium, const ScatteringRows& rows,
                   const SkyIntegrator& integrator, const ScatteringView& view,
                   const std::vector<double>& suns, double share, double floor) {
    const Shell shell = shell_of(medium.air);
    std::vector<double> nu;
    for (const double sun : suns) {
        const FeasibleCosines feasible = feasible_cosines(cosine_of(shell, view), sun);
        nu.push_back(std::clamp(feasible.low + share * (feasible.high - feasible.low), -1.0, 1.0));
    }
    const ScatteringRow row = rows.row(view, SunBundle(suns, nu));
    double worst = 0;
    for (std::size_t i = 0; i < suns.size(); ++i) {
        const SkyRadiance direct = integrator.radiance(ray_of(shell, view, suns[i], nu[i]));
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            double single = 0;
            for (std::size_t k = 0; k < medium.layers.size(); ++k) {
                single += row.single[k][i][c] *
                          phase_values(medium.layers[k].phase, 1 - nu[i], 1 + nu[i])[c];
            }
            worst = std::max(
                worst, std::fabs(single - direct.single[c]) / std::max(direct.single[c], floor));
            if (row.higher.empty()) continue;
            worst = std::max(worst, std::fabs(row.higher[i][c] - direct.multiple[c]) /
                                        std::max(direct.multiple[c], floor));
        }
    }
    return worst;
}

TEST(ScatteringRow, EqualsDirectIntegrationOnEarth) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    SolverSettings settings;
    settings.orders = 2;
    settings.suns = 24;
    settings.zenith_nodes = 4;
    const SolvedLight light = solve_light(medium, settings, 2);
    const SolvedOrders orders(medium, light, settings.degree);
    const SkyIntegrator integrator(medium, &orders);
    const ScatteringRows rows(medium, &light, make_sunlight(medium.air, 2));
    const ScatteringMapping mapping(shell_of(medium.air), {256, 128, 32}, 8, -0.2);
    const std::vector<double> suns = {-0.15, -0.07, -0.02, 0, 0.05, 0.3, 1};
    double worst = 0;
    for (const int v : {0, 30, 63, 64, 75, 100, 127}) {
        for (const int w : {0, 1, 9, 31}) {
            worst = std::max(worst, worst_error(medium, rows, integrator,
                                                mapping.view_of_texel(v, w), suns, 0.7, 1e-4));
        }
    }
    EXPECT_LE(worst, 1e-2);
}

RC_GTEST_PROP(ScatteringRow, EqualsDirectIntegrationOfSingleScattering, ()) {
    const SkyMedium medium = make_sky_medium(test::random_atmosphere());
    const ScatteringRows rows(medium, nullptr, make_sunlight(medium.air, 2));
    const SkyIntegrator integrator(medium, nullptr);
    const ScatteringMapping mapping(shell_of(medium.air), {8, 4, 4}, 2, -0.3);
    const ScatteringView view =
        mapping.view(uniform(0, 1), *rc::gen::inRange(0, 2) == 1, uniform(0, 1));
    RC_ASSERT(worst_error(medium, rows, integrator, view, {uniform(-0.5, 1), uniform(-0.2, 0.2)},
                          uniform(0, 1), 1e-3) < 0.02);
}

TEST(ScatteringRow, GoesOnSmoothlyWhereThereAreNoSuchSuns) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const ScatteringRows rows(medium, nullptr, make_sunlight(medium.air, 2));
    const ScatteringMapping mapping(shell_of(medium.air), {256, 128, 32}, 8, -0.2);
    const ScatteringView view = mapping.view_of_texel(90, 2);
    const double edge = feasible_cosines(cosine_of(mapping.shell(), view), 0.1).high;
    const double step = 0.01;
    const ScatteringRow row =
        rows.row(view, SunBundle({0.1, 0.1, 0.1}, {edge - step, edge, edge + step}));
    const double before = row.single[0][1][0] - row.single[0][0][0];
    const double after = row.single[0][2][0] - row.single[0][1][0];
    EXPECT_NE(before, 0);
    EXPECT_NEAR(after / before, 1, 0.1);
}

// The largest relative error of linear lookups of an exponential, at texels and between.
double worst_lookup(double rate, const std::vector<double>& scales) {
    double worst = 0;
    const int last = static_cast<int>(scales.size()) - 1;
    for (double x = 2; x <= last - 2; x += 0.125) {
        const int i = std::min(static_cast<int>(x), last - 1);
        const auto value = [&](int at) {
            return scales[static_cast<std::size_t>(at)] * std::exp(rate * at);
        };
        const double found = (i + 1 - x) * value(i) + (x - i) * value(i + 1);
        worst = std::max(worst, std::fabs(found / std::exp(rate * x) - 1));
    }
    return worst;
}

TEST(LookupFit, HalvesTheErrorOfSteepLight) {
    for (const double rate : {-1.2, -0.6, 0.3, 1.0}) {
        std::vector<double> line;
        for (int i = 0; i < 12; ++i) line.push_back(std::exp(rate * i));
        const double plain = worst_lookup(rate, std::vector<double>(12, 1.0));
        EXPECT_LT(worst_lookup(rate, lookup_scales(line)), 0.62 * plain) << rate;
    }
}

TEST(LookupFit, LeavesStraightLinesAndDarkTexelsAlone) {
    for (const double scale : lookup_scales({5, 5, 5, 5})) EXPECT_NEAR(scale, 1, 1e-12);
    for (const double scale : lookup_scales({0, 0, 0})) EXPECT_EQ(scale, 1);
    for (const double scale : lookup_scales({0, 3, 0})) EXPECT_EQ(scale, 1);
    EXPECT_EQ(lookup_scales({1e-15, 0.03, 0.2, 0.3}), lookup_scales({0, 0.03, 0.2, 0.3}));
    EXPECT_EQ(lookup_scales({7}).front(), 1);
    EXPECT_NEAR(lookup_scales({2, 2})[1], 1, 1e-12);
}

RC_GTEST_PROP(LookupFit, StaysWithinAQuarterWhateverTheTexels, ()) {
    std::vector<double> line;
    const int count = *rc::gen::inRange(1, 40);
    for (int i = 0; i < count; ++i) {
        line.push_back(*rc::gen::inRange(0, 4) == 0 ? 0 : test::log_uniform(1e-40, 1e3));
    }
    for (const double scale : lookup_scales(line)) {
        RC_ASSERT(scale >= 0.75);
        RC_ASSERT(scale <= 1.25);
    }
}

}  // namespace

}  // namespace skybake
