// The grid of a solution: its altitudes, those at which it is read, and its suns.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/light/solver/reading_levels.h"
#include "bakers/light/solver/solution_levels.h"
#include "bakers/light/solver/sun_axis.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

RC_GTEST_PROP(SolutionLevels, HoldTheEndsAndEveryKink, ()) {
    const Medium medium = make_medium(test::random_atmosphere());
    const std::vector<double> levels = solution_levels_km(medium, test::uniform(0.3, 2));
    RC_ASSERT(levels.front() == 0);
    RC_ASSERT(levels.back() == medium.thickness_km);
    RC_ASSERT(levels.size() >= 3U);
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) RC_ASSERT(levels[i] < levels[i + 1]);
    for (const double kink : kink_altitudes_km(medium)) {
        RC_ASSERT(std::find(levels.begin(), levels.end(), kink) != levels.end());
    }
}

RC_GTEST_PROP(SunlightBlocks, EndAtLevelsAndAtEveryKink, ()) {
    const Medium medium = make_medium(test::random_atmosphere());
    const std::vector<double> levels = solution_levels_km(medium, test::uniform(0.3, 2));
    const std::vector<double> blocks = sunlight_blocks_km(medium, levels);
    RC_ASSERT(blocks.front() == 0);
    RC_ASSERT(blocks.back() == medium.thickness_km);
    for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
        RC_ASSERT(blocks[i] < blocks[i + 1]);
        const auto begin = std::find(levels.begin(), levels.end(), blocks[i]);
        const auto end = std::find(levels.begin(), levels.end(), blocks[i + 1]);
        RC_ASSERT(end != levels.end() && end - begin <= 3);
    }
    for (const double kink : kink_altitudes_km(medium)) {
        RC_ASSERT(std::find(blocks.begin(), blocks.end(), kink) != blocks.end());
    }
}

TEST(SolutionLevels, OfVacuum) {
    Medium medium;
    medium.channels = 3;
    medium.ground_radius_km = 6360;
    medium.thickness_km = 100;
    const std::vector<double> levels = solution_levels_km(medium, 1);
    EXPECT_EQ(levels.front(), 0);
    EXPECT_EQ(levels.back(), 100);
}

// Sixteen layers that are alike need no more levels than the lowest of them; a second one that is
// not adds its own.
TEST(SolutionLevels, AreSharedByLayersThatAreAlike) {
    Medium medium;
    medium.channels = 3;
    medium.ground_radius_km = 6360;
    medium.thickness_km = 100;
    const auto add = [&](double scale_height_km) {
        ExponentialLayer layer{};
        layer.scale_height_km = scale_height_km;
        layer.extinction_per_km = Spectrum(1e-4);
        medium.exponential_layers.push_back(layer);
    };
    add(8);
    const std::vector<double> of_one = solution_levels_km(medium, 1);
    for (int i = 1; i < 16; ++i) add(8 + 0.1 * i);
    EXPECT_NEAR(static_cast<double>(solution_levels_km(medium, 1).size()),
                static_cast<double>(of_one.size()), 1);
    add(1.2);
    EXPECT_GT(solution_levels_km(medium, 1).size(), of_one.size() + 5);
}

Medium air_with_a_cloud() {
    Medium medium = test::preset_medium("earth_hillaire");
    PiecewiseLayer cloud;
    cloud.scattering_per_km = cloud.extinction_per_km = Spectrum(3.0);
    cloud.pieces = {{2, 3, 1, 1, 0}};
    medium.piecewise_layers.push_back(cloud);
    return medium;
}

// Within an abrupt layer light is read by cubics between the levels, and nowhere else.
TEST(ReadingLevels, AreCubicsWithinAbruptLayers) {
    const Medium air = test::preset_medium("earth_hillaire");
    const std::vector<double> smooth = solution_levels_km(air, 1);
    EXPECT_EQ(ReadingLevels(air, smooth).altitudes_km(), smooth);

    const Medium medium = air_with_a_cloud();
    const std::vector<double> levels = solution_levels_km(medium, 1);
    const ReadingLevels reading(medium, levels);
    const auto cubic = [](double x) { return 2 + x * (3 - x * (1.5 - 0.25 * x)); };
    LightField light(static_cast<int>(levels.size()), 8, 0);
    for (int level = 0; level < light.levels; ++level) {
        const double value = cubic(levels[static_cast<std::size_t>(level)]);
        std::fill_n(light.at(level, 0), light.level_size(), value);
    }
    const LightField read = reading.read(light);
    ASSERT_EQ(static_cast<std::size_t>(read.levels), reading.altitudes_km().size());
    for (int i = 0; i < read.levels; ++i) {
        const double altitude = reading.altitudes_km()[static_cast<std::size_t>(i)];
        EXPECT_NEAR(*read.at(i, 0), cubic(altitude), 1e-9 * cubic(altitude)) << altitude;
    }
    for (int level = 0; level < light.levels; ++level) {
        const auto at = static_cast<std::size_t>(reading.index_of(level));
        EXPECT_EQ(reading.altitudes_km()[at], levels[static_cast<std::size_t>(level)]);
    }
    const std::size_t between = reading.altitudes_km().size() - levels.size();
    const auto inside =
        std::count_if(levels.begin(), levels.end(), [](double km) { return km >= 2 && km < 3; });
    EXPECT_EQ(between, 3 * static_cast<std::size_t>(inside));
}

