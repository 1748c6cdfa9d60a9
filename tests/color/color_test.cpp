// The observer, the sun's spectrum and colour spaces, against what others published of them.
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <vector>

#include "bakers/color/color_space.h"
#include "bakers/color/observer.h"
#include "bakers/color/spectral_color.h"

namespace skybake {

namespace {

// The chromaticity of XYZ, whose sum is not 0.
glm::dvec2 chromaticity_of(glm::dvec3 xyz) {
    return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

// CIE standard illuminant D65 from 360 to 830 nm every 10 nm (CIE 015:2018), linear between.
constexpr std::array kD65 = {
    46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008,
    117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.79,  107.689, 104.405, 104.046,
    100.0,   96.3342, 95.788,  88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
    80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,  61.604,  69.8856, 75.087,  63.5927,
    46.4182, 66.8054, 63.3828, 64.304,  59.4519, 51.959,  57.4406, 60.3125};

std::vector<double> wavelengths(double first_nm, double step_nm, std::size_t count) {
    std::vector<double> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = first_nm + step_nm * static_cast<double>(i);
    return all;
}

glm::dvec3 sum_of_matching_functions() {
    glm::dvec3 sum(0);
    for (const double nm : wavelengths(360, 5, 95)) sum += color_matching(nm);
    return sum * 5.0;
}

void expect_near(glm::dvec3 actual, glm::dvec3 expected, double tolerance) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << i;
}

// CIE states these sums of the 1-nm table; those of the 5-nm table are within 0.001 of them.
TEST(Observer, SeesEqualEnergyAsWhite) {
    expect_near(sum_of_matching_functions(), glm::dvec3(106.8655, 106.8569, 106.8923), 0.0015);
    const glm::dvec2 white = chromaticity_of(sum_of_matching_functions());
    EXPECT_NEAR(white.x, 1.0 / 3, 5e-5);
    EXPECT_NEAR(white.y, 1.0 / 3, 5e-5);
}

TEST(Observer, SeesNothingBeyondTheVisible) {
    EXPECT_EQ(color_matching(359.9), glm::dvec3(0));
    EXPECT_EQ(color_matching(830.1), glm::dvec3(0));
    EXPECT_GT(color_matching(830).y, 0);
}

// ybar is 1 at 555 nm; xbar has its maxima at 440 and 600 nm, zbar at 445 nm; crossings of CIE
// 1931.
TEST(Observer, HasItsMaximaWhereCieHasThem) {
    double best = 0, at = 0;
    for (const double nm : wavelengths(360, 1, 471))
        if (color_matching(nm).y > best) best = color_matching(nm).y, at = nm;
    EXPECT_EQ(at, 555);
    EXPECT_EQ(best, 1);
    EXPECT_NEAR(color_matching(600).x, 1.0622, 1e-12);
    EXPECT_NEAR(color_matching(445).z, 1.7826, 1e-12);
    EXPECT_NEAR(color_matching(442.5).z, (1.74706 + 1.78260) / 2, 1e-12);
}

// No typing error of a percent stays unseen: each row is near the parabola through its neighbours.
TEST(Observer, IsSmooth) {
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (double nm = 370; nm <= 820; nm += 5) {
            const auto value = [&](double at) { return color_matching(at)[channel]; };
            const double guess =
                (4 * (value(nm - 5) + value(nm + 5)) - value(nm - 10) - value(nm + 10)) / 6;
            EXPECT_NEAR(value(nm), guess, 0.012 + 0.03 * value(nm)) << channel << ' ' << nm;
        }
}

// x 0.31272, y 0.32903: CIE 015:2018, table 11.3.
TEST(Observer, SeesD65WhereCieHasIt) {
    const ColorTarget target{ColorSpace::xyz, White::own, Sunlight::flat};
    const auto nm = wavelengths(360, 10, kD65.size());
    const glm::dvec2 white = chromaticity_of(color_of(nm, kD65, target));
    EXPECT_NEAR(white.x, 0.31272, 3e-5);
    EXPECT_NEAR(white.y, 0.32903, 3e-5);
}

double solar_integral(double from_nm, double to_nm) {
    double sum = 0;
    constexpr double kStep = 0.5;
    for (double nm = from_nm + kStep / 2; nm < to_nm; nm += kStep)
        sum += solar_irradiance_W_per_m2_nm(nm) * kStep;
    return sum;
}

// The means over 10 nm of the same spectrum (ASTM G173, outside the air) as E. Bruneton published
// them in 2017, an independent copy: 360, 370 ... 820 nm.
TEST(SolarSpectrum, AgreesWithAnotherCopy) {
    constexpr std::array kMeans = {
        1.11776, 1.14259, 1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474,
        2.02042, 2.02212, 1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,  1.85149, 1.8504,
        1.8341,  1.8345,  1.8147,  1.78158, 1.7533,  1.6965,  1.68194, 1.64654, 1.6048,  1.52143,
        1.55622, 1.5113,  1.474,   1.4482,  1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758,
        1.2367,  1.2082,  1.18737, 1.14683, 1.12362, 1.1058,  1.07124};
    const auto mean = [&](std::size_t first, std::size_t count) {
        double sum = 0;
        for (std::size_t i = first; i < first + count; ++i)
            sum += kMeans[i] / static_cast<double>(count);
        return sum;
    };
    const auto expect_mean = [&](std::size_t first, std::size_t count, double tolerance) {
        const double from = 360 + 10 * static_cast<double>(first);
        const double width = 10 * static_cast<double>(count);
        EXPECT_NEAR(solar_integral(from, from + width) / width / mean(first, count), 1, tolerance)
            << from;
    };
    // A line at the border of two means is shared between them.
    for (std::size_t i = 0; i < kMeans.size(); ++i) expect_mean(i, 1, i < 16 ? 0.07 : 0.015);
    for (std::size_t i = 0; i + 5 <= kMeans.size(); ++i) expect_mean(i, 5, 0.015);
    expect_mean(0, kMeans.size(), 0.0005);
}

TEST(SolarSpectrum, HasItsShareOfTheSolarConstant) {
    // Gueymard 2004: 48 % of 1366.1 W/m^2 between 380 and 780 nm.
    EXPECT_NEAR(solar_integral(380, 780), 0.480 * 1366.1, 0.002 * 1366.1);
    EXPECT_EQ(solar_irradiance_W_per_m2_nm(359), 0);
    for (double nm = 360; nm <= 830; nm += 2.5) EXPECT_GT(solar_irradiance_W_per_m2_nm(nm), 0.7);
}

// 133.1 klx: CIE's and IES' solar illuminance constants lie between 127.5 (1979) and 133.8 klx.
TEST(SolarSpectrum, LightsTheTopOfTheAir) { EXPECT_NEAR(solar_illuminance_lux(), 133.1e3, 0.1e3); }

TEST(SolarSpectrum, HasTheSunsColor) {
    const glm::dvec2 sun = chromaticity_of(sun_xyz(Sunlight::measured));
    EXPECT_NEAR(sun.x, 0.3231, 0.0005);
    EXPECT_NEAR(sun.y, 0.3326, 0.0005);
    const glm::dvec2 flat = chromaticity_of(sun_xyz(Sunlight::flat));
    EXPECT_NEAR(flat.x, 1.0 / 3, 1e-4);
}

// GLM's matrices take columns, so published rows are transposed.
glm::dmat3 rows(std::array<double, 9> r) {
    return {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
}

void expect_near(const glm::dmat3& actual, const glm::dmat3& expected, double tolerance) {
    for (std::size_t column = 0; column < 3; ++column)
        expect_near(actual[column], expected[column], tolerance);
}

// IEC 61966-2-1:1999 amendment 1; ITU-R BT.2087; S-2014-004 (AP1).
TEST(ColorSpace, HasThePublishedMatrices) {
    expect_near(from_xyz(ColorSpace::linear_srgb),
                rows({3.2406255, -1.5372080, -0.4986286, -0.9689307, 1.8757561, 0.0415175,
                      0.0557101, -0.2040211, 1.0569959}),
                4e-4);
    expect_near(to_xyz(ColorSpace::linear_srgb),
                rows({0.412391, 0.357584, 0.180481, 0.212639, 0.715169, 0.072192, 0.019331,
                      0.119195, 0.950532}),
                1e-6);
    expect_near(
        to_xyz(ColorSpace::rec2020),
        rows({0.636958, 0.144617, 0.168881, 0.262700, 0.677998, 0.059302, 0, 0.028073, 1.060985}),
        1e-6);
    expect_near(to_xyz(ColorSpace::acescg),
                rows({0.6624542, 0.1340042, 0.1561877, 0.2722287, 0.6740818, 0.0536895, -0.0055746,
                      0.0040607, 1.0103391}),
                1e-6);
    expect_near(
        to_xyz(ColorSpace::display_p3),
        rows({0.486571, 0.265668, 0.198217, 0.228975, 0.691739, 0.079287, 0, 0.045113, 1.043944}),
        1e-6);
}

// From D65 to D50 as lindbloom.com states it for these whites.
TEST(ColorSpace, AdaptsAsBradford) {
    expect_near(bradford({0.95047, 1, 1.08883}, {0.96422, 1, 0.82521}),
                rows({1.0478112, 0.0228866, -0.0501270, 0.0295424, 0.9904844, -0.0170491,
                      -0.0092345, 0.0150436, 0.7521316}),
                1e-5);
}

TEST(ColorSpace, TakesItsWhiteToOnes) {
    for (const ColorSpace space : all_color_spaces()) {
        const glm::dvec3 white = xyz_of(primaries_of(space).white);
        expect_near(from_xyz(space) * white, glm::dvec3(1), 1e-12);
        expect_near(from_xyz(space) * to_xyz(space), glm::dmat3(1), 1e-12);
    }
}

TEST(ColorSpace, ShowsTheSunAsItsConventionSays) {
    const auto nm = wavelengths(400, 37, 9);
    const std::vector<double> ones(nm.size(), 1.0), halves(nm.size(), 0.5);
    for (const ColorSpace space : all_color_spaces())
        for (const Sunlight sunlight : {Sunlight::measured, Sunlight::flat}) {
            const ColorTarget target{space, White::sun, sunlight};
            expect_near(color_of(nm, ones, target), glm::dvec3(1), 1e-12);
            expect_near(color_of(nm, halves, target), glm::dvec3(0.5), 1e-12);
        }
    // With the space's own white, the sun has its own colour and the luminance 1.
    const glm::dvec3 warm = color_of(nm, ones, {ColorSpace::linear_srgb, White::own});
    EXPECT_GT(warm.r, warm.g);
    EXPECT_GT(warm.g, warm.b);
    EXPECT_NEAR(glm::dvec3(to_xyz(ColorSpace::linear_srgb) * warm).y, 1, 1e-12);
}

// A spectrum that is linear between 5-nm nodes has the same colour from many wavelengths or few.
TEST(SpectralColor, IntegratesWhatLiesBetweenWavelengths) {
    const ColorTarget target{ColorSpace::rec2020, White::own};
    const std::array few = {360.0, 500.0, 830.0};
    const std::array values = {2.0, 0.3, 1.1};
    std::vector<double> fine = wavelengths(360, 1, 471), between(fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i)
        between[i] = fine[i] < 500 ? 2 + (0.3 - 2) * (fine[i] - 360) / 140
                                   : 0.3 + 0.8 * (fine[i] - 500) / 330;
    expect_near(color_of(few, values, target), color_of(fine, between, target), 1e-12);
}

TEST(SpectralColor, IsConstantBeyondTheWavelengthsThatAreKnown) {
    const ColorTarget target{ColorSpace::acescg, White::sun};
    const std::vector<double> known = {440, 680}, all = {360, 440, 680, 830};
    const std::vector<double> values = {3, 1}, extended = {3, 3, 1, 1};
    expect_near(color_of(known, values, target), color_of(all, extended, target), 1e-12);
}

// Against a plain sum every 0.1 nm, which shares nothing but the tables.
TEST(SpectralColor, AgreesWithAPlainSum) {
    const auto radiance = [](double nm) { return std::pow(550 / nm, 4); };
    const auto nm = wavelengths(360, 5, 95);
    std::vector<double> values(nm.size());
    for (std::size_t i = 0; i < nm.size(); ++i) values[i] = radiance(nm[i]);
    glm::dvec3 sum(0);
    double norm = 0;
    for (double at = 360.05; at < 830; at += 0.1) {
        const glm::dvec3 seen = color_matching(at) * solar_irradiance_W_per_m2_nm(at);
        sum += seen * radiance(at);
        norm += seen.y;
    }
    const glm::dvec3 xyz = color_of(nm, values, {ColorSpace::xyz, White::own});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i] / (sum[i] / norm), 1, 4e-4);
}

// So that no digit of the tables changes unseen: the sums of the logarithms of their values.
TEST(TypedTables, OfObserverAndSun) {
    glm::dvec3 observer(0);
    double sun = 0;
    for (const double nm : wavelengths(360, 5, 95)) {
        for (std::size_t i = 0; i < 3; ++i)
            if (color_matching(nm)[i] > 0) observer[i] += std::log(color_matching(nm)[i]);
        sun += std::log(solar_irradiance_W_per_m2_nm(nm));
    }
    expect_near(observer, glm::dvec3(-404.7385, -485.0170, -228.0172), 1e-3);
    EXPECT_NEAR(sun, 39.88156, 1e-4);
}

const std::vector<double> kWavelengths = {637, 446, 576, 525};  // in any order

// Samples whose colours are sums with known weights.
std::vector<ColorSample> samples_of(const std::vector<glm::dvec3>& weights) {
    std::vector<ColorSample> samples;
    for (int i = 0; i < 40; ++i) {
        ColorSample sample;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            sample.light.push_back(1 + std::sin(1.3 * i * (static_cast<double>(k) + 1)));
            sample.color += sample.light.back() * weights[k];
        }
        sample.weight = 1;
        samples.push_back(sample);
    }
    return samples;
}

