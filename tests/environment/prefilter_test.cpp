#include <gtest/gtest.h>

#include <algorithm>

#include "bakers/assets/environment/prefilter.h"
#include "bakers/assets/environment/sphere_harmonics.h"
#include "config/assets/environment.h"
#include "tests/environment/maps.h"

namespace skybake {

namespace {

using config::EnvironmentMapping;
using namespace test;

const std::vector<MappingCase> kMaps = {{EnvironmentMapping::longitude_latitude, {64, 32}},
                                        {EnvironmentMapping::cube, {24, 144}},
                                        {EnvironmentMapping::octahedral, {48, 48}}};
const BakeOptions kOneThread{.threads = 1};

// Bright over a quarter of the sky, on a gradient.
double lamp(const glm::dvec3& d) {
    const glm::dvec3 to_lamp = glm::normalize(glm::dvec3(1, 1, 2));
    return 1 + 0.5 * d.y + 8 * std::exp(12 * (glm::dot(d, to_lamp) - 1));
}

// The two integrals of the split sum as sums over every texel of a fine map, with the microfacets'
// distribution in tangents (Walter et al. 2007, equation 33).
double by_all_texels(const Image2<float>& map, const EnvironmentLayout& layout,
                     const glm::dvec3& normal, double roughness) {
    const double alpha = roughness * roughness;
    double light = 0;
    double weights = 0;
    test::for_texels(map, layout, [&](const glm::dvec3& l, double solid_angle, const float* texel) {
        const double cosine = glm::dot(normal, l);
        if (cosine <= 0) return;
        const double half = glm::dot(normal, glm::normalize(normal + l));
        const double tangent_square = 1 / (half * half) - 1;
        const double bottom = alpha * alpha + tangent_square;
        const double facets = alpha * alpha / (kPi * half * half * half * half * bottom * bottom);
        light += facets * cosine * solid_angle * double{*texel};
        weights += facets * cosine * solid_angle;
    });
    return light / weights;
}

TEST(Prefilter, WhiteStaysWhite) {
    for (const MappingCase& of : kMaps) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const EnvironmentLayout half(of.mapping, {of.size[0] / 2, of.size[1] / 2});
        const MapPyramid pyramid(of.mapping, map_of(layout, [](const glm::dvec3&) { return 1; }));
        for (const double roughness : {1e-3, 0.2, 0.6, 1.0}) {
            for (const double texel : prefiltered(pyramid, half, roughness, kOneThread).texels) {
                EXPECT_NEAR(texel, 1, 1e-6);
            }
        }
    }
}

TEST(Prefilter, IsTheIntegralOverAllTexels) {
    for (const MappingCase& of : kMaps) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const Image2<float> map = map_of(layout, lamp);
        const MapPyramid pyramid(of.mapping, map);
        for (const double roughness : {0.4, 0.7, 1.0}) {
            const EnvironmentLayout small(of.mapping, {of.size[0] / 4, of.size[1] / 4});
            const Image2<double> found = prefiltered(pyramid, small, roughness, kOneThread);
            const auto [columns, rows] = small.part_size();
            double largest = 0;
            for (int line = 0; line < found.height; ++line) {
                for (int x = 0; x < columns; ++x) {
                    const glm::dvec3 normal = small.direction(line / rows, (x + 0.5) / columns,
                                                              (line % rows + 0.5) / rows);
                    const double wanted = by_all_texels(map, layout, normal, roughness);
                    largest = std::max(largest, std::fabs(*found.texel(x, line) / wanted - 1));
                }
            }
            EXPECT_LT(largest, 0.05) << roughness;
            RecordProperty("largest", std::to_string(largest));
        }
    }
}

// A lookup over the solid angle of 2^k by 2^k texels, in the middle of a block of so many, is the mean of
// the block.
TEST(Prefilter, LooksUpMeansOverASolidAngle) {
    for (const MappingCase& of : {MappingCase{EnvironmentMapping::cube, {16, 96}},
                                  MappingCase{EnvironmentMapping::octahedral, {16, 16}}}) {
        const EnvironmentLayout layout(of.mapping, of.size);
        Image2<float> map(of.size[0], of.size[1], 1);
        for (std::size_t i = 0; i < map.texels.size(); ++i) {
            map.texels[i] = static_cast<float>(i % 7 + i / 16 % 5);
        }
        const MapPyramid pyramid(of.mapping, map);
        const double texel = 4 * kPi / (layout.parts() * 16 * 16);
        for (int edge = 1; edge <= 8; edge *= 2) {
            const int first = 16 - 2 * edge;  // of a block off the part's middle
            double mean = 0;
            for (int y = first; y < first + edge; ++y) {
                for (int x = first; x < first + edge; ++x) {
                    mean += double{*map.texel(x, y)} / (edge * edge);
                }
            }
            const double middle = (first + 0.5 * edge) / 16;
            double found = 0;
            pyramid.add(layout.direction(0, middle, middle), texel * edge * edge, 1, &found);
            EXPECT_NEAR(found, mean, 1e-5) << edge;
        }
    }
}

