// A vector of floats with the operators of a float, for every instruction set that Highway
// dispatches to, and the same operations on a plain float: a kernel written as a template over Real
// is its own scalar specification. Each operation is one correctly rounded IEEE operation, or
// exact, and none crosses lanes: a lane's result does not depend on how many there are.
//
// Included once per target (see Highway's foreach_target.h), so no ordinary include guard.
#if defined(SKYBAKE_BAKERS_PREVIEW_FLOAT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_PREVIEW_FLOAT_LANES_INL_H_
#undef SKYBAKE_BAKERS_PREVIEW_FLOAT_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_PREVIEW_FLOAT_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

struct FloatLanes {
    using Tag = hn::ScalableTag<float>;
    static constexpr std::size_t kCount = HWY_LANES(float);

    hn::Vec<Tag> v;

    FloatLanes() = default;
    HWY_INLINE FloatLanes(float x) : v(hn::Set(Tag(), x)) {}  // NOLINT: constants mix with lanes
    HWY_INLINE explicit FloatLanes(hn::Vec<Tag> x) : v(x) {}
    static HWY_INLINE FloatLanes load(const float* p) { return FloatLanes(hn::LoadU(Tag(), p)); }
    HWY_INLINE void store(float* p) const { hn::StoreU(v, Tag(), p); }
};

struct FloatMask {
    hn::Mask<FloatLanes::Tag> m;
};

struct IntLanes {
    using Tag = hn::RebindToSigned<FloatLanes::Tag>;

    hn::Vec<Tag> v;

    HWY_INLINE IntLanes(std::int32_t x) : v(hn::Set(Tag(), x)) {}  // NOLINT: as above
    HWY_INLINE explicit IntLanes(hn::Vec<Tag> x) : v(x) {}
};