// Cubics fall below nothing where bright levels follow upon dark ones.
TEST(ReadingLevels, HoldNoLightBelowNothing) {
    const Medium medium = air_with_a_cloud();
    const std::vector<double> levels = solution_levels_km(medium, 1);
    const ReadingLevels reading(medium, levels);
    LightField light(static_cast<int>(levels.size()), 8, 2);
    for (int level = 0; level < light.levels; ++level) {
        const bool is_bright = levels[static_cast<std::size_t>(level)] > 2.5;
        std::fill_n(light.at(level, 0), light.level_size(), is_bright ? 1.0 : 1e-9);
    }
    const LightField cubic = reading.read(light);
    EXPECT_LT(*std::min_element(cubic.moments.begin(), cubic.moments.end()), -1e-3);
    const LightField found = reading.read_light(light);
    for (std::size_t i = 0; i < found.moments.size(); ++i) {
        ASSERT_GE(found.moments[i], 0) << i;
        if (cubic.moments[i] < 0) continue;
        ASSERT_EQ(found.moments[i], cubic.moments[i]) << i;
    }
}

// A table of many altitudes needs no more levels than the exponential that it is taken from, and
// where its slope jumps or it ends it has a level.
TEST(SolutionLevels, OfSmoothTablesAreAsManyAsOfExponentials) {
    Medium tabulated = test::preset_medium("earth_hillaire");
    const std::vector<double> of_exponential = solution_levels_km(tabulated, 1);
    const auto highest = std::max_element(
        tabulated.exponential_layers.begin(), tabulated.exponential_layers.end(),
        [](const auto& a, const auto& b) { return a.scale_height_km < b.scale_height_km; });
    const ExponentialLayer air = *highest;
    tabulated.exponential_layers.erase(highest);
    PiecewiseLayer table;
    table.scattering_per_km = air.scattering_per_km;
    table.extinction_per_km = air.extinction_per_km;
    const auto add = [&](double bottom_km, double top_km, double below, double above) {
        table.pieces.push_back(
            {bottom_km, top_km, below, above, (above - below) / (top_km - bottom_km)});
    };
    const auto density = [&](double km) { return std::exp(-km / air.scale_height_km); };
    for (int i = 0; i < 30; ++i)
        add(3.0 * i, 3.0 * (i + 1), density(3.0 * i), density(3.0 * i + 3));
    tabulated.piecewise_layers.push_back(table);
    EXPECT_LE(solution_levels_km(tabulated, 1).size(), of_exponential.size() + 3);

    // A cap that ends at 20 km, between two altitudes of the table.
    tabulated.piecewise_layers.back().pieces.resize(6);
    PiecewiseLayer& cut = tabulated.piecewise_layers.back();
    cut.pieces.push_back({18, 20, density(18), 0, -density(18) / 2});
    const std::vector<double> of_cap = solution_levels_km(tabulated, 1);
    EXPECT_NE(std::find(of_cap.begin(), of_cap.end(), 18.0), of_cap.end());
    EXPECT_NE(std::find(of_cap.begin(), of_cap.end(), 20.0), of_cap.end());
}

