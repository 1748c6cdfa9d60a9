// Spherical harmonics, by what defines them: they are orthonormal, and products of polynomials.
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/assets/cloud_light/cloud_layer.h"

namespace skybake::cloud_light {
namespace {

// Over both hemispheres.
Harmonics integral(const auto& function) {
    Harmonics sum{};
    for (const SkyDirection& sky : sky_directions(8, 16)) {
        for (const double side : {1.0, -1.0}) {
            const glm::dvec3 direction(sky.direction.x, sky.direction.y, side * sky.direction.z);
            const Harmonics values = harmonics(direction);
            const double weight = sky.solid_angle * function(direction);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
        }
    }
    return sum;
}

TEST(Harmonics, AreOrthonormal) {
    for (std::size_t one = 0; one < kMostHarmonics; ++one) {
        const Harmonics product =
            integral([one](const glm::dvec3& d) { return harmonics(d)[one]; });
        for (std::size_t other = 0; other < kMostHarmonics; ++other) {
            EXPECT_NEAR(product[other], one == other ? 1 : 0, 1e-12) << one << ' ' << other;
        }
    }
}

// The addition theorem: over each degree l the products at two directions add up to
// (2 l + 1) / (4 pi) P_l of the cosine between them. It tells an order in the place of another.
TEST(Harmonics, AddUpToLegendrePolynomials) {
    const glm::dvec3 a = towards(0.3, 1.1);
    const glm::dvec3 b = towards(-1.0, 4.2);
    const double u = glm::dot(a, b);
    const std::array<double, 4> legendre = {1, u, (3 * u * u - 1) / 2, (5 * u * u * u - 3 * u) / 2};
    const Harmonics of_a = harmonics(a);
    const Harmonics of_b = harmonics(b);
    std::size_t i = 0;
    for (std::size_t degree = 0; degree <= kMostDegree; ++degree) {
        double sum = 0;
        for (; i < (degree + 1) * (degree + 1); ++i) sum += of_a[i] * of_b[i];
        EXPECT_NEAR(
            sum, (2 * static_cast<double>(degree) + 1) / (4 * std::numbers::pi) * legendre[degree],
            1e-14);
    }
}

TEST(Harmonics, TheFirstDegreeIsTheDirection) {
    const Harmonics values = harmonics({0.6, 0, 0.8});
    EXPECT_NEAR(values[2] / values[3], 0.8 / 0.6, 1e-15);
    EXPECT_EQ(values[1], 0);
}

TEST(SkyDirections, CoverTheUpperHemisphere) {
    double sum = 0;
    double cosine = 0;
    for (const SkyDirection& sky : sky_directions(6, 12)) {
        EXPECT_NEAR(glm::length(sky.direction), 1, 1e-15);
        EXPECT_GT(sky.direction.z, 0);
        sum += sky.solid_angle;
        cosine += sky.solid_angle * sky.direction.z;
    }
    EXPECT_NEAR(sum, 2 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(cosine, std::numbers::pi, 1e-12);
}

TEST(CoefficientWeights, ProjectAnOpenSky) {
    Harmonics sum{};
    for (const Harmonics& weights : projection_weights(sky_directions(6, 12))) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[i];
    }
    EXPECT_NEAR(sum[0], std::sqrt(std::numbers::pi), 1e-12);
    EXPECT_NEAR(sum[2], std::sqrt(3 * std::numbers::pi) / 2, 1e-12);
    EXPECT_NEAR(sum[3], 0, 1e-12);
}

// A sum of harmonics is its own nearest one, though harmonics are not orthogonal over a hemisphere.
TEST(CoefficientWeights, FitWhatIsASumOfHarmonics) {
    const std::vector<SkyDirection> directions = sky_directions(6, 12);
    for (int degree = 0; degree <= kMostDegree; ++degree) {
        const auto count = static_cast<std::size_t>((degree + 1) * (degree + 1));
        const CoefficientWeights weights = hemisphere_fit_weights(directions, degree);
        Harmonics found{};
        for (std::size_t n = 0; n < directions.size(); ++n) {
            const Harmonics values = harmonics(directions[n].direction);
            double value = 0;
            for (std::size_t i = 0; i < count; ++i) value += static_cast<double>(i + 1) * values[i];
            for (std::size_t i = 0; i < found.size(); ++i) found[i] += weights[n][i] * value;
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], i < count ? static_cast<double>(i + 1) : 0, 1e-9)
                << degree << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace skybake::cloud_light
