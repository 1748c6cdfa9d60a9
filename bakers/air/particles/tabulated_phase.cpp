#include "bakers/air/particles/tabulated_phase.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <numbers>

#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

constexpr int kFewestCells = 16;
constexpr int kMostCells = 1 << 13;

// 1 - nu of a node of the forward half, 1 + nu of one of the backward half.
double node_offset(int node, int cells) {
    const double w = static_cast<double>(node) / cells;
    return (w * w) * (w * w);
}

// p at `offset` from a half's pole.
double half_value(const std::vector<double>& half, int cells, double offset) {
    const double w = std::sqrt(std::sqrt(offset));
    // The root may round beyond the half's end or a node; the line is then continued by an ulp.
    const int cell = std::min(static_cast<int>(w * cells), cells - 1);
    const auto i = static_cast<std::size_t>(cell);
    const double from = node_offset(cell, cells);
    const double share = (offset - from) / (node_offset(cell + 1, cells) - from);
    return half[i] + share * (half[i + 1] - half[i]);
}

// The integral of p over the directions between the pole and each node.
std::vector<double> half_shares(const std::vector<double>& half) {
    const int cells = static_cast<int>(half.size()) - 1;
    std::vector<double> shares = {0};
    for (int j = 0; j < cells; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double width = node_offset(j + 1, cells) - node_offset(j, cells);
        shares.push_back(shares.back() + std::numbers::pi * width * (half[i] + half[i + 1]));
    }
    return shares;
}

// The distance from the pole within which `share` of all light is scattered.
double half_offset(const std::vector<double>& half, const std::vector<double>& shares,
                   double share) {
    const int cells = static_cast<int>(half.size()) - 1;
    const auto above = std::upper_bound(shares.begin() + 1, shares.end() - 1, share);
    const auto i = static_cast<std::size_t>(above - shares.begin()) - 1;
    const int cell = static_cast<int>(i);
    const double from = node_offset(cell, cells);
    const double width = node_offset(cell + 1, cells) - from;
    const double slope = (half[i + 1] - half[i]) / width;
    // p d + slope d^2 / 2 = rest, its smaller root without cancellation. Rounding of the shares
    // may ask for more than the cell has.
    const double rest = (share - shares[i]) / (2 * std::numbers::pi);
    const double root = std::sqrt(std::max(half[i] * half[i] + 2 * slope * rest, 0.0));
    return from + std::min(2 * rest / (half[i] + root), width);
}

// Legendre's polynomials at nu = 1 - offset times `weight`, added to the moments of the forward
// half; by their differences, which keep the digits of the offset.
void add_polynomials(double offset, double weight, std::vector<double>& sums) {
    double value = 1;
    double step = 0;
    sums[0] += weight;
    for (std::size_t l = 0; l + 1 < sums.size(); ++l) {
        const double order = static_cast<double>(l);
        step = (order * step - (2 * order + 1) * offset * value) / (order + 1);
        value += step;
        sums[l + 1] += weight * value;
    }
}

// 2 pi times the integrals of p P_l over one half, nu counted from its pole.
std::vector<double> half_moments(const std::vector<double>& half, int degree) {
    const int cells = static_cast<int>(half.size()) - 1;
    std::vector<double> sums(static_cast<std::size_t>(degree) + 1, 0.0);
    QuadratureRule rule;
    for (int j = 0; j < cells; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double from = node_offset(j, cells);
        const double width = node_offset(j + 1, cells) - from;
        // A line times P_l has degree l + 1. Where cells are narrow for P_l, which has a wave per
        // 2 pi / l of angle, fewer nodes do: for cos(t x) on [-1, 1] Gauss's rule of q nodes is off
        // by less than (e t / 4 q)^(2 q), below 1e-16 for q = 6 + t. The angle between nodes is
        // below that at 90 degrees, 4 / cells; t is half of it times l.
        const int enough = std::min((degree + 3) / 2, 6 + 2 * degree / cells + 1);
        if (static_cast<int>(rule.nodes.size()) != enough) rule = gauss_legendre(enough);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double share = rule.nodes[q];
            const double p = half[i] + share * (half[i + 1] - half[i]);
            add_polynomials(from + share * width,
                            2 * std::numbers::pi * width * rule.weights[q] * p, sums);
        }
    }
    return sums;
}

ScatteringAngle node_angle(double offset, bool backward) {
    return backward ? ScatteringAngle{2 - offset, offset} : ScatteringAngle{offset, 2 - offset};
}

// The values at every step-th node of `cells`, from the first-th on.
PhaseHalves values_at(const PhaseAtAngles& values, int cells, int first, int step) {
    std::vector<ScatteringAngle> angles;
    for (const bool backward : {false, true}) {
        for (int i = first; i <= cells; i += step) {
            angles.push_back(node_angle(node_offset(i, cells), backward));
        }
    }
    const std::vector<double> both = values(angles);
    const auto middle = both.begin() + static_cast<std::ptrdiff_t>(both.size() / 2);
    return {{both.begin(), middle}, {middle, both.end()}};
}

