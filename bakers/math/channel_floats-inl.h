// The channels of several suns in vectors of floats, beside each other as they lie in memory: number n is
// channel n % 4 of sun n / 4. A vector begins at a number, and holds one to four suns.
//
// Highway includes this file once per target (see its foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MATH_CHANNEL_FLOATS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MATH_CHANNEL_FLOATS_INL_H_
#undef SKYBAKE_BAKERS_MATH_CHANNEL_FLOATS_INL_H_
#else
#define SKYBAKE_BAKERS_MATH_CHANNEL_FLOATS_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "bakers/math/lanes-inl.h"
#include "bakers/math/vectors.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

struct alignas(16) ChannelFloats {
    std::array<float, kChannelSlots> values{};
};

// Sunlight and shares of sunlight below 1e-18 count as 0, so that no product of two is a denormal
// float, with which processors take a hundred times as long.
constexpr double kDarkest = 1e-18;

inline ChannelFloats floats_of(const Spectrum& values) {
    ChannelFloats floats;
    for (std::size_t c = 0; c < kChannelSlots; ++c) {
        const double value = data(values)[c];
        floats.values[c] = value < kDarkest ? 0 : static_cast<float>(value);
    }
    return floats;
}

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE FloatLanes for_all_suns(const ChannelFloats& channels, std::size_t number) {
    return FloatLanes(channels.values[number % kChannelSlots]);
}

HWY_INLINE FloatLanes for_all_channels(const float* suns, std::size_t number) {
    return FloatLanes(suns[number / kChannelSlots]);
}

HWY_INLINE FloatLanes load_places(const float* from, const std::int32_t* places,
                                  std::size_t number) {
    return FloatLanes(*(from + places[number / kChannelSlots] + number % kChannelSlots));
}

#else

// Returns the same channels for each sun.
HWY_INLINE FloatLanes for_all_suns(const ChannelFloats& channels, std::size_t /*number*/) {
    return FloatLanes(hn::LoadDup128(FloatLanes::Tag(), channels.values.data()));
}

// Returns each sun's number for all its channels. As many floats as a vector has must follow.
HWY_INLINE FloatLanes for_all_channels(const float* suns, std::size_t number) {
    const FloatLanes::Tag floats;
    const auto indices = hn::ShiftRight<2>(hn::Iota(IntLanes::Tag(), 0));
    const auto numbers = hn::LoadU(floats, suns + number / kChannelSlots);
    return FloatLanes(hn::TableLookupLanes(numbers, hn::IndicesFromVec(floats, indices)));
}

// Loads four floats from each of the places.
template <class Tag>
HWY_INLINE hn::Vec<Tag> load_fours(Tag tag, const float* from, const std::int32_t* places) {
    if constexpr (hn::MaxLanes(Tag()) == kChannelSlots) {
        return hn::LoadU(tag, from + *places);
    } else {
        const hn::Half<Tag> half;
        const std::int32_t* upper = places + hn::MaxLanes(Tag()) / kChannelSlots / 2;
        return hn::Combine(tag, load_fours(half, from, upper), load_fours(half, from, places));
    }
}

// Loads the channels of each sun from its place.
HWY_INLINE FloatLanes load_places(const float* from, const std::int32_t* places,
                                  std::size_t number) {
    return FloatLanes(load_fours(FloatLanes::Tag(), from, places + number / kChannelSlots));
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MATH_CHANNEL_FLOATS_INL_H_
