// Layers under skies that are not uniform: against the uniform sky, doubling and paths of light.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/radiance_solver.h"
#include "config/sections/layer.h"
#include "tests/cloud_light/layers.h"
#include "tests/cloud_light/radiance_view.h"
#include "tests/published/doubled_slab.h"

namespace skybake::cloud_light {
namespace {

constexpr double kPi = std::numbers::pi;

CloudScattering rayleigh(double albedo) {
    return {{{1, make_phase_function(config::Phase::rayleigh, 0)}}, albedo};
}

LayerSources of_sky(SkyByDirection shape) {
    LayerSources sources;
    sources.sky = 1;
    sources.sky_shape = std::move(shape);
    return sources;
}

CellFields solved(const CloudLayer& layer, const CloudScattering& scattering,
                  const LayerSources& sources) {
    const SolvedRadiance found = solve_radiance(layer, place_grid(layer.size, 1, false), scattering,
                                                kMostDegree, sources, {.threads = 2});
    EXPECT_LE(found.change, kLargestChange);
    return found.scattered;
}

double gradient(const glm::dvec3& d) { return 1 + 0.9 * d.x - 0.3 * d.y + 0.4 * (1 - d.z); }

TEST(ShapedSky, UniformHasTheBitsOfNoShape) {
    const CloudLayer layer = test::rough_layer({9, 6, 7}, 0.4);
    const CellFields uniform = solved(layer, scattering_of(droplet_phase(12), 1), of_sky({}));
    const CellFields shaped = solved(layer, scattering_of(droplet_phase(12), 1),
                                     of_sky([](const glm::dvec3&) { return 1.0; }));
    for (std::size_t c = 0; c < uniform.count(); ++c) {
        EXPECT_EQ(values_of(uniform, c), values_of(shaped, c)) << c;
    }
}

// Where there is no cloud, J is what little cloud would scatter of the sky itself.
TEST(ShapedSky, OfAnEmptyLayerIsTheSkyItself) {
    const CloudLayer layer = test::layer_of({2, 2, 3}, 0);
    const ScaledScattering scattering = scaled(rayleigh(1), kMostDegree);
    const CellFields found = solved(layer, rayleigh(1), of_sky(gradient));
    // Integrals of the gradient over the upper hemisphere, times harmonics of the way on.
    const double zero = 2 * kPi * 1.2 / (2 * std::sqrt(kPi));
    const double first = -std::sqrt(3 / (4 * kPi)) * 2 * kPi / 3;
    const std::array<double, 4> wanted = {zero, -0.3 * first, first * (1.4 * 1.5 - 0.4),
                                          0.9 * first};
    for (std::size_t c = 0; c < wanted.size(); ++c) {
        const double returned = scattering.returned[degree_of_harmonic(c)];
        EXPECT_NEAR(values_of(found, c).front(), returned * wanted[c], 1e-5) << c;
    }
}

TEST(ShapedSky, IsNotScatteredByAnEmptyLayer) {
    const CloudLayer layer = test::layer_of({2, 2, 3}, 0);
    for (const double rise : {-0.7, 0.7}) {
        const glm::dvec3 look = towards(rise, 0.4);
        EXPECT_EQ(test::marched_from_outside(layer, scattering_of(droplet_phase(12), 1),
                                             of_sky(gradient), look),
                  rise > 0 ? gradient(look) : 0);
    }
}

// A sky is many suns: the light that a slab scatters of each, by doubling.
class SlabUnderSuns {
  public:
    SlabUnderSuns(double depth, double albedo, double view_cosine) {
        for (std::size_t i = 0; i < kRings; ++i) {
            slabs_.emplace_back(depth, albedo, std::vector<double>{1, 0, 0.1}, rule_.nodes[i],
                                2 * kPi * rule_.weights[i] / kAround,
                                std::vector<double>{view_cosine});
        }
    }

    double leaving(const SkyByDirection& sky, const glm::dvec3& look) const {
        const double azimuth = std::atan2(look.y, look.x);
        double sum = 0;
        for (std::size_t i = 0; i < kRings; ++i) {
            for (int k = 0; k < kAround; ++k) {
                const double turn = 2 * kPi * k / kAround;
                const glm::dvec3 sun = towards(std::asin(rule_.nodes[i]), azimuth + turn);
                sum += sky(sun) * slabs_[i].leaving(0, look.z < 0, std::cos(turn));
            }
        }
        return sum;
    }

  private:
    static constexpr std::size_t kRings = 5;
    static constexpr int kAround = 8;
    QuadratureRule rule_ = gauss_legendre(kRings);
    std::vector<test::DoubledSlab> slabs_;
};

TEST(ShapedSky, OnASlabIsThatOfDoublingAndOfPaths) {
    constexpr double kDepth = 2;
    constexpr double kAlbedo = 0.95;
    const CloudLayer layer = test::layer_of({3, 2, 48}, 1, kDepth / (8 * 48));
    const LayerSources sources = of_sky(gradient);
    const SlabUnderSuns suns(kDepth, kAlbedo, std::sin(0.7));
    for (const bool up : {true, false}) {
        const glm::dvec3 look = towards((up ? -1 : 1) * 0.7, 0.4);
        const double wanted = suns.leaving(gradient, look);
        const double seen = up ? 0 : gradient(look) * std::exp(-kDepth / look.z);
        EXPECT_NEAR(test::marched_from_outside(layer, rayleigh(kAlbedo), sources, look) - seen,
                    wanted, 0.01 * wanted)
            << up;
        // All that they see but the sky itself.
        const TracedRadiance paths =
            CloudPaths(layer, rayleigh(kAlbedo), sources, 2)
                .trace({1, 1, look.z < 0 ? layer.size[2] : 0}, look, 20000, 3, 0);
        EXPECT_NEAR(paths.sum() - seen, wanted, 4 * paths.standard_error) << up;
        EXPECT_LT(paths.standard_error, 0.015 * wanted) << up;
        // The sky the other way round is told from it.
        const auto flipped = [](const glm::dvec3& d) { return gradient({-d.x, -d.y, d.z}); };
        EXPECT_GT(std::fabs(suns.leaving(flipped, look) - wanted), 0.02 * wanted) << up;
    }
}

}  // namespace
}  // namespace skybake::cloud_light
