// Vectors of doubles, floats and integers with arithmetic operators, for every instruction set that
// Highway dispatches to, and the same operations on a plain double or float. A kernel that is
// written once as a template over `Real` is its own scalar specification and equals it bit for bit:
// each operation here is exact or one correctly rounded IEEE operation, and none crosses lanes, so
// that a lane's result does not depend on the number of lanes.
//
// These vectors serve wide loops over many items; channels-inl.h holds the four channels of one
// spectrum.
//
// Highway includes this file once per target (see its foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MATH_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MATH_LANES_INL_H_
#undef SKYBAKE_BAKERS_MATH_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_MATH_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The lanes for which a comparison holds.
template <class T>
struct MaskOf {
    using Tag = hn::ScalableTag<T>;

    hn::Mask<Tag> m;

    friend HWY_INLINE MaskOf operator&(MaskOf a, MaskOf b) { return {hn::And(a.m, b.m)}; }
    friend HWY_INLINE MaskOf operator|(MaskOf a, MaskOf b) { return {hn::Or(a.m, b.m)}; }
    // Returns the lanes of `mask` that are not in `without`.
    friend HWY_INLINE MaskOf and_not(MaskOf mask, MaskOf without) {
        return {hn::AndNot(without.m, mask.m)};
    }
    friend HWY_INLINE bool any(MaskOf mask) { return !hn::AllFalse(Tag(), mask.m); }
    friend HWY_INLINE bool all(MaskOf mask) { return hn::AllTrue(Tag(), mask.m); }
    friend HWY_INLINE std::int64_t count_of(MaskOf mask) {
        return static_cast<std::int64_t>(hn::CountTrue(Tag(), mask.m));
    }
};

// A vector of numbers of type T. Division, square root and rounding exist for
// floating-point types only. No operand of minimum or maximum may be NaN.
template <class T>
struct LanesOf {
    using Tag = hn::ScalableTag<T>;
    using Mask = MaskOf<T>;
    static constexpr std::size_t kCount = HWY_LANES(T);

    hn::Vec<Tag> v;

    LanesOf() = default;
    HWY_INLINE LanesOf(T x) : v(hn::Set(Tag(), x)) {}  // NOLINT: constants mix with lanes
    HWY_INLINE explicit LanesOf(hn::Vec<Tag> x) : v(x) {}
    static HWY_INLINE LanesOf load(const T* p) { return LanesOf(hn::LoadU(Tag(), p)); }
    HWY_INLINE void store(T* p) const { hn::StoreU(v, Tag(), p); }

