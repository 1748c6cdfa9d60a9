// Slabs that are seen from outside, as a runtime marches them: against doubling and published values.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/radiance_solver.h"
#include "config/sections/layer.h"
#include "tests/cloud_light/layers.h"
#include "tests/cloud_light/radiance_view.h"
#include "tests/published/published_slabs.h"

namespace skybake::cloud_light {
namespace {

CloudScattering henyey_greenstein(double g, double albedo) {
    return {{{1, make_phase_function(config::Phase::henyey_greenstein, g)}}, albedo};
}

// A slab of a vertical optical depth, 48 voxels of 8 m high.
CloudLayer slab(double depth) { return test::layer_of({3, 2, 48}, 1, depth / (8 * 48)); }

TEST(Radiance, OfASlabLeavesAsDoublingSays) {
    for (const bool isotropic : {true, false}) {
        const std::vector<double> moments =
            isotropic ? std::vector<double>{1} : std::vector<double>{1, 0, 0.1};
        const std::vector<double> cosines = {0.5};
        const test::DoubledSlab wanted(4, 0.9, moments, 0.6, 1, cosines);
        const CloudScattering scattering = {
            {{1, make_phase_function(isotropic ? config::Phase::isotropic : config::Phase::rayleigh,
                                     0)}},
            0.9};
        LayerSources sources;
        sources.sun = 1;
        sources.sun_direction = towards(std::asin(0.6), 0.3);
        for (const bool up : {true, false}) {
            const glm::dvec3 look =
                towards((up ? -1 : 1) * std::asin(0.5), 0.3 + std::numbers::pi / 2);
            const double exact = wanted.leaving(0, up, 0);
            EXPECT_NEAR(test::marched_from_outside(slab(4), scattering, sources, look), exact,
                        0.02 * exact)
                << isotropic << ' ' << up;
        }
    }
}

// Light that a slab scatters once, for a phase function in 1/sr.
double scattered_once(double depth, double albedo, double phase, double sun, double cosine,
                      bool up) {
    const double sum = 1 / sun + (up ? 1 : -1) / cosine;
    const double light = albedo * phase / cosine * -std::expm1(-depth * sum) / sum;
    return up ? light : light * std::exp(-depth / cosine);
}

// Returns the slab as a march with exact coefficients up to a degree sees it: doubling of the scaled slab,
// in which light that is scattered once has the true phase function. Nothing of it is the solver's.
double seen_of_degree(int degree, const test::Slab& slab, std::size_t view, bool up) {
    constexpr double kG = 0.75;
    const std::vector<double> moments = test::powers_of(kG);
    const double peak = moments[static_cast<std::size_t>(degree) + 1];
    const double share = 1 - slab.albedo * peak;
    const double albedo = slab.albedo * (1 - peak) / share;
    const double cosine = slab.cosines[view];
    // The cosine of the scattering angle: the sun is at the zenith.
    const double along = up ? -cosine : cosine;
    std::vector<double> rest;
    double truncated = 0;
    for (int l = 0; l <= degree; ++l) {
        rest.push_back((moments[static_cast<std::size_t>(l)] - peak) / (1 - peak));
        truncated += (2 * l + 1) / (4 * std::numbers::pi) * rest.back() * std::legendre(l, along);
    }
    const double true_phase = (1 - kG * kG) / (4 * std::numbers::pi * share *
                                               std::pow(1 + kG * kG - 2 * kG * along, 1.5));
    const test::DoubledSlab doubled(share * slab.depth, albedo, rest, 1, slab.beam, {cosine});
    const auto once = [&](double albedo_of, double phase) {
        return slab.beam * scattered_once(share * slab.depth, albedo_of, phase, 1, cosine, up);
    };
    return doubled.leaving(0, up, 0) - once(albedo, truncated) + once(slab.albedo, true_phase);
}

// Up to 30 degrees from the sun, seen through the slab. Without the factors of forward_scattering the
// march is up to 118 % too bright 8 degrees from the sun, and 9 % too dark at 30 degrees.
TEST(Radiance, AroundTheSunIsThatOfDoublingByForwardScattering) {
    constexpr double kG = 0.85;
    constexpr std::size_t kMoments = 100;  // the last is 1e-7
    const CloudScattering scattering = henyey_greenstein(kG, 1);
    std::vector<double> moments = {1};
    while (moments.size() < kMoments) moments.push_back(kG * moments.back());
    const std::vector<double> cosines = {0.99, 0.97, 0.87};
    LayerSources sources;
    sources.sun = 1;
    for (const double depth : {0.5, 8.0}) {
        const test::DoubledSlab wanted(depth, 1, moments, 1, sources.sun, cosines);
        const CloudLayer layer = slab(depth);
        const SolvedRadiance solved =
            solve_radiance(layer, place_grid(layer.size, 1, false), scattering, kMostDegree,
                           sources, {.threads = 2});
        test::LightTextures textures = test::textures_of(layer, solved, sources);
        const auto error = [&](std::size_t view) {
            double passed = 1;
            const glm::dvec3 look = towards(std::asin(cosines[view]), 1);
            return test::marched(layer, textures, scattering, sources, kMostDegree, {1, 1, 0}, look,
                                 0.5, passed) /
                       wanted.leaving(view, false, 0) -
                   1;
        };
        EXPECT_GT(error(0), 0.1) << depth;
        textures.forward = test::forward_texels(scattering, kMostDegree);
        for (std::size_t view = 0; view < cosines.size(); ++view) {
            EXPECT_NEAR(error(view), 0, 2e-3) << depth << ' ' << cosines[view];
        }
    }
}

// Harmonics of degree 3 reflect 7.9 % less of slab 3a than is published and transmit 1.6 % less, whoever
// solves for them. The solver is within 0.05 % of that. With more degrees the difference vanishes.
TEST(Radiance, OfASlabDiffersFromWhatIsPublishedByItsDegree) {
    const test::Slab& slab_3a = test::slab_named("3a");
    LayerSources sources;
    sources.sun = slab_3a.beam;
    sources.sun_direction = {0, 0, 1};
    const CloudScattering scattering = henyey_greenstein(0.75, slab_3a.albedo);
    for (const bool up : {true, false}) {
        const double published = up ? slab_3a.up[1] : slab_3a.down[1];
        const double of_degree = seen_of_degree(kMostDegree, slab_3a, 1, up);
        EXPECT_NEAR(of_degree / published, up ? 0.9213 : 0.9839, 3e-4) << up;
        EXPECT_NEAR(seen_of_degree(15, slab_3a, 1, up) / published, 1, 2e-3) << up;
        const glm::dvec3 look = towards((up ? -1 : 1) * std::asin(slab_3a.cosines[1]), 1);
        EXPECT_NEAR(test::marched_from_outside(slab(slab_3a.depth), scattering, sources, look),
                    of_degree, 1e-3 * published)
            << up;
    }
}

}  // namespace
}  // namespace skybake::cloud_light
