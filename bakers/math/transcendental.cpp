#include "bakers/math/transcendental.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/math/transcendental.cpp"
#include <hwy/foreach_target.h>

#include "bakers/math/channels-inl.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

void Exponentials(double* values, int count) {
    constexpr int kLanes = LaneAccess<Lanes>::kCount;
    int i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        exponential(Lanes::load(values + i)).store(values + i);
    }
    for (; i < count; ++i) values[i] = exponential(values[i]);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(Exponentials);

double exponential(double x) { return HWY_NAMESPACE::exponential(x); }
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
    SineCosine result;
    HWY_NAMESPACE::sine_and_cosine(x, result.sine, result.cosine);
    return result;
}

void exponentials(double* values, int count) { HWY_DYNAMIC_DISPATCH(Exponentials)(values, count); }

}  // namespace skybake
#endif  // HWY_ONCE