// The largest relative error of a half's interpolation at the middles of its cells.
double middle_error(const std::vector<double>& half, const std::vector<double>& middles) {
    const int cells = static_cast<int>(middles.size());
    double worst = 0;
    for (int i = 0; i < cells; ++i) {
        const double offset = node_offset(2 * i + 1, 2 * cells);
        const double middle = middles[static_cast<std::size_t>(i)];
        const double error = half_value(half, cells, offset) - middle;
        worst = std::max(worst, std::fabs(error) / middle);
    }
    return worst;
}

std::vector<double> interleaved(const std::vector<double>& nodes,
                                const std::vector<double>& middles) {
    assert(nodes.size() == middles.size() + 1);
    std::vector<double> result = {nodes.front()};
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        result.push_back(middles[i]);
        result.push_back(nodes[i + 1]);
    }
    return result;
}

void add_half(double weight, const std::vector<double>& half, std::vector<double>& sum) {
    const int cells = static_cast<int>(sum.size()) - 1;
    const int own_cells = static_cast<int>(half.size()) - 1;
    for (int i = 0; i <= cells; ++i) {
        sum[static_cast<std::size_t>(i)] +=
            weight * half_value(half, own_cells, node_offset(i, cells));
    }
}

std::vector<double> logarithms(const std::vector<double>& values) {
    return mapped<double>(values, [](double value) { return logarithm(value); });
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
        worst = std::max(worst, relative_change(before[i], after[i]));
    }
    return worst;
}

}  // namespace

TabulatedPhase normalised_phase(std::vector<double> forward, std::vector<double> backward) {
    assert(forward.size() >= 2 && forward.size() == backward.size());
    TabulatedPhase phase;
    phase.cells = static_cast<int>(forward.size()) - 1;
    const double total = half_shares(forward).back() + half_shares(backward).back();
    for (double& p : forward) p /= total;
    for (double& p : backward) p /= total;
    phase.forward_share = half_shares(forward);
    phase.backward_share = half_shares(backward);
    phase.forward = std::move(forward);
    phase.backward = std::move(backward);
    return phase;
}

std::shared_ptr<const TabulatedPhase> mixed_phase(std::span<const WeightedPhase> phases) {
    assert(!phases.empty());
    if (phases.size() == 1) return phases.front().phase;
    int cells = 0;
    for (const WeightedPhase& one : phases) cells = std::max(cells, one.phase->cells);
    std::vector<double> forward(static_cast<std::size_t>(cells) + 1, 0.0);
    std::vector<double> backward = forward;
    for (const auto& [weight, phase] : phases) {
        add_half(weight, phase->forward, forward);
        add_half(weight, phase->backward, backward);
    }
    return std::make_shared<const TabulatedPhase>(
        normalised_phase(std::move(forward), std::move(backward)));
}

double tabulated_phase_value(const TabulatedPhase& phase, double one_minus_cosine,
                             double one_plus_cosine) {
    return one_minus_cosine <= one_plus_cosine
               ? half_value(phase.forward, phase.cells, one_minus_cosine)
               : half_value(phase.backward, phase.cells, one_plus_cosine);
}

std::vector<double> tabulated_moments(const TabulatedPhase& phase, int degree) {
    assert(degree >= 0);
    std::vector<double> moments = half_moments(phase.forward, degree);
    const std::vector<double> backward = half_moments(phase.backward, degree);
    for (std::size_t l = 0; l < moments.size(); ++l) {
        moments[l] += l % 2 == 0 ? backward[l] : -backward[l];
    }
    return moments;
}

ScatteringAngle sample_tabulated_phase(const TabulatedPhase& phase, double share) {
    assert(share >= 0 && share < 1);
    if (share < phase.forward_share.back()) {
        return node_angle(half_offset(phase.forward, phase.forward_share, share), false);
    }
    return node_angle(half_offset(phase.backward, phase.backward_share, 1 - share), true);
}

MeasuredPhase make_tabulated_phase(const PhaseAtAngles& values, double bound) {
    PhaseHalves nodes = values_at(values, kFewestCells, 0, 1);
    for (int cells = kFewestCells;; cells *= 2) {
        const PhaseHalves middles = values_at(values, 2 * cells, 1, 2);
        const double error = std::max(middle_error(nodes.forward, middles.forward),
                                      middle_error(nodes.backward, middles.backward));
        if (error <= bound || cells == kMostCells) {
            return {normalised_phase(std::move(nodes.forward), std::move(nodes.backward)), error};
        }
        nodes = interleaved(nodes, middles);
    }
}

double largest_difference(const PhaseHalves& before, const PhaseHalves& after) {
    assert(before.forward.size() == after.forward.size());
    assert(before.backward.size() == after.backward.size());
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