    friend HWY_INLINE LanesOf operator+(LanesOf a, LanesOf b) { return LanesOf(hn::Add(a.v, b.v)); }
    friend HWY_INLINE LanesOf operator-(LanesOf a, LanesOf b) { return LanesOf(hn::Sub(a.v, b.v)); }
    friend HWY_INLINE LanesOf operator*(LanesOf a, LanesOf b) { return LanesOf(hn::Mul(a.v, b.v)); }
    friend HWY_INLINE LanesOf operator/(LanesOf a, LanesOf b) { return LanesOf(hn::Div(a.v, b.v)); }
    friend HWY_INLINE LanesOf operator-(LanesOf a) { return LanesOf(hn::Neg(a.v)); }
    friend HWY_INLINE Mask operator<(LanesOf a, LanesOf b) { return {hn::Lt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator<=(LanesOf a, LanesOf b) { return {hn::Le(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>(LanesOf a, LanesOf b) { return {hn::Gt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>=(LanesOf a, LanesOf b) { return {hn::Ge(a.v, b.v)}; }
    friend HWY_INLINE LanesOf minimum(LanesOf a, LanesOf b) { return LanesOf(hn::Min(a.v, b.v)); }
    friend HWY_INLINE LanesOf maximum(LanesOf a, LanesOf b) { return LanesOf(hn::Max(a.v, b.v)); }
    friend HWY_INLINE LanesOf absolute(LanesOf x) { return LanesOf(hn::Abs(x.v)); }
    friend HWY_INLINE LanesOf square_root(LanesOf x) { return LanesOf(hn::Sqrt(x.v)); }
    friend HWY_INLINE LanesOf floor_of(LanesOf x) { return LanesOf(hn::Floor(x.v)); }
    friend HWY_INLINE LanesOf ceil_of(LanesOf x) { return LanesOf(hn::Ceil(x.v)); }
    friend HWY_INLINE LanesOf select(Mask mask, LanesOf yes, LanesOf no) {
        return LanesOf(hn::IfThenElse(mask.m, yes.v, no.v));
    }
    friend HWY_INLINE LanesOf zero_unless(Mask mask, LanesOf x) {
        return LanesOf(hn::IfThenElseZero(mask.m, x.v));
    }
};

using Lanes = LanesOf<double>;
using LaneMask = MaskOf<double>;
using FloatLanes = LanesOf<float>;
using FloatMask = MaskOf<float>;
using IntLanes = LanesOf<std::int32_t>;    // as many as there are floats
using IndexLanes = LanesOf<std::int64_t>;  // as many as there are doubles

// The same operations on one number.
template <std::floating_point T>
HWY_INLINE T square_root(T x) {
    return std::sqrt(x);
}
template <std::floating_point T>
HWY_INLINE T minimum(T a, T b) {
    return b < a ? b : a;
}
template <std::floating_point T>
HWY_INLINE T maximum(T a, T b) {
    return a < b ? b : a;
}
template <std::floating_point T>
HWY_INLINE T absolute(T x) {
    return std::fabs(x);
}
template <std::floating_point T>
HWY_INLINE T select(bool mask, T yes, T no) {
    return mask ? yes : no;
}
template <std::floating_point T>
HWY_INLINE T floor_of(T x) {
    return std::floor(x);
}
HWY_INLINE bool and_not(bool mask, bool without) { return mask && !without; }
HWY_INLINE bool any(bool mask) { return mask; }
HWY_INLINE bool all(bool mask) { return mask; }

// --- Integers ------------------------------------------------------------------------------------

// Rounds towards zero, to integers as wide as the numbers. The magnitude must be below 2^31.
template <std::floating_point T>
HWY_INLINE LanesOf<hwy::MakeSigned<T>> to_int(LanesOf<T> x) {
    using Integers = LanesOf<hwy::MakeSigned<T>>;
    return Integers(hn::ConvertTo(typename Integers::Tag(), x.v));
}
HWY_INLINE std::int32_t to_int(float x) { return static_cast<std::int32_t>(x); }
HWY_INLINE FloatLanes to_float(IntLanes x) {
    return FloatLanes(hn::ConvertTo(FloatLanes::Tag(), x.v));
}
HWY_INLINE float to_float(std::int32_t x) { return static_cast<float>(x); }
HWY_INLINE IntLanes shifted_right(IntLanes x, int by) {
    return IntLanes(hn::ShiftRightSame(x.v, by));
}
HWY_INLINE IntLanes shifted_left(IntLanes x, int by) {
    return IntLanes(hn::ShiftLeftSame(x.v, by));
}
template <std::floating_point T>
HWY_INLINE LanesOf<T> gather(const T* values, LanesOf<hwy::MakeSigned<T>> index) {
    return LanesOf<T>(hn::GatherIndex(typename LanesOf<T>::Tag(), values, index.v));
}
HWY_INLINE float gather(const float* values, std::int32_t index) { return values[index]; }

// --- Operations of transcendental-inl.h on the bits of a number ----------------------------------

HWY_INLINE auto bits_of(Lanes x) { return hn::BitCast(hn::RebindToUnsigned<Lanes::Tag>(), x.v); }
template <class U>
HWY_INLINE Lanes lanes_of(U bits) {
    return Lanes(hn::BitCast(Lanes::Tag(), bits));
}
HWY_INLINE Lanes add_to_bits(Lanes x, std::uint64_t n) {
    return lanes_of(hn::Add(bits_of(x), hn::Set(hn::RebindToUnsigned<Lanes::Tag>(), n)));
}
HWY_INLINE double add_to_bits(double x, std::uint64_t n) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + n);
}
HWY_INLINE Lanes and_bits(Lanes x, std::uint64_t n) {
    return lanes_of(hn::And(bits_of(x), hn::Set(hn::RebindToUnsigned<Lanes::Tag>(), n)));
}
HWY_INLINE double and_bits(double x, std::uint64_t n) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & n);
}
template <int kBy>
HWY_INLINE Lanes shift_bits_left(Lanes x) {
    return lanes_of(hn::ShiftLeft<kBy>(bits_of(x)));
}
template <int kBy>
HWY_INLINE double shift_bits_left(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) << kBy);
}
template <int kBy>
HWY_INLINE Lanes shift_bits_right(Lanes x) {
    return lanes_of(hn::ShiftRight<kBy>(bits_of(x)));
}
template <int kBy>
HWY_INLINE double shift_bits_right(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) >> kBy);
}
// 2^n for a number whose lowest bits are those of the integer n in [-126, 127].
HWY_INLINE FloatLanes power_of_two(FloatLanes shifted) {
    const auto bits = hn::BitCast(IntLanes::Tag(), shifted.v);
    const auto exponent = hn::ShiftLeft<23>(hn::Add(bits, hn::Set(IntLanes::Tag(), 127)));
    return FloatLanes(hn::BitCast(FloatLanes::Tag(), exponent));
}
HWY_INLINE float power_of_two(float shifted) {
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(shifted) + 127U) << 23);
}

