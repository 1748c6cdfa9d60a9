#include "bakers/field/baked.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/phase/phase_fit.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/interpolation.h"
#include "config/assets/phase.h"
#include "tests/support/atmospheres.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using config::PhaseSpacing;

constexpr PhaseSpacing kSpacings[] = {PhaseSpacing::angle, PhaseSpacing::cosine,
                                      PhaseSpacing::peaks, PhaseSpacing::cosine_from_back};

const std::string kParticles =
    "preset = 'earth_hillaire'\n[particles.fog]\npreset = 'fog'\n[particles.haze]\npreset = "
    "'haze'\n"
    "[bake.phase]\n";

Baked bake(const std::string& keys, int threads = 0) {
    const config::Recipe recipe = test::recipe_of(kParticles + keys);
    return test::without_diagnostics(
        bake_asset(recipe, recipe.parameters.bakes.back(), BakeOptions{threads}));
}

double lookup(const Baked& table, double x, std::size_t channel) {
    double values[4];
    bilinear(
        table.image(),
        texture_coordinate(TexelConvention::end_points_on_texel_centres, x, table.image().width),
        0.5, values);
    return values[channel];
}

RC_GTEST_PROP(PhaseAxis, CoordinatesReturn, ()) {
    const double x = *rc::gen::inRange(0, 1 << 20) / static_cast<double>(1 << 20);
    for (const PhaseSpacing spacing : kSpacings) {
        const ScatteringAngle angle = scattering_angle(spacing, x);
        RC_ASSERT(std::fabs(phase_coordinate(spacing, angle) - x) < 1e-12);
        RC_ASSERT(std::fabs(angle.one_minus + angle.one_plus - 2) < 1e-15);
        RC_ASSERT(std::fabs(std::cos(radians(angle)) - (1 - angle.one_minus)) < 1e-14);
    }
}

TEST(PhaseAxis, SmallAnglesKeepTheirDigits) {
    for (const double theta : {1e-8, 1e-5, 1e-3, 2.1e-3, 0.1, 3.0}) {
        const double half_sine = std::sin(theta / 2);
        const double half_cosine = std::cos(theta / 2);
        EXPECT_NEAR(radians({2 * half_sine * half_sine, 2 * half_cosine * half_cosine}) / theta, 1,
                    1e-13);
    }
}

TEST(PhaseTable, ClosedFormsAreExactAndLookUpWell) {
    const Baked table = bake("layer = 'mie'\n");
    EXPECT_LT(table.certificate.texel.max, 1e-7);
    EXPECT_LT(table.certificate.lookup.max, 1e-4);
    EXPECT_EQ(table.certificate.reference, "closed form");
}

TEST(PhaseTable, ErrorBoundsChooseSizeAndSpacing) {
    const Baked coarse = bake("particles = 'fog'\nmax_error = '5 %'\n");
    const Baked fine = bake("particles = 'fog'\nmax_error = '0.5 %'\n");
    EXPECT_LE(coarse.certificate.lookup.max, 0.05);
    EXPECT_LE(fine.certificate.lookup.max, 0.005);
    EXPECT_LT(coarse.image().width, fine.image().width);
    EXPECT_EQ(coarse.mapping, "peaks");
    // Each spacing of its own needs more for the same.
    for (const char* spacing : {"angle", "cosine"}) {
        const config::Recipe recipe = test::recipe_of(
            kParticles + "particles = 'fog'\nmax_error = '5 %'\nspacing = '" + spacing + "'\n");
        const auto other = bake_asset(recipe, recipe.parameters.bakes.back(), {});
        // The cosine gets nowhere near.
        const int width = other.value ? other.value->image().width : 16384;
        EXPECT_GT(width, coarse.image().width) << spacing;
    }
}

// Bevy's first texel is backward scattering, and its last forward scattering.
TEST(PhaseTable, FromTheBackIsTheCosineReversed) {
    const Baked forth = bake("particles = 'haze'\nspacing = 'cosine'\nsize = 64\n");
    const Baked back = bake("particles = 'haze'\nspacing = 'cosine_from_back'\nsize = 64\n");
    EXPECT_EQ(back.mapping, "cosine_from_back");
    for (int i = 0; i < 64; ++i) {
        const double x = i / 63.0;
        EXPECT_NEAR(lookup(back, x, 1) / lookup(forth, 1 - x, 1), 1, 1e-6) << i;
    }
    EXPECT_GT(lookup(back, 1, 1), 10 * lookup(back, 0, 1));
}

