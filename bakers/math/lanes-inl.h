// A vector of doubles with the operators of a double, for every instruction set that Highway
// dispatches to, and the same operations on a plain double: a kernel written once as a template
// over `Real` is its own scalar specification, and equals it bit for bit, since each operation here
// is one correctly rounded IEEE operation and none of them crosses lanes.
//
// Included once per target (see Highway's foreach_target.h), so no ordinary include guard.
#if defined(SKYBAKE_BAKERS_CORE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_CORE_LANES_INL_H_
#undef SKYBAKE_BAKERS_CORE_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_CORE_LANES_INL_H_
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

struct Lanes {
    using Tag = hn::ScalableTag<double>;
    using Bits = hn::RebindToUnsigned<Tag>;
    static constexpr std::size_t kCount = HWY_LANES(double);

    hn::Vec<Tag> v;

    Lanes() = default;
    HWY_INLINE Lanes(double x) : v(hn::Set(Tag(), x)) {}  // NOLINT: constants mix with lanes
    HWY_INLINE explicit Lanes(hn::Vec<Tag> x) : v(x) {}
    static HWY_INLINE Lanes load(const double* p) { return Lanes(hn::LoadU(Tag(), p)); }
    HWY_INLINE void store(double* p) const { hn::StoreU(v, Tag(), p); }
};

struct LaneMask {
    hn::Mask<Lanes::Tag> m;
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }
HWY_INLINE LaneMask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE LaneMask operator<=(Lanes a, Lanes b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE LaneMask operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE LaneMask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
HWY_INLINE Lanes square_root(Lanes x) { return Lanes(hn::Sqrt(x.v)); }
HWY_INLINE Lanes minimum(Lanes a, Lanes b) { return Lanes(hn::Min(a.v, b.v)); }
HWY_INLINE Lanes maximum(Lanes a, Lanes b) { return Lanes(hn::Max(a.v, b.v)); }
HWY_INLINE Lanes absolute(Lanes x) { return Lanes(hn::Abs(x.v)); }
HWY_INLINE Lanes select(LaneMask mask, Lanes yes, Lanes no) {
    return Lanes(hn::IfThenElse(mask.m, yes.v, no.v));
}
HWY_INLINE bool any(LaneMask mask) { return !hn::AllFalse(Lanes::Tag(), mask.m); }
HWY_INLINE bool all(LaneMask mask) { return hn::AllTrue(Lanes::Tag(), mask.m); }

// The operations of transcendental-inl.h on the bits of a double.
HWY_INLINE auto bits_of(Lanes x) { return hn::BitCast(Lanes::Bits(), x.v); }
template <class U>
HWY_INLINE Lanes lanes_of(U bits) {
    return Lanes(hn::BitCast(Lanes::Tag(), bits));
}
HWY_INLINE Lanes add_to_bits(Lanes x, std::uint64_t n) {
    return lanes_of(hn::Add(bits_of(x), hn::Set(Lanes::Bits(), n)));
}
HWY_INLINE Lanes and_bits(Lanes x, std::uint64_t n) {
    return lanes_of(hn::And(bits_of(x), hn::Set(Lanes::Bits(), n)));
}
template <int kBy>
HWY_INLINE Lanes shift_bits_left(Lanes x) {
    return lanes_of(hn::ShiftLeft<kBy>(bits_of(x)));
}
template <int kBy>
HWY_INLINE Lanes shift_bits_right(Lanes x) {
    return lanes_of(hn::ShiftRight<kBy>(bits_of(x)));
}

// The same for one double.
HWY_INLINE double square_root(double x) { return std::sqrt(x); }
HWY_INLINE double minimum(double a, double b) { return b < a ? b : a; }
HWY_INLINE double maximum(double a, double b) { return a < b ? b : a; }
HWY_INLINE double absolute(double x) { return std::fabs(x); }
HWY_INLINE double select(bool mask, double yes, double no) { return mask ? yes : no; }
HWY_INLINE bool any(bool mask) { return mask; }
HWY_INLINE bool all(bool mask) { return mask; }
HWY_INLINE double add_to_bits(double x, std::uint64_t n) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + n);
}
HWY_INLINE double and_bits(double x, std::uint64_t n) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & n);
}
template <int kBy>
HWY_INLINE double shift_bits_left(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) << kBy);
}
template <int kBy>
HWY_INLINE double shift_bits_right(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) >> kBy);
}

// How a template over Real walks an array, kCount elements at a time.
template <class Real>
struct LaneAccess {
    static constexpr int kCount = static_cast<int>(Lanes::kCount);
    static HWY_INLINE Lanes load(const double* p) { return Lanes::load(p); }
    static HWY_INLINE void store(Lanes x, double* p) { x.store(p); }
};
template <>
struct LaneAccess<double> {
    static constexpr int kCount = 1;
    static HWY_INLINE double load(const double* p) { return *p; }
    static HWY_INLINE void store(double x, double* p) { *p = x; }
};

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_CORE_LANES_INL_H_
