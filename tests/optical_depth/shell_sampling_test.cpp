#include "bakers/assets/optical_depth/column_kinds.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/optical_depth/columns.h"

namespace skybake::test {
namespace {

RC_GTEST_PROP(ShellSampling, ShellsDimLightFromAboveEqually, ()) {
    const double scale_height = log_uniform(0.05, 20);
    const double top = scale_height * log_uniform(0.1, 20);
    const int count = *rc::gen::inRange(1, 200);
    const auto shells = equal_attenuation_shells_km(scale_height, top, count);
    RC_ASSERT(shells.size() == static_cast<std::size_t>(count) + 1);
    RC_ASSERT(shells.front() == 0);
    RC_ASSERT(shells.back() == top);
    const double whole = 1 - std::exp(-top / scale_height);
    for (std::size_t i = 0; i + 1 < shells.size(); ++i) {
        const double depth =
            std::exp(-shells[i] / scale_height) - std::exp(-shells[i + 1] / scale_height);
        RC_ASSERT(std::fabs(depth - whole / count) <= 1e-12);
    }
}

TEST(ShellSampling, TheMeanScaleHeightIsWeightedWithExtinction) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"dust", "fog"});
    EXPECT_NEAR(mean_scale_height_km(kinds), (0.145 * 2 + 3.912 * 0.1) / (0.145 + 3.912), 1e-12);
}

// Sums along a vertical path that goes on beyond the last shell, where nothing is sampled.
TEST(ShellSampling, CountsTheDensityAtTheMiddleOfEachShell) {
    config::Atmosphere atmosphere = earth_with_presets();
    const auto kinds = make_column_kinds(atmosphere, {"dust"});
    const std::vector<double> shells = uniform_shells_km(3.5, 7);
    double sum = 0;
    for (int i = 0; i < 7; ++i) sum += 0.5 * std::exp(-(0.5 * i + 0.25) / 2);
    EXPECT_NEAR(sampled_mean_density(kinds[0], shells, {0, 6360, 6}) * 6, sum, 1e-9);
}

RC_GTEST_PROP(ShellSampling, ManyShellsApproachTheIntegral, ()) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"dust", "rayleigh"});
    const ColumnGeometry geometry = column_geometry(kinds);
    const auto kind = static_cast<RayKind>(*rc::gen::inRange(0, 2));
    const ColumnPath path = path_to_top(geometry, {kind, uniform(0, 1), uniform(0, 1)});
    const std::vector<double> shells = uniform_shells_km(100, 4096);
    for (const ColumnKind& kind : kinds) {
        const double exact = mean_density(kind, path);
        RC_ASSERT(std::fabs(sampled_mean_density(kind, shells, path) - exact) <= 2e-3 * exact);
    }
}

}  // namespace
}  // namespace skybake::test