TEST(PhaseTable, FogHasItsBowAndGlory) {
    const Baked table = bake("particles = 'fog'\nspacing = 'angle'\nsize = 3601\n");
    const auto at = [&](double degrees) { return lookup(table, degrees / 180, 1); };
    EXPECT_GT(at(142), 2 * at(110));
    EXPECT_GT(at(142), 1.5 * at(160));
    EXPECT_GT(at(180), 2 * at(165));
    EXPECT_GT(at(0), 1e3 * at(30) / 2);
}

// The inverse table, looked up, brings a uniform share back through the cumulative distribution.
TEST(PhaseTable, TheInverseInvertsTheTable) {
    for (const char* of : {"particles = 'haze'\n", "layer = 'mie'\n", "layer = 'rayleigh'\n"}) {
        const Baked phase = bake(std::string(of) + "spacing = 'peaks'\nsize = 4096\n");
        const Baked inverse =
            bake(std::string(of) + "content = 'inverse_cumulative'\nsize = 4096\n");
        // The share up to an angle, by the first table's own lookups.
        constexpr int kCells = 20000;
        double share = 0;
        double worst = 0;
        double before = lookup(phase, 0, 0);
        double angle_before = 0;
        for (int i = 1; i <= kCells; ++i) {
            const double x = static_cast<double>(i) / kCells;
            const double one_minus = scattering_angle(PhaseSpacing::peaks, x).one_minus;
            const double value = lookup(phase, x, 0);
            share += std::numbers::pi * (value + before) * (one_minus - angle_before);
            before = value;
            angle_before = one_minus;
            if (i % 500 == 0 && share < 1) {
                const double expected = radians({one_minus, 2 - one_minus});
                const double found = lookup(inverse, share, 0);
                worst = std::max(worst, std::fabs(radians({found, 2 - found}) - expected));
            }
        }
        EXPECT_NEAR(share, 1, 2e-4) << of;
        EXPECT_LT(worst, 0.02) << of;
    }
}

// A bound on the table's error is one on the spheres' too.
TEST(PhaseTable, AskingForMoreMakesTheSeriesBetter) {
    const auto reference = [](const std::string& bound) {
        return bake("particles = 'haze'\nmax_error = '" + bound + "'\n").certificate.reference;
    };
    EXPECT_NE(reference("10 %"), reference("0.5 %"));
}

TEST(PhaseTable, SaysWhatRuntimesComputeWith) {
    const Baked table = bake("particles = 'haze'\ndegree = 4\n");
    const auto detail = [&](const std::string& key) {
        for (const auto& [name, value] : table.details) {
            if (name == key) return value;
        }
        ADD_FAILURE() << key;
        return FactValue();
    };
    const auto number = [&](const std::string& key) { return std::get<double>(detail(key)); };
    const auto moments = std::get<std::vector<double>>(detail("legendre_moments_G"));
    ASSERT_EQ(moments.size(), 5U);
    EXPECT_EQ(moments[0], 1);
    EXPECT_NEAR(moments[1], number("mean_cosine_G"), 1e-3);
    EXPECT_GT(number("fit_draine_R_g"), 0);
    EXPECT_LT(number("fit_draine_R_g"), 1);
    EXPECT_GT(number("fit_draine_R_largest_ratio"), 1);
    EXPECT_GT(number("extinction_cross_section_um2_440_nm"),
              number("extinction_cross_section_um2_680_nm"));
}

TEST(PhaseTable, SameBytesForAnyNumberOfThreads) {
    const Baked one = bake("particles = 'haze'\n", 1);
    const Baked two = bake("particles = 'haze'\n", 2);
    EXPECT_EQ(one.image().texels, two.image().texels);
    EXPECT_EQ(one.details, two.details);
}

TEST(PhaseFit, FindsTheFormThatItIs) {
    for (const double g : {-0.6, 0.0, 0.8, 0.97}) {
        const auto of_henyey = fit_phase(make_phase_function(config::Phase::henyey_greenstein, g));
        EXPECT_NEAR(of_henyey[0].parameters[0], g, 1e-3);
        EXPECT_LT(of_henyey[0].misplaced, 1e-3);
        const auto of_shanks = fit_phase(make_phase_function(config::Phase::cornette_shanks, g));
        EXPECT_NEAR(of_shanks[2].parameters[0], g, 1e-3);
        EXPECT_LT(of_shanks[2].misplaced, 1e-3);
        EXPECT_LE(of_shanks[3].misplaced, of_shanks[2].misplaced + 1e-4);
    }
    const auto rayleigh = fit_phase(make_phase_function(config::Phase::rayleigh, 0));
    EXPECT_NEAR(rayleigh[3].parameters[1], 1, 1e-2);
}

