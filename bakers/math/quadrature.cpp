#include "bakers/math/quadrature.h"

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

struct Legendre {
    double value;
    double derivative;
};

// P_n and P_n' by Bonnet's recurrence.
Legendre legendre(int n, double x) {
    double previous = 1;
    double current = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
        previous = current;
        current = next;
    }
    return {current, n * (x * current - previous) / (x * x - 1)};
}

double member(double step, int index) {
    const double sum = 0.5 + step * (index + 1);
    return sum - std::floor(sum);
}

}  // namespace

QuadratureRule gauss_legendre(int count) {
    assert(count >= 1);
    const auto size = static_cast<std::size_t>(count);
    QuadratureRule rule{std::vector<double>(size, 0.5), std::vector<double>(size, 1.0)};
    if (count == 1) return rule;
    for (int i = 0; i < (count + 1) / 2; ++i) {
        // Tricomi's first approximation to the i-th root; Newton's method doubles its digits.
        double x = cosine_of_pi((i + 0.75) / (count + 0.5));
        for (int step = 0; step < 6; ++step) {
            const Legendre p = legendre(count, x);
            x -= p.value / p.derivative;
        }
        if (2 * i + 1 == count) x = 0;
        const double slope = legendre(count, x).derivative;
        const double weight = 1 / ((1 - x * x) * slope * slope);
        const auto low = static_cast<std::size_t>(i);
        rule.nodes[low] = 0.5 - 0.5 * x;
        rule.nodes[size - 1 - low] = 0.5 + 0.5 * x;
        rule.weights[low] = rule.weights[size - 1 - low] = weight;
    }
    return rule;
}

std::vector<PointRow> low_discrepancy_points(int rows, int per_row) {
    assert(rows >= 0 && per_row >= 0);
    // 1 / g and 1 / g^2, g = 1.3247... the real root of g^3 = g + 1.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    std::vector<PointRow> points;
    for (int j = 0; j < rows; ++j) {
        PointRow row{member(kStepY, j), {}};
        for (int k = 0; k < per_row; ++k) row.x.push_back(member(kStepX, j * per_row + k));
        points.push_back(std::move(row));
    }
    return points;
}

std::array<double, 3> low_discrepancy_point(int index) {
    assert(index >= 0);
    // Powers of 1 / g, g = 1.2207... the real root of g^4 = g + 1.
    return {member(0.8191725133961645, index), member(0.6710436067037893, index),
            member(0.5497004779019703, index)};
}

}  // namespace skybake
