// The functions of lattice_hash.h for vectors of lattice points along x.
#if defined(SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#undef SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using WordVector = hn::Vec<Words>;
constexpr Floats kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
static_assert(kLanes <= static_cast<std::size_t>(kLanePadding));

template <std::size_t kCount, class Step>
HWY_INLINE void for_each(const Step& step) {
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < kCount; ++i) step(i);
}

template <std::size_t kCount>
HWY_INLINE void mix32(WordVector (&words)[kCount]) {
    const Words d;
    for_each<kCount>([&](std::size_t i) HWY_ATTR {
        words[i] =
            hn::Mul(hn::Xor(words[i], hn::ShiftRight<16>(words[i])), hn::Set(d, 0x7feb352du));
    });
    for_each<kCount>([&](std::size_t i) HWY_ATTR {
        words[i] =
            hn::Mul(hn::Xor(words[i], hn::ShiftRight<15>(words[i])), hn::Set(d, 0x846ca68bu));
    });
    for_each<kCount>([&](std::size_t i)
                         HWY_ATTR { words[i] = hn::Xor(words[i], hn::ShiftRight<16>(words[i])); });
}

HWY_INLINE WordVector mix32(WordVector h) {
    WordVector one[] = {h};
    mix32(one);
    return one[0];
}

using Integers = hn::RebindToSigned<Floats>;
using IntegerVector = hn::Vec<Integers>;

// The cells `offset` beyond those of a vector of voxels, wrapped and scaled for their hash. Cells are
// in [0, 2 frequency), |offset| at most 2.
HWY_INLINE WordVector scaled_neighbours(IntegerVector cell, int offset, int frequency) {
    const Integers integers;
    const Words words;
    const auto period = hn::Set(integers, frequency);
    const auto first = hn::IfThenElse(hn::Lt(cell, period), cell, hn::Sub(cell, period));
    auto x = hn::Add(first, hn::Set(integers, offset));
    for (int beyond = 0; beyond > offset; --beyond) {
        x = hn::IfThenElse(hn::Lt(x, hn::Zero(integers)), hn::Add(x, period), x);
    }
    for (int beyond = 0; beyond < offset; ++beyond) {
        x = hn::IfThenElse(hn::Lt(x, period), x, hn::Sub(x, period));
    }
    return hn::Mul(hn::BitCast(words, x), hn::Set(words, kGolden32));
}

// The keys of the rows of each lane's lattice point.
struct RowKeyVector {
    WordVector low, high;
};

HWY_INLINE RowKeyVector in_all_lanes(RowKey row) {
    const Words d;
    return {hn::Set(d, row.low), hn::Set(d, row.high)};
}

// `scaled_x` is x * kGolden32.
HWY_INLINE WordVector lattice_hash(const RowKeyVector& row, WordVector scaled_x) {
    return mix32(hn::Xor(mix32(hn::Add(scaled_x, row.low)), row.high));
}

struct GradientVector {
    FloatVector x, y, z;
};

HWY_INLINE GradientVector lattice_gradient(const RowKeyVector& row, WordVector scaled_x) {
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

struct Gradient4Vector {
    FloatVector x, y, z, t;
};

HWY_INLINE Gradient4Vector lattice_gradient_4(const RowKeyVector& row, WordVector scaled_x) {
    const Words d;
    const Floats df;
    const WordVector h = lattice_hash(row, scaled_x);
    const WordVector zero_axis = hn::ShiftRight<30>(h);
    const WordVector one = hn::BitCast(d, hn::Set(df, 1.0f));
    const WordVector sign_bit = hn::Set(d, 0x80000000u);
    const auto along = [&](std::uint32_t axis, WordVector signs) HWY_ATTR {
        const auto is_zero = hn::Eq(zero_axis, hn::Set(d, axis));
        return hn::BitCast(df, hn::IfThenZeroElse(is_zero, hn::Or(one, hn::And(signs, sign_bit))));
    };
    return {along(0, hn::ShiftLeft<31>(h)), along(1, hn::ShiftLeft<30>(h)),
            along(2, hn::ShiftLeft<29>(h)), along(3, hn::ShiftLeft<28>(h))};
}

// Returns 24 bits as a number in [0, 1).
HWY_INLINE FloatVector unit_float(WordVector bits) {
    const Floats df;
    const hn::RebindToSigned<Floats> di;
    return hn::Mul(hn::ConvertTo(df, hn::BitCast(di, bits)), hn::Set(df, 0x1p-24f));
}

HWY_INLINE FloatVector moved_float(WordVector h, PathShift shift) {
    const Words d;
    if (shift == PathShift{}) return unit_float(hn::ShiftRight<8>(h));  // the same, faster
    const auto has_bit = [&](std::uint32_t bit) HWY_ATTR {
        return hn::Eq(hn::And(h, hn::Set(d, bit)), hn::Set(d, bit));
    };
    const WordVector forwards =
        hn::IfThenElse(has_bit(2), hn::Set(d, shift.fast), hn::Set(d, shift.slow));
    const WordVector steps =
        hn::IfThenElse(has_bit(1), hn::Sub(hn::Set(d, kPathSteps), forwards), forwards);
    const WordVector last = hn::Set(d, kPathSteps - 1);
    const WordVector phase = hn::And(hn::Add(hn::ShiftRight<8>(h), steps), last);
    return unit_float(hn::Min(phase, hn::Sub(last, phase)));
}

struct CellPointVector {
    FloatVector x, y, z, height;
};

// Sets `points` to those of some cells of a row, step by step for all of them: a processor would wait
// for the steps of one.
template <std::size_t kCount>
HWY_INLINE void cell_points(const RowKeyVector& row, const WordVector (&scaled_x)[kCount],
                            PathShift shift, CellPointVector (&points)[kCount]) {
    const WordVector golden = hn::Set(Words(), kGolden32);
    WordVector a[kCount], b[kCount], c[kCount], e[kCount];
    const auto hash = [&](WordVector first, WordVector second, WordVector(&h)[kCount]) HWY_ATTR {
        for_each<kCount>([&](std::size_t i) HWY_ATTR { h[i] = hn::Add(scaled_x[i], first); });
        mix32(h);
        for_each<kCount>([&](std::size_t i) HWY_ATTR { h[i] = hn::Xor(h[i], second); });
        mix32(h);
    };
    const auto join = [&](const auto& from, const auto& with, WordVector(&h)[kCount]) HWY_ATTR {
        for_each<kCount>([&](std::size_t i) HWY_ATTR {
            h[i] = hn::Xor(hn::Add(from[i], golden), hn::ShiftLeft<1>(with[i]));
        });
        mix32(h);
    };
    hash(row.low, row.high, a);
    hash(row.high, row.low, b);
    join(a, b, c);
    join(b, c, e);
    for_each<kCount>([&](std::size_t i) HWY_ATTR {
        points[i] = {moved_float(a[i], shift), moved_float(b[i], shift), moved_float(c[i], shift),
                     unit_float(hn::ShiftRight<8>(e[i]))};
    });
}

HWY_INLINE CellPointVector cell_point(const RowKeyVector& row, WordVector scaled_x,
                                      PathShift shift) {
    const WordVector one[1] = {scaled_x};
    CellPointVector point[1];
    cell_points(row, one, shift, point);
    return point[0];
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_LATTICE_HASH_INL_H_