// Where the form has too little light and where it has too much.
TEST(PhaseFit, TheLargestRatioIsOfEitherSide) {
    std::array<int, 2> cases{};
    for (const double g : {0.3, 0.9}) {
        for (const config::Phase phase : {config::Phase::rayleigh, config::Phase::cornette_shanks,
                                          config::Phase::henyey_greenstein}) {
            const PhaseFunction function = make_phase_function(phase, g);
            for (const PhaseFit& fit : fit_phase(function)) {
                std::array<double, 2>
                    largest{};  // of the form's light over the function's, and back
                for (int i = 0; i <= 4096; ++i) {
                    const ScatteringAngle at = scattering_angle(PhaseSpacing::peaks, i / 4096.0);
                    const double ratio =
                        fitted_value(fit.form, fit.parameters, at.one_minus, at.one_plus) /
                        phase_value(function, at.one_minus, at.one_plus);
                    largest = {std::max(largest[0], ratio), std::max(largest[1], 1 / ratio)};
                }
                const double both = std::max(largest[0], largest[1]);
                EXPECT_NEAR(fit.largest_ratio / both, 1, 1e-3) << fit.form << g;
                for (std::size_t i = 0; i < 2; ++i) cases[i] += largest[1 - i] < 0.9 * both ? 1 : 0;
            }
        }
    }
    EXPECT_GT(cases[0], 0);
    EXPECT_GT(cases[1], 0);
    // Even light in the place of 3 / 16 pi (1 + cos^2), which has half as much again straight on.
    const auto rayleigh = fit_phase(make_phase_function(config::Phase::rayleigh, 0));
    EXPECT_NEAR(rayleigh[0].largest_ratio, 1.5, 0.01);
}

// Asymmetries are found to a share of the width of their lobe, also of lobes that look back.
TEST(PhaseFit, NarrowLobesAreFoundToAShareOfTheirWidth) {
    for (const double g : {-0.995, -0.97, -0.6, 0.6, 0.97, 0.995}) {
        const auto fits = fit_phase(make_phase_function(config::Phase::henyey_greenstein, g));
        EXPECT_NEAR(fits[0].parameters[0], g, 2e-4 * (1 - std::fabs(g)));
    }
}

// A better fit than a scan of the parameter finds is not left out, and more parameters fit better.
TEST(PhaseFit, LeavesNoBetterOneOut) {
    const config::Recipe recipe = test::recipe_of(kParticles + "particles = 'fog'\n");
    const auto& bake = recipe.parameters.bakes.back().as<config::PhaseBake>();
    const PhaseSource source = phase_source(recipe.parameters, bake, 0);
    const PhaseFunction& fog = source.functions[1];
    const auto fits = fit_phase(fog);
    EXPECT_LT(fits[1].misplaced, 0.5 * fits[0].misplaced);
    EXPECT_LE(fits[3].misplaced, fits[0].misplaced + 1e-6);
    const auto misplaced = [&](double g) {
        double sum = 0;
        constexpr int kCells = 4000;
        double last = 0;
        double one_minus_last = 0;
        for (int i = 0; i <= kCells; ++i) {
            const ScatteringAngle angle =
                scattering_angle(PhaseSpacing::peaks, static_cast<double>(i) / kCells);
            const double difference =
                std::fabs(fitted_value("henyey_greenstein", {g}, angle.one_minus, angle.one_plus) -
                          phase_value(fog, angle.one_minus, angle.one_plus));
            if (i > 0) {
                sum += 0.5 * std::numbers::pi * (difference + last) *
                       (angle.one_minus - one_minus_last);
            }
            last = difference;
            one_minus_last = angle.one_minus;
        }
        return sum;
    };
    EXPECT_NEAR(misplaced(fits[0].parameters[0]), fits[0].misplaced, 2e-3);
    for (double one_minus = 2; one_minus > 1e-3; one_minus *= 0.9) {
        EXPECT_GT(misplaced(1 - 0.999 * one_minus), fits[0].misplaced - 2e-3) << one_minus;
    }
}

}  // namespace
}  // namespace skybake