RC_GTEST_PROP(SunAxis, ColumnsStandAtWholePositions, ()) {
    const double radius = test::log_uniform(10, 1e6);
    const Shell shell{radius, radius * test::log_uniform(1e-4, 0.5)};
    const SunAxis axis = make_sun_axis(shell, 8 * *rc::gen::inRange(1, 12));
    RC_ASSERT(axis.darkest >= -1 && axis.darkest < 0);
    for (int i = 0; i < axis.count(); ++i) {
        const double cosine = axis.cosines[static_cast<std::size_t>(i)];
        RC_ASSERT(cosine > axis.darkest && cosine < 1);
        RC_ASSERT(std::fabs(axis.position(cosine) - i) < 1e-9);
    }
    RC_ASSERT(std::fabs(axis.position(1) - (axis.count() - 0.5)) < 1e-9);
    RC_ASSERT(std::fabs(axis.position(axis.darkest) + 0.5) < 1e-9);
}

TEST(SunAxis, ColumnsBelowTheHorizonAreWholeVectors) {
    for (const int count : {8, 24, 48}) {
        const SunAxis axis = make_sun_axis({6360, 100}, count);
        const int below = columns_below_horizon(axis);
        EXPECT_EQ(below % 8, 0);
        EXPECT_LE(below, count);
        if (below > 0) {
            EXPECT_LT(axis.cosines[static_cast<std::size_t>(below - 1)], 0);
        }
        if (below + 7 < count) {
            EXPECT_GE(axis.cosines[static_cast<std::size_t>(below + 7)], 0);
        }
    }
    EXPECT_EQ(columns_below_horizon(make_sun_axis({6360, 100}, 48)), 24);
}

RC_GTEST_PROP(SunAxis, StencilsAreExactForCubics, ()) {
    const SunAxis axis = make_sun_axis({6360, 100}, 48);
    const double cosine = test::uniform(axis.darkest, 1);
    const SunStencil stencil = sun_stencil(axis, cosine);
    RC_ASSERT(stencil.column >= 0 && stencil.column + 3 < axis.count());
    const double u = axis.position(cosine);
    for (int power = 0; power <= 3; ++power) {
        double sum = 0;
        for (int j = 0; j < 4; ++j) {
            sum += stencil.weights[j] * std::pow((stencil.column + j) / 48.0, power);
        }
        RC_ASSERT(std::fabs(sum - std::pow(u / 48, power)) < 1e-12);
    }
}

// Light that falls as a cubic in its logarithm, by at most twice as much from one column to the next
// as to another, is that of the cubic: at each column, and between them.
RC_GTEST_PROP(SunAxis, SteepStencilsAreExactForExponentialsOfCubics, ()) {
    const double slope = test::uniform(0.5, 6);
    const double bend = test::uniform(-0.05, 0.05) * slope;
    const double twist = test::uniform(-0.01, 0.01) * slope;
    const auto light = [&](double x) {
        return std::exp(slope * x + bend * x * x + twist * x * x * x);
    };
    double means[4];
    for (int k = 0; k < 4; ++k) means[k] = light(k);
    const double place = test::uniform(0, 3);
    double weights[4];
    double falls[3];
    for (int k = 0; k < 3; ++k) falls[k] = fall_between(means[k], means[k + 1]);
    steep_weights(place, falls, weights);
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        RC_ASSERT(weights[k] >= 0);
        sum += weights[k] * means[k];
    }
    RC_ASSERT(std::fabs(sum / light(place) - 1) < 1e-10);
}

// A stencil whose means do not fall is linear between the two columns around, up to the first and the
// last; beyond them it takes the nearest one.
RC_GTEST_PROP(SunAxis, LinearStencilsAreExactForLinesUpToTheEnds, ()) {
    const SunAxis axis = make_sun_axis({6360, 100}, 24);
    const double cosine =
        *rc::gen::inRange(0, 4) == 0
            ? axis.cosines[static_cast<std::size_t>(*rc::gen::inRange(0, axis.count()))]
            : test::uniform(axis.darkest, 1);
    const double means[4] = {1, 1, 1, 1};
    const SunStencil stencil = steep_stencil(axis, cosine, sun_stencil(axis, cosine).column, means);
    const double u = std::clamp(axis.position(cosine), 0.0, axis.count() - 1.0);
    double sum = 0;
    double first = 0;
    for (int j = 0; j < 4; ++j) {
        RC_ASSERT(stencil.weights[j] >= 0);
        // Nothing from columns that are a step away or further.
        if (std::fabs(stencil.column + j - u) >= 1) RC_ASSERT(stencil.weights[j] < 1e-12);
        sum += stencil.weights[j];
        first += stencil.weights[j] * (stencil.column + j);
    }
    RC_ASSERT(std::fabs(sum - 1) < 1e-12);
    RC_ASSERT(std::fabs(first - u) < 1e-12);
}

}  // namespace
}  // namespace skybake
