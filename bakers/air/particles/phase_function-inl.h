// The functions of phase_function.h for vectors of angles, of doubles or of floats.
#if defined(SKYBAKE_BAKERS_AIR_PHASE_FUNCTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_AIR_PHASE_FUNCTION_INL_H_
#undef SKYBAKE_BAKERS_AIR_PHASE_FUNCTION_INL_H_
#else
#define SKYBAKE_BAKERS_AIR_PHASE_FUNCTION_INL_H_
#endif

#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Returns (1 + g^2 - 2 g nu)^(3/2) without the cancellation that this formula has where g is near 1
// and the light goes on almost straight.
template <class Real>
HWY_INLINE Real henyey_greenstein_denominator(typename LaneAccess<Real>::Number g, Real one_minus,
                                              Real one_plus) {
    const auto size = absolute(g);
    const Real base =
        Real((1 - size) * (1 - size)) + Real(2 * size) * (g < 0 ? one_plus : one_minus);
    return base * square_root(base);
}

// Returns p = (a + b nu^2) / (1 + g^2 - 2 g nu)^(3/2).
template <class Real>
HWY_INLINE Real closed_phase_value(typename LaneAccess<Real>::Number a,
                                   typename LaneAccess<Real>::Number b,
                                   typename LaneAccess<Real>::Number g, Real one_minus,
                                   Real one_plus) {
    const Real cosine = Real(0.5F) * (one_plus - one_minus);
    return (Real(a) + Real(b) * cosine * cosine) /
           henyey_greenstein_denominator(g, one_minus, one_plus);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_AIR_PHASE_FUNCTION_INL_H_
