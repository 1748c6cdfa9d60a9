#include "bakers/math/gauss_legendre.h"

#include <cmath>
#include <cstddef>

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

}  // namespace

QuadratureRule gauss_legendre(int count) {
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

}  // namespace skybake
