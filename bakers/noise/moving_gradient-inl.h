// The functions of moving_gradient.h for vectors of lattice points along x.
#if defined(SKYBAKE_BAKERS_NOISE_MOVING_GRADIENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_MOVING_GRADIENT_INL_H_
#undef SKYBAKE_BAKERS_NOISE_MOVING_GRADIENT_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_MOVING_GRADIENT_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/moving_gradient.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

struct MovingGradientVector {
    FloatVector x, y, z, rest;
};

HWY_INLINE MovingGradientVector gradient_at(const GradientBasis& time, const RowKeyVector& before,
                                            const RowKeyVector& after, WordVector scaled_x) {
    const Floats d;
    const Gradient4Vector near = lattice_gradient_4(before, scaled_x);
    const Gradient4Vector far = lattice_gradient_4(after, scaled_x);
    const auto blend = [](FloatVector a, FloatVector weight_a, FloatVector b, FloatVector weight_b)
                           HWY_ATTR { return hn::Add(hn::Mul(a, weight_a), hn::Mul(b, weight_b)); };
    const auto weight_0 = hn::Set(d, time.weight_0);
    const auto weight_1 = hn::Set(d, time.weight_1);
    return {blend(near.x, weight_0, far.x, weight_1), blend(near.y, weight_0, far.y, weight_1),
            blend(near.z, weight_0, far.z, weight_1),
            blend(near.t, hn::Set(d, time.distance_0), far.t, hn::Set(d, time.distance_1))};
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_MOVING_GRADIENT_INL_H_