TEST(FitColorWeights, FindsTheWeightsThatMadeTheSamples) {
    const std::vector<glm::dvec3> weights = {
        {0.6, -0.1, 0.01}, {0.1, -0.07, 0.99}, {0.9, 0.3, -0.1}, {-0.6, 0.8, 0.1}};
    const std::vector<glm::dvec3> found = fit_color_weights(kWavelengths, samples_of(weights), {});
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_LT(glm::length(found[i] - weights[i]), 1e-5) << i;
    }
}

TEST(FitColorWeights, WithoutSamplesTheyAreThoseOfLines) {
    const std::vector<double> ascending = {446, 525, 576, 637};
    const std::vector<glm::dvec3> lines = color_weights(ascending, {});
    const std::vector<glm::dvec3> found = fit_color_weights(kWavelengths, {}, {});
    EXPECT_EQ(found[0], lines[3]);
    EXPECT_EQ(found[1], lines[0]);
}

TEST(FitColorWeights, EqualWavelengthsShareTheirWeight) {
    const std::vector<glm::dvec3> one = fit_color_weights(std::vector{500.0, 600.0}, {}, {});
    const std::vector<glm::dvec3> two = fit_color_weights(std::vector{500.0, 600.0, 500.0}, {}, {});
    EXPECT_LT(glm::length(two[0] + two[2] - one[0]), 1e-15);
}

}  // namespace

}  // namespace skybake
