// The four channels of a Spectrum, held in vectors of any width, with the operations that
// transcendental-inl.h requires of a Real, for kernels that Highway dispatches.
//
// Highway includes this file once per target (see its foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MATH_CHANNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MATH_CHANNELS_INL_H_
#undef SKYBAKE_BAKERS_MATH_CHANNELS_INL_H_
#else
#define SKYBAKE_BAKERS_MATH_CHANNELS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "bakers/math/vectors.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

struct Channels {
    using Tag = hn::CappedTag<double, kChannelSlots>;
    static constexpr std::size_t kPerPart = HWY_MIN(HWY_LANES(double), kChannelSlots);
    static constexpr std::size_t kParts = kChannelSlots / kPerPart;

    hn::Vec<Tag> parts[kParts];

    Channels() = default;
    HWY_INLINE explicit Channels(double x) {
        HWY_UNROLL(4)
        for (std::size_t i = 0; i < kParts; ++i) parts[i] = hn::Set(Tag(), x);
    }
    HWY_INLINE explicit Channels(const Spectrum& x) : Channels(load(data(x))) {}
    static HWY_INLINE Channels load(const double* p) {
        Channels x;
        HWY_UNROLL(4)
        for (std::size_t i = 0; i < kParts; ++i) x.parts[i] = hn::LoadU(Tag(), p + i * kPerPart);
        return x;
    }
    HWY_INLINE void store(double* p) const {
        HWY_UNROLL(4)
        for (std::size_t i = 0; i < kParts; ++i) hn::StoreU(parts[i], Tag(), p + i * kPerPart);
    }
    HWY_INLINE Spectrum spectrum() const {
        Spectrum x;
        store(data(x));
        return x;
    }
    // Reads by a copy, since vectors have no subscript.
    double operator[](std::size_t c) const {
        double x;
        std::memcpy(&x, reinterpret_cast<const char*>(this) + c * sizeof x, sizeof x);
        return x;
    }
    void set(std::size_t c, double x) {
        std::memcpy(reinterpret_cast<char*>(this) + c * sizeof x, &x, sizeof x);
    }
};

// The channels for which a comparison holds.
struct ChannelMask {
    hn::Mask<Channels::Tag> parts[Channels::kParts];
};

HWY_INLINE Channels operator+(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Add(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels operator-(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Sub(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels operator*(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Mul(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels operator/(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Div(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels operator-(Channels a) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Neg(a.parts[i]);
    return a;
}
HWY_INLINE Channels operator*(double a, const Channels& b) { return Channels(a) * b; }

HWY_INLINE ChannelMask operator<(const Channels& a, const Channels& b) {
    ChannelMask mask;
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) {
        mask.parts[i] = hn::Lt(a.parts[i], b.parts[i]);
    }
    return mask;
}
HWY_INLINE ChannelMask operator>(const Channels& a, const Channels& b) { return b < a; }
HWY_INLINE Channels select(const ChannelMask& mask, const Channels& yes, Channels no) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) {
        no.parts[i] = hn::IfThenElse(mask.parts[i], yes.parts[i], no.parts[i]);
    }
    return no;
}
HWY_INLINE Channels minimum(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Min(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels maximum(Channels a, const Channels& b) {
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Max(a.parts[i], b.parts[i]);
    return a;
}

HWY_INLINE Channels add_to_bits(Channels x, std::uint64_t n) {
    const hn::RebindToUnsigned<Channels::Tag> bits;
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) {
        const auto sum = hn::Add(hn::BitCast(bits, x.parts[i]), hn::Set(bits, n));
        x.parts[i] = hn::BitCast(Channels::Tag(), sum);
    }
    return x;
}
template <int kBy>
HWY_INLINE Channels shift_bits_left(Channels x) {
    const hn::RebindToUnsigned<Channels::Tag> bits;
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < Channels::kParts; ++i) {
        const auto shifted = hn::ShiftLeft<kBy>(hn::BitCast(bits, x.parts[i]));
        x.parts[i] = hn::BitCast(Channels::Tag(), shifted);
    }
    return x;
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MATH_CHANNELS_INL_H_