// Twice the solid angle of a texel lies half way between the means over one texel and over four.
TEST(Prefilter, BlendsMeansOfNeighbouringLevels) {
    const EnvironmentLayout layout(EnvironmentMapping::octahedral, {16, 16});
    const MapPyramid pyramid(EnvironmentMapping::octahedral,
                             map_of(layout, [](const glm::dvec3& d) { return std::exp(3 * d.x); }));
    const double texel = 4 * kPi / (16 * 16);
    int different = 0;
    for (const glm::dvec3& direction : test::even_directions(50)) {
        const auto found = [&](double texels) {
            double sum = 0;
            pyramid.add(direction, texels * texel, 1, &sum);
            return sum;
        };
        EXPECT_NEAR(found(2), 0.5 * (found(1) + found(4)), 1e-6);
        different += std::fabs(found(4) - found(1)) > 1e-3 ? 1 : 0;
    }
    EXPECT_GT(different, 25);
}

// The closed form beside a sum over half-angles of GGX in tangents, and its integral over directions.
TEST(Prefilter, TheLobeOfALightIsTheDefinition) {
    constexpr int kSteps = 200000;
    for (const double roughness : {0.1, 0.3, 0.7, 0.95, 1.0}) {
        const double alpha = roughness * roughness;
        const auto facets = [&](double cosine) {
            const double half_square = (1 + cosine) / 2;
            const double bottom = alpha * alpha + 1 / half_square - 1;
            return alpha * alpha / (kPi * half_square * half_square * bottom * bottom);
        };
        // Steps of equal ratios of the angle, since the lobe may be narrow.
        double integral = 0;
        double whole = 0;
        const ReflectedLobe lobe(roughness);
        double before = 0;
        for (int i = 1; i <= kSteps; ++i) {
            const double angle = kPi / 2 * std::pow(static_cast<double>(i) / kSteps, 3);
            const double middle = (angle + before) / 2;
            const double ring = 2 * kPi * std::sin(middle) * (angle - before);
            integral += facets(std::cos(middle)) * std::cos(middle) * ring;
            whole += lobe.density(std::cos(middle)) * ring;
            before = angle;
        }
        EXPECT_NEAR(whole, 1, 1e-6) << roughness;
        for (const double cosine : {1.0, 0.999, 0.8, 0.3, 0.01}) {
            EXPECT_NEAR(lobe.density(cosine) / (facets(cosine) * cosine / integral), 1, 1e-6)
                << roughness << " " << cosine;
        }
        EXPECT_EQ(lobe.density(0), 0);
        EXPECT_EQ(lobe.density(-0.5), 0);
    }
    EXPECT_NEAR(ReflectedLobe(1).density(0.6), 0.6 / kPi, 1e-15);
}

TEST(Prefilter, SmoothestIsTheMap) {
    for (const MappingCase& of : kMaps) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const Image2<float> map = map_of(layout, lamp);
        const Image2<double> found =
            prefiltered(MapPyramid(of.mapping, map), layout, 0.01, kOneThread);
        for (std::size_t i = 0; i < map.texels.size(); ++i) {
            EXPECT_NEAR(found.texels[i], map.texels[i], 1e-3 * map.texels[i]);
        }
    }
}

TEST(Prefilter, RoughnessGrowsEvenlyToOne) {
    EXPECT_EQ(roughness_of_level(0, 6), 0);
    EXPECT_EQ(roughness_of_level(5, 6), 1);
    EXPECT_DOUBLE_EQ(roughness_of_level(2, 5), 0.5);
    EXPECT_EQ(roughness_of_level(0, 1), 0);
}

TEST(Prefilter, TakesMapsOfOneTexel) {
    for (const EnvironmentMapping mapping :
         {EnvironmentMapping::longitude_latitude, EnvironmentMapping::cube,
          EnvironmentMapping::octahedral}) {
        const EnvironmentLayout layout(mapping, {1, mapping == EnvironmentMapping::cube ? 6 : 1});
        const MapPyramid pyramid(mapping, map_of(layout, [](const glm::dvec3&) { return 2; }));
        EXPECT_NEAR(prefiltered(pyramid, layout, 0.5, kOneThread).texels[0], 2, 1e-6);
    }
}

const std::vector<MappingCase> kFineMaps = {{EnvironmentMapping::longitude_latitude, {256, 128}},
                                            {EnvironmentMapping::cube, {64, 384}},
                                            {EnvironmentMapping::octahedral, {128, 128}}};

// The standard library's have the Condon-Shortley phase.
double harmonic(int l, int m, const glm::dvec3& direction) {
    const int order = std::abs(m);
    const double of_z = (order % 2 == 0 ? 1 : -1) * std::sph_legendre(static_cast<unsigned>(l),
                                                                      static_cast<unsigned>(order),
                                                                      std::acos(direction.y));
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

// The horizon passes through the middle row of a map and along the diagonals of a square.
TEST(SphereHarmonics, TexelsOnTheHorizonAreLitByTheirUpperHalf) {
    for (const MappingCase& of :
         {MappingCase{config::EnvironmentMapping::longitude_latitude, {6, 3}},
          {config::EnvironmentMapping::longitude_latitude, {22, 11}},
          {config::EnvironmentMapping::octahedral, {8, 8}},
          {config::EnvironmentMapping::equal_area, {2, 2}},
          {config::EnvironmentMapping::equal_area, {8, 8}}}) {
        const EnvironmentLayout layout(of.mapping, of.size);
        const Image2<float> white = map_of(layout, [](const glm::dvec3&) { return 1; });
        EXPECT_NEAR(level_irradiance(white, layout)[0], kPi, 0.02 * kPi) << of.size[0];
    }
}

}  // namespace

}  // namespace skybake
