#include "bakers/color/color_weights_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace skybake {
namespace {

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
