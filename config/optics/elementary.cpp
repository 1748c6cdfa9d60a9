#include "config/optics/elementary.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace skybake::config {
namespace {

// ln 2 in two parts, the first of which has so few bits that its product with an exponent is exact.
constexpr double ln_2_high = 0x1.62e42feep-1;
constexpr double ln_2_low = 1.90821492927058770002e-10;

// e^x = (1 + rest) 2^doublings
struct Power {
    double rest = 0;
    int doublings = 0;
};

Power power_of_e(double x) {
    const double doublings = std::floor(x / std::numbers::ln2 + 0.5);
    const double r = (x - doublings * ln_2_high) - doublings * ln_2_low;
    double rest = 0;
    for (int k = 16; k >= 1; --k) rest = r / k * (1 + rest);
    return {rest, static_cast<int>(doublings)};
}

}  // namespace

double logarithm(double x) {
    assert(x > 0);
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < 1 / std::numbers::sqrt2) {
        mantissa *= 2;
        --exponent;
    }
    // ln m = 2 (s + s^3 / 3 + s^5 / 5 + ...) with s = (m - 1) / (m + 1), whose square is below 0.03.
    const double s = (mantissa - 1) / (mantissa + 1);
    const double square = s * s;
    double sum = 0;
    for (int k = 12; k >= 1; --k) sum = square * (1.0 / (2 * k + 1) + sum);
    return exponent * ln_2_high + (exponent * ln_2_low + 2 * s * sum + 2 * s);
}

double exponential(double x) {
    const Power power = power_of_e(x);
    return std::ldexp(1 + power.rest, power.doublings);
}

double exponential_less_one(double x) {
    if (x < -40) return -1;  // e^-40 is below half a unit in the last place of 1
    const Power power = power_of_e(x);
    // The difference is 0 where e^x is near 1, so that the rest keeps its digits.
    return std::ldexp(power.rest + (1 - std::ldexp(1, -power.doublings)), power.doublings);
}

double power(double base, double exponent) { return exponential(exponent * logarithm(base)); }

}  // namespace skybake::config
