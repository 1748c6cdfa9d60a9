#include "bakers/assets/bruneton/iterated_scattering.h"

#include <gtest/gtest.h>

#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

TEST(IteratedScattering, AgreesWithTheSolutionOfTwoOrders) {
    const SkyMedium medium = make_sky_medium(test::preset_atmosphere("earth_hillaire"));
    const ScatteringMapping mapping(shell_of(medium.air), {64, 16, 8}, 8, -0.2);
    const BakeOptions options{.threads = 2};
    const std::vector<Spectrum> iterated = iterated_scattering(medium, mapping, 2, options);
    SolverSettings settings;
    settings.orders = 1;
    settings.suns = 24;
    const SolvedLight light = solve_light(medium, settings, 2);
    const ScatteringRows rows(medium, &light, nullptr);
    // By day, on the ground, upwards and not along the horizon: there the grid is fine enough.
    std::vector<double> ratios;
    for (const int v : {8, 9, 10, 11, 12}) {
        const ScatteringView view = mapping.view_of_texel(v, 0);
        const double mu = std::clamp(view.s_km / 6360, -1.0, 1.0);
        for (int u = 0; u < 64; ++u) {
            const double sun = mapping.sun_of_texel(u);
            const FeasibleCosines feasible = feasible_cosines(mu, sun);
            const double nu = mapping.nu_of_texel(u);
            if (sun < 0.2 || nu < feasible.low || nu > feasible.high) continue;
            const Spectrum solved = rows.row(view, SunBundle({sun}, {nu})).higher[0];
            const Spectrum& found = iterated[static_cast<std::size_t>(v * 64 + u)];
            for (std::size_t c = 0; c < 3; ++c) ratios.push_back(found[c] / solved[c]);
        }
    }
    ASSERT_GT(ratios.size(), 8U);
    std::sort(ratios.begin(), ratios.end());
    EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.1);
    EXPECT_GT(ratios.front(), 0.8);
    EXPECT_LT(ratios.back(), 1.25);
}

}  // namespace
}  // namespace skybake
