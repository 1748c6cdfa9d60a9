// The wavelengths of a packet in registers, with the operations that transcendental-inl.h asks of a
// Real.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "bakers/math/vectors.h"

namespace skybake {

// A Spectrum as two pairs, in the vector types that GCC and Clang share: pairs are what every
// x86-64 and ARM has, so that no code needs to be compiled per processor.
struct Channels {
    using Pair = double __attribute__((vector_size(16)));
    using Bits = std::int64_t __attribute__((vector_size(16)));
    static constexpr std::size_t kLanes = 4;

    Pair low;
    Pair high;

    Channels() = default;
    explicit Channels(double x) : low{x, x}, high{x, x} {}
    explicit Channels(const Spectrum& x) : low{x.x, x.y}, high{x.z, x.w} {}
    Channels(Pair a, Pair b) : low(a), high(b) {}
    // By copies: GCC 12 loses what is stored through a variable subscript of a pair, unless it is
    // told -fno-strict-aliasing.
    double operator[](std::size_t c) const {
        double x;
        std::memcpy(&x, reinterpret_cast<const char*>(this) + c * sizeof x, sizeof x);
        return x;
    }
    void set(std::size_t c, double x) {
        std::memcpy(reinterpret_cast<char*>(this) + c * sizeof x, &x, sizeof x);
    }
    Spectrum spectrum() const { return {low[0], low[1], high[0], high[1]}; }
};

struct ChannelMask {
    Channels::Bits low;  // all bits of a lane or none
    Channels::Bits high;
};

inline Channels operator+(Channels a, Channels b) { return {a.low + b.low, a.high + b.high}; }
inline Channels operator-(Channels a, Channels b) { return {a.low - b.low, a.high - b.high}; }
inline Channels operator*(Channels a, Channels b) { return {a.low * b.low, a.high * b.high}; }
inline Channels operator/(Channels a, Channels b) { return {a.low / b.low, a.high / b.high}; }
inline Channels operator-(Channels a) { return {-a.low, -a.high}; }
inline Channels operator*(double a, Channels b) { return Channels(a) * b; }
inline ChannelMask operator<(Channels a, Channels b) { return {a.low < b.low, a.high < b.high}; }
inline ChannelMask operator>(Channels a, Channels b) { return b < a; }

inline Channels select(ChannelMask mask, Channels yes, Channels no) {
    using Bits = Channels::Bits;
    using Pair = Channels::Pair;
    const auto pick = [](Bits m, Pair a, Pair b) {
        return reinterpret_cast<Pair>((m & reinterpret_cast<Bits>(a)) |
                                      (~m & reinterpret_cast<Bits>(b)));
    };
    return {pick(mask.low, yes.low, no.low), pick(mask.high, yes.high, no.high)};
}
inline Channels minimum(Channels a, Channels b) { return select(b < a, b, a); }
inline Channels maximum(Channels a, Channels b) { return select(a < b, b, a); }

inline Channels add_to_bits(Channels x, std::uint64_t n) {
    using Bits = Channels::Bits;
    const auto by = static_cast<std::int64_t>(n);
    return {reinterpret_cast<Channels::Pair>(reinterpret_cast<Bits>(x.low) + Bits{by, by}),
            reinterpret_cast<Channels::Pair>(reinterpret_cast<Bits>(x.high) + Bits{by, by})};
}
template <int kBy>
inline Channels shift_bits_left(Channels x) {
    using Bits = Channels::Bits;
    return {reinterpret_cast<Channels::Pair>(reinterpret_cast<Bits>(x.low) << kBy),
            reinterpret_cast<Channels::Pair>(reinterpret_cast<Bits>(x.high) << kBy)};
}

// e^x of each, the same bits as exponential(double).
Channels exponential(const Channels& x);

}  // namespace skybake
