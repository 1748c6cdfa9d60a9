#include "bakers/noise/gradient_basis.h"

namespace skybake::noise {

namespace {

double fade(double u) { return u * u * u * (u * (6 * u - 15) + 10); }
double fade_derivative(double u, double one_minus_u) {
    const double product = u * one_minus_u;
    return 30 * product * product;
}

// u and 1 - u, each with all its digits.
struct Fraction {
    double u = 0;
    double one_minus_u = 0;
};

Fraction fraction_of(const LatticePosition& position) {
    const auto denominator = static_cast<double>(position.denominator);
    return {static_cast<double>(position.numerator) / denominator,
            static_cast<double>(position.denominator - position.numerator) / denominator};
}

}  // namespace

GradientBasis gradient_basis(const LatticePosition& position) {
    const auto [u, one_minus_u] = fraction_of(position);
    const double weight_0 = fade(one_minus_u);  // 1 - fade(u), without the cancellation
    const double weight_1 = fade(u);
    return {static_cast<float>(weight_0), static_cast<float>(weight_1),
            static_cast<float>(u * weight_0), static_cast<float>(-one_minus_u * weight_1)};
}

GradientBasis gradient_basis_derivative(const LatticePosition& position) {
    const auto [u, one_minus_u] = fraction_of(position);
    const double slope = fade_derivative(u, one_minus_u);
    return {static_cast<float>(-slope), static_cast<float>(slope),
            static_cast<float>(fade(one_minus_u) - u * slope),
            static_cast<float>(fade(u) - one_minus_u * slope)};
}

}  // namespace skybake::noise
