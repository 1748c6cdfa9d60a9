// A vector of floats with the operators of a float, for every instruction set that Highway
// dispatches to. Each operation is one correctly rounded IEEE operation, or exact, and none crosses
// lanes: a lane's result does not depend on how many there are.
//
// Included once per target (see Highway's foreach_target.h), so no ordinary include guard.
#if defined(SKYBAKE_BAKERS_PREVIEW_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_PREVIEW_RAY_LANES_INL_H_
#undef SKYBAKE_BAKERS_PREVIEW_RAY_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_PREVIEW_RAY_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

struct RayFloats {
    using Tag = hn::ScalableTag<float>;
    static constexpr std::size_t kCount = HWY_LANES(float);

    hn::Vec<Tag> v;

    RayFloats() = default;
    HWY_INLINE RayFloats(float x) : v(hn::Set(Tag(), x)) {}  // NOLINT: constants mix with lanes
    HWY_INLINE explicit RayFloats(hn::Vec<Tag> x) : v(x) {}
    static HWY_INLINE RayFloats load(const float* p) { return RayFloats(hn::LoadU(Tag(), p)); }
    HWY_INLINE void store(float* p) const { hn::StoreU(v, Tag(), p); }
};

struct RayMask {
    hn::Mask<RayFloats::Tag> m;
};

struct RayInts {
    using Tag = hn::RebindToSigned<RayFloats::Tag>;

    hn::Vec<Tag> v;

    HWY_INLINE RayInts(std::int32_t x) : v(hn::Set(Tag(), x)) {}  // NOLINT: as above
    HWY_INLINE explicit RayInts(hn::Vec<Tag> x) : v(x) {}
};

HWY_INLINE RayFloats operator+(RayFloats a, RayFloats b) { return RayFloats(hn::Add(a.v, b.v)); }
HWY_INLINE RayFloats operator-(RayFloats a, RayFloats b) { return RayFloats(hn::Sub(a.v, b.v)); }
HWY_INLINE RayFloats operator*(RayFloats a, RayFloats b) { return RayFloats(hn::Mul(a.v, b.v)); }
HWY_INLINE RayFloats operator/(RayFloats a, RayFloats b) { return RayFloats(hn::Div(a.v, b.v)); }
HWY_INLINE RayMask operator<(RayFloats a, RayFloats b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE RayMask operator<=(RayFloats a, RayFloats b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE RayMask operator&(RayMask a, RayMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE RayMask operator|(RayMask a, RayMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE bool any(RayMask mask) { return !hn::AllFalse(RayFloats::Tag(), mask.m); }
HWY_INLINE std::int64_t count_of(RayMask mask) {
    return static_cast<std::int64_t>(hn::CountTrue(RayFloats::Tag(), mask.m));
}
// Lanes of `mask` that are not in `without`.
HWY_INLINE RayMask and_not(RayMask mask, RayMask without) {
    return {hn::AndNot(without.m, mask.m)};
}

HWY_INLINE RayFloats select(RayMask mask, RayFloats yes, RayFloats no) {
    return RayFloats(hn::IfThenElse(mask.m, yes.v, no.v));
}
HWY_INLINE RayFloats zero_unless(RayMask mask, RayFloats x) {
    return RayFloats(hn::IfThenElseZero(mask.m, x.v));
}
// Of numbers that are not NaN.
HWY_INLINE RayFloats minimum(RayFloats a, RayFloats b) { return RayFloats(hn::Min(a.v, b.v)); }
HWY_INLINE RayFloats maximum(RayFloats a, RayFloats b) { return RayFloats(hn::Max(a.v, b.v)); }
HWY_INLINE RayFloats square_root(RayFloats x) { return RayFloats(hn::Sqrt(x.v)); }
HWY_INLINE RayFloats floor_of(RayFloats x) { return RayFloats(hn::Floor(x.v)); }
HWY_INLINE RayFloats ceil_of(RayFloats x) { return RayFloats(hn::Ceil(x.v)); }

// Rounded towards zero; of magnitudes below 2^31.
HWY_INLINE RayInts to_int(RayFloats x) { return RayInts(hn::ConvertTo(RayInts::Tag(), x.v)); }
HWY_INLINE RayFloats to_float(RayInts x) { return RayFloats(hn::ConvertTo(RayFloats::Tag(), x.v)); }
HWY_INLINE RayInts operator+(RayInts a, RayInts b) { return RayInts(hn::Add(a.v, b.v)); }
HWY_INLINE RayInts operator*(RayInts a, RayInts b) { return RayInts(hn::Mul(a.v, b.v)); }
HWY_INLINE RayInts minimum(RayInts a, RayInts b) { return RayInts(hn::Min(a.v, b.v)); }
HWY_INLINE RayInts maximum(RayInts a, RayInts b) { return RayInts(hn::Max(a.v, b.v)); }
HWY_INLINE RayInts shifted_right(RayInts x, int by) { return RayInts(hn::ShiftRightSame(x.v, by)); }
HWY_INLINE RayInts shifted_left(RayInts x, int by) { return RayInts(hn::ShiftLeftSame(x.v, by)); }
HWY_INLINE RayFloats gather(const float* values, RayInts index) {
    return RayFloats(hn::GatherIndex(RayFloats::Tag(), values, index.v));
}

// e^x for x <= 0, within 2 units in the last place; 0 below -87, where e^x leaves the normal
// floats.
HWY_INLINE RayFloats exponential_of_negative(RayFloats x) {
    // e^x = 2^n e^r with n = round(x / ln 2), |r| <= ln 2 / 2: adding 1.5 * 2^23 leaves n in the
    // low bits. Of ln 2 the first part has 9 trailing zero bits, so that n times it is exact.
    // Taylor's series for e^r: the first term left out is r^8 / 8! < 6e-9.
    const RayFloats shifted =
        maximum(x, RayFloats(-87.0F)) * RayFloats(1.44269504F) + RayFloats(12582912.0F);
    const RayFloats n = shifted - RayFloats(12582912.0F);
    const RayFloats r = (maximum(x, RayFloats(-87.0F)) - n * RayFloats(0.693359375F)) -
                        n * RayFloats(-2.12194440e-4F);
    RayFloats p = RayFloats(1.0F / 5040.0F);
    p = p * r + RayFloats(1.0F / 720.0F);
    p = p * r + RayFloats(1.0F / 120.0F);
    p = p * r + RayFloats(1.0F / 24.0F);
    p = p * r + RayFloats(1.0F / 6.0F);
    p = p * r + RayFloats(0.5F);
    p = p * r * r + r + RayFloats(1.0F);
    const auto bits = hn::BitCast(RayInts::Tag(), shifted.v);
    const auto exponent = hn::ShiftLeft<23>(hn::Add(bits, hn::Set(RayInts::Tag(), 127)));
    const RayFloats scaled = p * RayFloats(hn::BitCast(RayFloats::Tag(), exponent));
    return zero_unless(RayFloats(-87.0F) <= x, scaled);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_PREVIEW_RAY_LANES_INL_H_