// --- Indices -------------------------------------------------------------------------------------

// The bits of a number as an integer.
HWY_INLINE IndexLanes integer_of_bits(Lanes x) {
    return IndexLanes(hn::BitCast(IndexLanes::Tag(), x.v));
}
HWY_INLINE std::int64_t integer_of_bits(double x) { return std::bit_cast<std::int64_t>(x); }
// The integer of a whole number in [0, 2^52).
HWY_INLINE IndexLanes to_index(Lanes x) {
    return IndexLanes(hn::And(integer_of_bits(x + Lanes(0x1p52)).v,
                              hn::Set(IndexLanes::Tag(), (std::int64_t{1} << 52) - 1)));
}
HWY_INLINE std::int64_t to_index(double x) { return static_cast<std::int64_t>(x); }
// Shift integers that are not negative.
template <int kBy>
HWY_INLINE IndexLanes shifted_right(IndexLanes x) {
    const hn::RebindToUnsigned<IndexLanes::Tag> bits;
    return IndexLanes(hn::BitCast(IndexLanes::Tag(), hn::ShiftRight<kBy>(hn::BitCast(bits, x.v))));
}
template <int kBy>
HWY_INLINE std::int64_t shifted_right(std::int64_t x) {
    return x >> kBy;
}
template <int kBy>
HWY_INLINE IndexLanes shifted_left(IndexLanes x) {
    return IndexLanes(hn::ShiftLeft<kBy>(x.v));
}
template <int kBy>
HWY_INLINE std::int64_t shifted_left(std::int64_t x) {
    return x << kBy;
}
HWY_INLINE Lanes gather(const double* values, IndexLanes index) {
    return Lanes(hn::GatherIndex(Lanes::Tag(), values, index.v));
}
HWY_INLINE double gather(const double* values, std::int64_t index) { return values[index]; }

// How a template over Real walks through an array, kCount elements at a time.
template <class Real>
struct LaneAccess {
    using Number = Real;
    static constexpr int kCount = 1;
    static HWY_INLINE Real load(const Real* p) { return *p; }
    static HWY_INLINE void store(Real x, Real* p) { *p = x; }
};
template <class T>
struct LaneAccess<LanesOf<T>> {
    using Number = T;
    static constexpr int kCount = static_cast<int>(LanesOf<T>::kCount);
    static HWY_INLINE LanesOf<T> load(const T* p) { return LanesOf<T>::load(p); }
    static HWY_INLINE void store(LanesOf<T> x, T* p) { x.store(p); }
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MATH_LANES_INL_H_
