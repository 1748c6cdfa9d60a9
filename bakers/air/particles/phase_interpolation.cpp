#include "bakers/air/particles/phase_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

std::vector<double> logarithms(const std::vector<double>& values) {
    std::vector<double> result;
    result.reserve(values.size());
    for (const double value : values) result.push_back(logarithm(value));
    return result;
}

// Lagrange's polynomial through the six nodes about `position`, in units of their distance.
double interpolated(const std::vector<double>& nodes, double position) {
    const int last = static_cast<int>(nodes.size()) - 1;
    const int first = std::min(static_cast<int>(position) - 2, last - 5);
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
        double weight = 1;
        for (int j = 0; j < 6; ++j) {
            if (j != i) weight *= (position - (first + j)) / (i - j);
        }
        sum += weight * nodes[static_cast<std::size_t>(std::abs(first + i))];
    }
    return sum;
}

std::vector<double> middles_of(const std::vector<double>& values) {
    const std::vector<double> nodes = logarithms(values);
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        result.push_back(exponential(interpolated(nodes, static_cast<double>(i) + 0.5)));
    }
    return result;
}

double largest_difference(const std::vector<double>& before, const std::vector<double>& after) {
    double worst = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        worst = std::max(worst, std::fabs(after[i] - before[i]) / after[i]);
    }
    return worst;
}

std::vector<double> interleaved(const std::vector<double>& nodes,
                                const std::vector<double>& middles) {
    std::vector<double> result = {nodes.front()};
    for (std::size_t i = 0; i < middles.size(); ++i) {
        result.push_back(middles[i]);
        result.push_back(nodes[i + 1]);
    }
    return result;
}

}  // namespace

double largest_difference(const PhaseHalves& before, const PhaseHalves& after) {
    return std::max(largest_difference(before.forward, after.forward),
                    largest_difference(before.backward, after.backward));
}

PhaseHalves interpolated_middles(const PhaseHalves& nodes) {
    return {middles_of(nodes.forward), middles_of(nodes.backward)};
}

PhaseHalves interleaved(const PhaseHalves& nodes, const PhaseHalves& middles) {
    return {interleaved(nodes.forward, middles.forward),
            interleaved(nodes.backward, middles.backward)};
}

PhaseInterpolation::PhaseInterpolation(const PhaseHalves& nodes)
    : logarithms_{logarithms(nodes.forward), logarithms(nodes.backward)} {}

std::vector<double> PhaseInterpolation::values(const std::vector<ScatteringAngle>& angles) const {
    std::vector<double> result;
    result.reserve(angles.size());
    for (const auto& [one_minus, one_plus] : angles) {
        const bool forward = one_minus <= one_plus;
        const std::vector<double>& half = forward ? logarithms_.forward : logarithms_.backward;
        const double cells = static_cast<double>(half.size() - 1);
        const double root = std::sqrt(std::sqrt(forward ? one_minus : one_plus));
        result.push_back(exponential(interpolated(half, root * cells)));
    }
    return result;
}

}  // namespace skybake
