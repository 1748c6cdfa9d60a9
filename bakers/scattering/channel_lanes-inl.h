// The four channel slots of a moment (light_field.h) in vectors of any width.
#if defined(SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#undef SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#endif

#include <cstddef>

#include "bakers/core/lanes-inl.h"
#include "bakers/scattering/light_field.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

struct Channels {
    using Tag = hn::CappedTag<double, kChannelSlots>;
    static constexpr std::size_t kPerPart = HWY_MIN(HWY_LANES(double), kChannelSlots);
    static constexpr std::size_t kParts = kChannelSlots / kPerPart;

    hn::Vec<Tag> parts[kParts];

    static HWY_INLINE Channels load(const double* p) {
        Channels x;
        for (std::size_t i = 0; i < kParts; ++i) x.parts[i] = hn::LoadU(Tag(), p + i * kPerPart);
        return x;
    }
    static HWY_INLINE Channels all(double value) {
        Channels x;
        for (std::size_t i = 0; i < kParts; ++i) x.parts[i] = hn::Set(Tag(), value);
        return x;
    }
    HWY_INLINE void store(double* p) const {
        for (std::size_t i = 0; i < kParts; ++i) hn::StoreU(parts[i], Tag(), p + i * kPerPart);
    }
};

HWY_INLINE Channels operator+(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Add(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Channels operator*(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < Channels::kParts; ++i) a.parts[i] = hn::Mul(a.parts[i], b.parts[i]);
    return a;
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
