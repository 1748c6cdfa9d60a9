#include "bakers/math/transcendental.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/math/transcendental.cpp"
#include <hwy/foreach_target.h>

#include "bakers/math/channels-inl.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

void Exponentials(double* values, int count) {
    constexpr int kLanes = LaneAccess<Lanes>::kCount;
    int i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        exponential(Lanes::load(values + i)).store(values + i);
    }
    for (; i < count; ++i) values[i] = exponential(values[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(Exponentials);

double exponential(double x) { return HWY_NAMESPACE::exponential(x); }
HWY_NAMESPACE::Channels exponential(const HWY_NAMESPACE::Channels& x) {
    return HWY_NAMESPACE::exponential(x);
}
Spectrum exponential(const Spectrum& x) {
    return HWY_NAMESPACE::exponential(HWY_NAMESPACE::Channels(x)).spectrum();
}
double logarithm(double x) { return HWY_NAMESPACE::logarithm(x); }
double arc_cosine(double x) { return HWY_NAMESPACE::arc_cosine(x); }
double cosine_of_pi(double x) { return HWY_NAMESPACE::cosine_of_pi(x); }

double cosine_of_turns(double n) {
    const double within = n - std::floor(n);
    return cosine_of_pi(2 * (within < 0.5 ? within : 1 - within));
}

SineCosine sine_and_cosine(double x) {
    // x = n pi / 2 + r, |r| <= pi / 4 (1 + 2^-30). pi / 2 in three parts of 33 bits: n has at most
    // 20, so that the products are exact, and so is the first difference, whose bits lie between
    // those of x and 1; the others round once each. What the parts leave out of pi / 2 is below
    // 2^-103.
    constexpr double kHigh = 0x1.921fb544p0;
    constexpr double kMiddle = 0x1.0b4611a6p-34;
    constexpr double kLow = 0x1.3198a2ep-69;
    const double n = std::floor(x * 0.63661977236758134308 + 0.5);
    const double r = ((x - n * kHigh) - n * kMiddle) - n * kLow;
    const double z = r * r;
    // The Taylor series are truncated; their errors start at (pi/4)^19 / 19! and (pi/4)^18 / 18! <
    // 3e-18.
    double s = 1.0 / 355687428096000.0;
    s = s * z - 1.0 / 1307674368000.0;
    s = s * z + 1.0 / 6227020800.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    double c = 1.0 / 20922789888000.0;
    c = c * z - 1.0 / 87178291200.0;
    c = c * z + 1.0 / 479001600.0;
    c = c * z - 1.0 / 3628800.0;
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    c = c * z - 0.5;
    const double sine = r + r * (z * s);
    const double cosine = 1.0 + z * c;
    switch (static_cast<int>(n) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

void exponentials(double* values, int count) { HWY_DYNAMIC_DISPATCH(Exponentials)(values, count); }

}  // namespace skybake
#endif  // HWY_ONCE
