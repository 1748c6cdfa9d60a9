// Computes a cellular octave's value from squared distances, for vectors.
#if defined(SKYBAKE_BAKERS_NOISE_CELL_VALUE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_CELL_VALUE_INL_H_
#undef SKYBAKE_BAKERS_NOISE_CELL_VALUE_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_CELL_VALUE_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/cell_value.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V cell_value(config::WorleyFeature feature, config::WorleyValue form, V first,
                        V second) {
    const hn::DFromV<V> d;
    const V one = hn::Set(d, 1.0f);
    if (needs_no_root(feature, form)) {
        const V squared = feature == config::WorleyFeature::f1 ? first : second;
        return hn::Max(hn::Zero(d), hn::Sub(one, squared));
    }
    V distance = hn::Sqrt(feature == config::WorleyFeature::f1 ? first : second);
    if (feature == config::WorleyFeature::f2_minus_f1) {
        distance = hn::Sub(distance, hn::Sqrt(first));
    }
    switch (form) {
        case config::WorleyValue::distance:
            return distance;
        case config::WorleyValue::one_minus_distance:
            return hn::Max(hn::Zero(d), hn::Sub(one, distance));
        case config::WorleyValue::one_minus_distance_over_sqrt3:
            return hn::Sub(one, hn::Mul(distance, hn::Set(d, kOneOverSqrt3)));
        case config::WorleyValue::one_minus_distance_squared:
            return hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(distance, distance)));
    }
    return distance;
}

// Distances of samples, at fractions of their cells along an axis, to the nearer face.
template <class V>
HWY_INLINE V distance_to_face(V fraction) {
    return hn::Min(fraction, hn::Sub(hn::Set(hn::DFromV<V>(), 1.0f), fraction));
}

// True if no point beyond `rings` rings of cells can be nearer to samples at a distance of `to_face`
// to the faces of their cells than points at these squared distances are. The slack is far above what
// rounding does.
template <class V>
HWY_INLINE bool is_within_rings(V squared, int rings, V to_face) {
    const hn::DFromV<V> d;
    const V reach = hn::Add(hn::Set(d, static_cast<float>(rings)), to_face);
    return hn::AllTrue(d, hn::Le(hn::Mul(squared, hn::Set(d, 1.00001f)), hn::Mul(reach, reach)));
}

template <class V>
struct GreatestBumpsVector {
    V first, second;

    HWY_INLINE void add(V squared_distance, V height) {
        const hn::DFromV<V> d;
        const V t = hn::Max(hn::Zero(d), hn::Sub(hn::Set(d, 1.0f), hn::Sqrt(squared_distance)));
        const V rise = hn::Mul(hn::Mul(t, t), hn::Sub(hn::Set(d, 3.0f), hn::Add(t, t)));
        const V bump = hn::Mul(height, rise);
        second = hn::Max(second, hn::Min(first, bump));
        first = hn::Max(first, bump);
    }
    HWY_INLINE V value() const { return hn::Sub(first, second); }
};

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_CELL_VALUE_INL_H_
