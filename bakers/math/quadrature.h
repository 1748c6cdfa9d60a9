// Points at which functions are sampled: Gauss-Legendre rules, adaptive quadrature, and
// low-discrepancy points.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace skybake {

// Gauss-Legendre quadrature on [0, 1].
struct QuadratureRule {
    std::vector<double> nodes;    // ascending, in (0, 1)
    std::vector<double> weights;  // positive, their sum is 1
};

// Returns the rule with `count` >= 1 nodes, which is exact for polynomials up to degree 2 count -
// 1. Nodes and weights are within 1e-15 and have the same bits on every machine.
QuadratureRule gauss_legendre(int count);

// Adaptive Gauss-Kronrod quadrature. It is slow, and accurate where its caller splits the interval
// at the kinks. The fast kernels are measured against it.

// Returns the integral of a vector-valued function from a to b. Intervals are halved until
// Kronrod's 15 points and Gauss's 7 agree within `relative` times the interval's own integral of
// |f| plus `absolute`, or until `depth` halvings have been made. f(x) returns a T, which holds
// nothing but doubles and has a subscript: an array or a vector of GLM.
template <class T, class Function>
T adaptive_integral(const Function& f, double a, double b, double relative, double absolute,
                    int depth = 30) {
    assert(relative >= 0 && absolute >= 0 && depth >= 0);
    // The nodes and weights are those of Kronrod 1965, as in QUADPACK's qk15.
    constexpr std::array<double, 8> kNodes = {
        0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
        0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
        0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
        0.207784955007898467600689403773245, 0.0};
    constexpr std::array<double, 8> kKronrod = {
        0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
        0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
        0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
        0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
    constexpr std::array<double, 4> kGauss = {
        0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
        0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

    constexpr std::size_t kCount = sizeof(T) / sizeof(double);
    const double center = 0.5 * (a + b);
    const double half_width = 0.5 * (b - a);
    T kronrod{};
    T gauss{};
    T size{};
    const auto add = [&](double x, double weight, double gauss_weight) {
        const T value = f(x);
        for (std::size_t c = 0; c < kCount; ++c) {
            kronrod[c] += weight * value[c];
            gauss[c] += gauss_weight * value[c];
            size[c] += weight * std::fabs(value[c]);
        }
    };
    for (std::size_t j = 0; j < kNodes.size(); ++j) {
        const double gauss_weight = j % 2 == 1 ? kGauss[j / 2] : 0.0;
        add(center - half_width * kNodes[j], kKronrod[j], gauss_weight);
        if (kNodes[j] > 0) add(center + half_width * kNodes[j], kKronrod[j], gauss_weight);
    }
    bool agree = true;
    for (std::size_t c = 0; c < kCount; ++c) {
        kronrod[c] *= half_width;
        const double difference = std::fabs(kronrod[c] - gauss[c] * half_width);
        agree = agree && difference <= relative * size[c] * std::fabs(half_width) + absolute;
    }
    if (agree || depth == 0) return kronrod;
    T sum = adaptive_integral<T>(f, a, center, relative, 0.5 * absolute, depth - 1);
    const T right = adaptive_integral<T>(f, center, b, relative, 0.5 * absolute, depth - 1);
    for (std::size_t c = 0; c < kCount; ++c) sum[c] += right[c];
    return sum;
}

// The fixed points at which errors are measured. They are the same in every run and on every
// machine.

// Points of the unit square that have the same y.
struct PointRow {
    double y = 0;
    std::vector<double> x;
};

// Returns rows * per_row points. The first rows, however many of them, are spread evenly in
// [0, 1)^2. The points are the additive recurrence with the plastic number (M. Roberts, "The
// unreasonable effectiveness of quasirandom sequences", 2018), with a counter of its own for each
// coordinate. With one point per row it is his sequence.
std::vector<PointRow> low_discrepancy_points(int rows, int per_row);

// Returns point `index` >= 0 of Roberts' sequence in three dimensions, in the unit cube [0, 1)^3.
std::array<double, 3> low_discrepancy_point(int index);

}  // namespace skybake
