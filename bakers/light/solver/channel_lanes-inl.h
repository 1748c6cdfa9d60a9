// The four channel slots of a moment (light_field.h) in vectors of any width.
#if defined(SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#undef SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#else
#define SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "bakers/light/solver/light_field.h"
#include "bakers/math/lanes-inl.h"

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

// Light of suns by azimuthal order, to be looked up between the columns of a sun axis.
struct ColumnLookup {
    const double* rows;  // [(column * orders + m) * kChannelSlots + channel]
    std::size_t orders;
    const std::int64_t* columns;  // of each sun the first of four
    const double* weights;        // [sun * 4 + k]
    const double* powers;         // [m * count + sun]: what multiplies order m
    std::size_t count;
};

// Adds to sum[sun * kChannelSlots + channel].
HWY_INLINE void add_columns(const ColumnLookup& of, double* sum) {
    const std::size_t row_size = of.orders * kChannelSlots;
    for (std::size_t i = 0; i < of.count; ++i) {
        const double* row = of.rows + static_cast<std::size_t>(of.columns[i]) * row_size;
        const Channels w0 = Channels::all(of.weights[i * 4]);
        const Channels w1 = Channels::all(of.weights[i * 4 + 1]);
        const Channels w2 = Channels::all(of.weights[i * 4 + 2]);
        const Channels w3 = Channels::all(of.weights[i * 4 + 3]);
        Channels total = Channels::load(sum + i * kChannelSlots);
        for (std::size_t m = 0; m < of.orders; ++m) {
            const double* at = row + m * kChannelSlots;
            const Channels value =
                (w0 * Channels::load(at) + w1 * Channels::load(at + row_size)) +
                (w2 * Channels::load(at + 2 * row_size) + w3 * Channels::load(at + 3 * row_size));
            total = total + Channels::all(of.powers[m * of.count + i]) * value;
        }
        total.store(sum + i * kChannelSlots);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_SCATTERING_CHANNEL_LANES_INL_H_
