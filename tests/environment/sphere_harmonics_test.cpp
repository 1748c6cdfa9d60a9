#include "bakers/assets/environment/sphere_harmonics.h"
#include "config/assets/environment.h"

#include <gtest/gtest.h>

#include "tests/environment/maps.h"

namespace skybake {
namespace {

using config::EnvironmentMapping;
using test::kPi;
using test::map_of;
using test::MappingCase;

const std::vector<MappingCase> kFineMaps = {{EnvironmentMapping::longitude_latitude, {256, 128}},
                                            {EnvironmentMapping::cube, {64, 384}},
                                            {EnvironmentMapping::octahedral, {128, 128}}};

// Associated Legendre polynomials by Rodrigues' formula without the Condon-Shortley phase, from their
// recurrence (Abramowitz & Stegun 8.5.3), and the normalization in factorials.
double legendre(int l, int m, double z) {
    double of_m = 1;
    for (int i = 1; i <= m; ++i) of_m *= (2 * i - 1) * std::sqrt(1 - z * z);
    if (l == m) return of_m;
    double before = of_m;
    double value = z * (2 * m + 1) * of_m;
    for (int i = m + 2; i <= l; ++i) {
        const double next = ((2 * i - 1) * z * value - (i + m - 1) * before) / (i - m);
        before = value;
        value = next;
    }
    return value;
}
double harmonic(int l, int m, const glm::dvec3& direction) {
    const int order = std::abs(m);
    const double norm = std::sqrt((2 * l + 1) / (4 * kPi) * std::tgamma(l - order + 1) /
                                  std::tgamma(l + order + 1));
    const double of_z = norm * legendre(l, order, direction.y);
    const double azimuth = std::atan2(direction.z, direction.x);  // from right to ahead
    if (m == 0) return of_z;
    return std::sqrt(2.0) * of_z * (m > 0 ? std::cos(order * azimuth) : std::sin(order * azimuth));
}

TEST(SphereHarmonics, AreTheAssociatedLegendrePolynomials) {
    for (const glm::dvec3& direction : test::even_directions(100)) {
        const auto found = harmonics_at(direction);
        for (int l = 0; l <= kHarmonicDegree; ++l) {
            for (int m = -l; m <= l; ++m) {
                EXPECT_NEAR(found[static_cast<std::size_t>(l * (l + 1) + m)],
                            harmonic(l, m, direction), 1e-12)
                    << l << " " << m;
            }
        }
    }
}

// A white furnace, and light that is one of the harmonics.
TEST(SphereHarmonics, OfOneOfThemAreItself) {
    for (const MappingCase& of : kFineMaps) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const auto white =
            harmonics_of(map_of(layout, [](const glm::dvec3&) { return 1; }), layout);
        EXPECT_NEAR(white[0][0], std::sqrt(4 * kPi), 1e-6);
        for (std::size_t i = 1; i < kHarmonics; ++i) EXPECT_NEAR(white[0][i], 0, 1e-3);
        for (const std::size_t k : {1U, 6U, 11U, 16U, 20U, 24U}) {
            const auto light = [k](const glm::dvec3& d) { return harmonics_at(d)[k]; };
            const auto found = harmonics_of(map_of(layout, light), layout);
            for (std::size_t i = 0; i < kHarmonics; ++i) {
                EXPECT_NEAR(found[0][i], i == k ? 1 : 0, 1e-3) << i << " " << k;
            }
        }
    }
}

TEST(SphereHarmonics, IrradianceOfWhiteIsPi) {
    for (const MappingCase& of : kFineMaps) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const Image2<float> white = map_of(layout, [](const glm::dvec3&) { return 1; });
        EXPECT_NEAR(level_irradiance(white, layout)[0], kPi, 1e-3 * kPi);
        // The irradiance of light that is the cosine itself is 2 pi / 3; light from below is none.
        const Image2<float> cosine = map_of(layout, [](const glm::dvec3& d) { return d.y; });
        EXPECT_NEAR(level_irradiance(cosine, layout)[0], 2 * kPi / 3, 2e-3);
    }
}

}  // namespace
}  // namespace skybake
