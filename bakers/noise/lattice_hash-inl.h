// The functions of lattice_hash.h for vectors of lattice points along x.
#if defined(SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#undef SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/lattice_hash.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using WordVector = hn::Vec<Words>;

HWY_INLINE WordVector mix32(WordVector h) {
    const Words d;
    h = hn::Mul(hn::Xor(h, hn::ShiftRight<16>(h)), hn::Set(d, 0x7feb352du));
    h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(d, 0x846ca68bu));
    return hn::Xor(h, hn::ShiftRight<16>(h));
}

// `scaled_x` is x * kGolden32.
HWY_INLINE WordVector lattice_hash(RowKey row, WordVector scaled_x) {
    const Words d;
    return mix32(hn::Xor(mix32(hn::Add(scaled_x, hn::Set(d, row.low))), hn::Set(d, row.high)));
}

struct GradientVector {
    FloatVector x, y, z;
};

HWY_INLINE GradientVector lattice_gradient(RowKey row, WordVector scaled_x) {
    const Words d;
    const Floats df;
    const WordVector h = lattice_hash(row, scaled_x);
    const WordVector zero_axis = hn::ShiftRight<16>(hn::Mul(hn::ShiftRight<16>(h), hn::Set(d, 3u)));
    const WordVector one = hn::BitCast(d, hn::Set(df, 1.0f));
    const WordVector first = hn::Or(one, hn::ShiftLeft<31>(h));
    const WordVector second = hn::Or(one, hn::And(hn::ShiftLeft<30>(h), hn::Set(d, 0x80000000u)));
    const auto is_0 = hn::Eq(zero_axis, hn::Zero(d));
    const auto is_1 = hn::Eq(zero_axis, hn::Set(d, 1u));
    const auto is_2 = hn::Eq(zero_axis, hn::Set(d, 2u));
    const WordVector x = hn::IfThenZeroElse(is_0, first);
    const WordVector y = hn::IfThenZeroElse(is_1, hn::IfThenElse(is_0, first, second));
    const WordVector z = hn::IfThenZeroElse(is_2, second);
    return {hn::BitCast(df, x), hn::BitCast(df, y), hn::BitCast(df, z)};
}

HWY_INLINE FloatVector unit_float(WordVector h) {
    const Floats df;
    const hn::RebindToSigned<Floats> di;
    return hn::Mul(hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<8>(h))), hn::Set(df, 0x1p-24f));
}

struct CellPointVector {
    FloatVector x, y, z;
};

HWY_INLINE CellPointVector cell_point(RowKey row, WordVector scaled_x) {
    const Words d;
    const WordVector low = hn::Set(d, row.low);
    const WordVector high = hn::Set(d, row.high);
    const WordVector a = mix32(hn::Xor(mix32(hn::Add(scaled_x, low)), high));
    const WordVector b = mix32(hn::Xor(mix32(hn::Add(scaled_x, high)), low));
    const WordVector c = mix32(hn::Xor(hn::Add(a, hn::Set(d, kGolden32)), hn::ShiftLeft<1>(b)));
    return {unit_float(a), unit_float(b), unit_float(c)};
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
