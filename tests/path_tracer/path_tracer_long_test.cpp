// The same laws with as many paths as minutes allow.
#include <gtest/gtest.h>

#include "tests/path_tracer/path_media.h"
#include "tests/support/sky_truth.h"

namespace skybake {
namespace {

TEST(PathTracerLong, WhiteFurnaceOfTenMillionPaths) {
    std::uint32_t ray = 0;
    for (const double factor : {1.0, 10.0}) {
        const SkyMedium medium = test::white_furnace(factor);
        const PathMedium path_medium(medium);
        const std::int64_t count = factor > 1 ? 1'000'000 : 10'000'000;
        const PathTracedRadiance radiance =
            trace_ambient_paths(path_medium, 0.5, 0.3, test::paths(count, ++ray), 0);
        EXPECT_LE(test::furnace_deviation(radiance, 3), 3) << factor;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(radiance.radiance[c], 1, 1e-3);
    }
}

// Halved standard errors for four times the paths, on all directions: no single path weighs much.
TEST(PathTracerLong, ErrorsFallAsTheyShould) {
    const SkyMedium medium = test::preset_sky(
        "earth_hillaire", {"atmosphere.ground_albedo=0", "atmosphere.layers.mie.g=0.95"});
    const auto directions = sky_truth_directions(0.5);
    const auto few = trace_sky_truth(medium, directions, {1, 20000}, 0);
    const auto many = trace_sky_truth(medium, directions, {2, 80000}, 0);
    test::Agreement agreement;
    double log_ratio = 0;
    for (std::size_t i = 0; i < few.size(); ++i) {
        agreement.add(few[i].radiance, few[i].standard_error, many[i].radiance,
                      many[i].standard_error);
        log_ratio += std::log2(few[i].standard_error / many[i].standard_error);
    }
    EXPECT_LT(agreement.mean(), 1.3);
    EXPECT_NEAR(log_ratio / static_cast<double>(few.size()), 1, 0.1);
}

}  // namespace
}  // namespace skybake