HWY_INLINE FloatLanes operator+(FloatLanes a, FloatLanes b) {
    return FloatLanes(hn::Add(a.v, b.v));
}
HWY_INLINE FloatLanes operator-(FloatLanes a, FloatLanes b) {
    return FloatLanes(hn::Sub(a.v, b.v));
}
HWY_INLINE FloatLanes operator*(FloatLanes a, FloatLanes b) {
    return FloatLanes(hn::Mul(a.v, b.v));
}
HWY_INLINE FloatLanes operator/(FloatLanes a, FloatLanes b) {
    return FloatLanes(hn::Div(a.v, b.v));
}
HWY_INLINE FloatMask operator<(FloatLanes a, FloatLanes b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE FloatMask operator<=(FloatLanes a, FloatLanes b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE FloatMask operator&(FloatMask a, FloatMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE FloatMask operator|(FloatMask a, FloatMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE bool any(FloatMask mask) { return !hn::AllFalse(FloatLanes::Tag(), mask.m); }
HWY_INLINE std::int64_t count_of(FloatMask mask) {
    return static_cast<std::int64_t>(hn::CountTrue(FloatLanes::Tag(), mask.m));
}
// Lanes of `mask` that are not in `without`.
HWY_INLINE FloatMask and_not(FloatMask mask, FloatMask without) {
    return {hn::AndNot(without.m, mask.m)};
}

HWY_INLINE FloatLanes select(FloatMask mask, FloatLanes yes, FloatLanes no) {
    return FloatLanes(hn::IfThenElse(mask.m, yes.v, no.v));
}
HWY_INLINE FloatLanes zero_unless(FloatMask mask, FloatLanes x) {
    return FloatLanes(hn::IfThenElseZero(mask.m, x.v));
}
// Of numbers that are not NaN.
HWY_INLINE FloatLanes minimum(FloatLanes a, FloatLanes b) { return FloatLanes(hn::Min(a.v, b.v)); }
HWY_INLINE FloatLanes maximum(FloatLanes a, FloatLanes b) { return FloatLanes(hn::Max(a.v, b.v)); }
HWY_INLINE FloatLanes square_root(FloatLanes x) { return FloatLanes(hn::Sqrt(x.v)); }
HWY_INLINE FloatLanes floor_of(FloatLanes x) { return FloatLanes(hn::Floor(x.v)); }
HWY_INLINE FloatLanes ceil_of(FloatLanes x) { return FloatLanes(hn::Ceil(x.v)); }

// Rounded towards zero; of magnitudes below 2^31.
HWY_INLINE IntLanes to_int(FloatLanes x) { return IntLanes(hn::ConvertTo(IntLanes::Tag(), x.v)); }
HWY_INLINE FloatLanes to_float(IntLanes x) {
    return FloatLanes(hn::ConvertTo(FloatLanes::Tag(), x.v));
}
HWY_INLINE IntLanes operator+(IntLanes a, IntLanes b) { return IntLanes(hn::Add(a.v, b.v)); }
HWY_INLINE IntLanes operator*(IntLanes a, IntLanes b) { return IntLanes(hn::Mul(a.v, b.v)); }
HWY_INLINE IntLanes minimum(IntLanes a, IntLanes b) { return IntLanes(hn::Min(a.v, b.v)); }
HWY_INLINE IntLanes maximum(IntLanes a, IntLanes b) { return IntLanes(hn::Max(a.v, b.v)); }
HWY_INLINE IntLanes shifted_right(IntLanes x, int by) {
    return IntLanes(hn::ShiftRightSame(x.v, by));
}
HWY_INLINE IntLanes shifted_left(IntLanes x, int by) {
    return IntLanes(hn::ShiftLeftSame(x.v, by));
}
HWY_INLINE FloatLanes gather(const float* values, IntLanes index) {
    return FloatLanes(hn::GatherIndex(FloatLanes::Tag(), values, index.v));
}

HWY_INLINE FloatLanes operator-(FloatLanes a) { return FloatLanes(hn::Neg(a.v)); }
HWY_INLINE FloatLanes absolute(FloatLanes x) { return FloatLanes(hn::Abs(x.v)); }
HWY_INLINE IntLanes whole_part(FloatLanes x) { return to_int(x); }
HWY_INLINE FloatLanes as_float(IntLanes x) { return to_float(x); }
HWY_INLINE IntLanes times(IntLanes x, std::int32_t by) { return x * IntLanes(by); }
// 2^n for a number whose lowest bits are those of the integer n in [-126, 127].
HWY_INLINE FloatLanes power_of_two(FloatLanes shifted) {
    const auto bits = hn::BitCast(IntLanes::Tag(), shifted.v);
    const auto exponent = hn::ShiftLeft<23>(hn::Add(bits, hn::Set(IntLanes::Tag(), 127)));
    return FloatLanes(hn::BitCast(FloatLanes::Tag(), exponent));
}

// The same for one float.
HWY_INLINE float square_root(float x) { return std::sqrt(x); }
HWY_INLINE float absolute(float x) { return std::fabs(x); }
HWY_INLINE float minimum(float a, float b) { return b < a ? b : a; }
HWY_INLINE float maximum(float a, float b) { return a < b ? b : a; }
HWY_INLINE float select(bool mask, float yes, float no) { return mask ? yes : no; }
HWY_INLINE bool any(bool mask) { return mask; }
HWY_INLINE std::int32_t whole_part(float x) { return static_cast<std::int32_t>(x); }
HWY_INLINE float as_float(std::int32_t x) { return static_cast<float>(x); }
HWY_INLINE std::int32_t times(std::int32_t x, std::int32_t by) { return x * by; }
HWY_INLINE float gather(const float* values, std::int32_t index) { return values[index]; }
HWY_INLINE float power_of_two(float shifted) {
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(shifted) + 127U) << 23);
}

// e^x for x <= 0, within 2 units in the last place; 0 below -87, where e^x leaves the normal
// floats.
template <class Real>
HWY_INLINE Real exponential_of_negative(Real x) {
    // e^x = 2^n e^r with n = round(x / ln 2), |r| <= ln 2 / 2: adding 1.5 * 2^23 leaves n in the
    // low bits. Of ln 2 the first part has 9 trailing zero bits, so that n times it is exact.
    // Taylor's series for e^r: the first term left out is r^8 / 8! < 6e-9.
    const Real inside = maximum(x, Real(-87.0F));
    const Real shifted = inside * Real(1.44269504F) + Real(12582912.0F);
    const Real n = shifted - Real(12582912.0F);
    const Real r = (inside - n * Real(0.693359375F)) - n * Real(-2.12194440e-4F);
    Real p = Real(1.0F / 5040.0F);
    p = p * r + Real(1.0F / 720.0F);
    p = p * r + Real(1.0F / 120.0F);
    p = p * r + Real(1.0F / 24.0F);
    p = p * r + Real(1.0F / 6.0F);
    p = p * r + Real(0.5F);
    p = p * r * r + r + Real(1.0F);
    return select(x < Real(-87.0F), Real(0.0F), p * power_of_two(shifted));
}

// How a template over Real walks an array, kCount elements at a time.
template <class Real>
struct FloatAccess {
    static constexpr int kCount = static_cast<int>(FloatLanes::kCount);
    static HWY_INLINE FloatLanes load(const float* p) { return FloatLanes::load(p); }
    static HWY_INLINE void store(FloatLanes x, float* p) { x.store(p); }
};
template <>
struct FloatAccess<float> {
    static constexpr int kCount = 1;
    static HWY_INLINE float load(const float* p) { return *p; }
    static HWY_INLINE void store(float x, float* p) { *p = x; }
};

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_PREVIEW_FLOAT_LANES_INL_H_
