#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/convection/hartley.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "bakers/convection/hartley.h"
#include "bakers/convection/kernel_rows.h"
#include "bakers/math/transcendental.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::convection::HWY_NAMESPACE {
namespace {

template <int kRadix>
struct Numbers {
    std::array<float, kRadix> real, imaginary;
};

// The transform of 2, 3, 4 or 5 numbers.
HWY_INLINE Numbers<2> transformed(const Numbers<2>& a) {
    return {{a.real[0] + a.real[1], a.real[0] - a.real[1]},
            {a.imaginary[0] + a.imaginary[1], a.imaginary[0] - a.imaginary[1]}};
}

HWY_INLINE Numbers<4> transformed(const Numbers<4>& a) {
    const Numbers<2> even =
        transformed(Numbers<2>{{a.real[0], a.real[2]}, {a.imaginary[0], a.imaginary[2]}});
    const Numbers<2> odd =
        transformed(Numbers<2>{{a.real[1], a.real[3]}, {a.imaginary[1], a.imaginary[3]}});
    return {{even.real[0] + odd.real[0], even.real[1] + odd.imaginary[1],
             even.real[0] - odd.real[0], even.real[1] - odd.imaginary[1]},
            {even.imaginary[0] + odd.imaginary[0], even.imaginary[1] - odd.real[1],
             even.imaginary[0] - odd.imaginary[0], even.imaginary[1] + odd.real[1]}};
}

// Cosines and sines of the parts of a turn.
template <int kRadix>
struct Turns;
template <>
struct Turns<3> {
    static constexpr std::array cosine = {1.0F, -0.5F, -0.5F};
    static constexpr std::array sine = {0.0F, 0.86602540F, -0.86602540F};
};
template <>
struct Turns<5> {
    static constexpr std::array cosine = {1.0F, 0.30901699F, -0.80901699F, -0.80901699F,
                                          0.30901699F};
    static constexpr std::array sine = {0.0F, 0.95105652F, 0.58778525F, -0.58778525F, -0.95105652F};
};

template <int kRadix>
HWY_INLINE Numbers<kRadix> transformed(const Numbers<kRadix>& a) {
    Numbers<kRadix> out{};
    for (std::size_t k = 0; k < kRadix; ++k) {
        for (std::size_t j = 0; j < kRadix; ++j) {
            const float cosine = Turns<kRadix>::cosine[j * k % kRadix];
            const float sine = Turns<kRadix>::sine[j * k % kRadix];
            out.real[k] += a.real[j] * cosine + a.imaginary[j] * sine;
            out.imaginary[k] += a.imaginary[j] * cosine - a.real[j] * sine;
        }
    }
    return out;
}

template <int kRadix>
void butterflies(const HartleyBlock& block) {
    const float* __restrict real = block.real;
    const float* __restrict imaginary = block.imaginary;
    float* __restrict to_real = block.to_real;
    float* __restrict to_imaginary = block.to_imaginary;
    const int count = block.count;
    const int step = block.step;
    std::array<float, kRadix> cosine, sine;
    for (std::size_t k = 0; k < kRadix; ++k) {
        cosine[k] = block.cosine[k];
        sine[k] = block.sine[k];
    }
    for (int i = 0; i < count; ++i) {
        Numbers<kRadix> in;
        for (int j = 0; j < kRadix; ++j) {
            in.real[static_cast<std::size_t>(j)] = real[i + j * step];
            in.imaginary[static_cast<std::size_t>(j)] = imaginary[i + j * step];
        }
        const Numbers<kRadix> out = transformed(in);
        for (int k = 0; k < kRadix; ++k) {
            const auto at = static_cast<std::size_t>(k);
            to_real[i + k * count] = out.real[at] * cosine[at] - out.imaginary[at] * sine[at];
            to_imaginary[i + k * count] = out.real[at] * sine[at] + out.imaginary[at] * cosine[at];
        }
    }
}

}  // namespace

void Butterflies(int radix, const HartleyBlock& block) {
    if (radix == 2) butterflies<2>(block);
    if (radix == 3) butterflies<3>(block);
    if (radix == 4) butterflies<4>(block);
    if (radix == 5) butterflies<5>(block);
}

// Writes the Hartley transforms Re F - Im F of two real sequences, whose transforms F one complex sequence
// carries, at a frequency, from those at it and at its opposite.
void Part(const HartleyPair& pair) {
    const float* __restrict real = pair.real;
    const float* __restrict imaginary = pair.imaginary;
    const float* __restrict opposite_real = pair.opposite_real;
    const float* __restrict opposite_imaginary = pair.opposite_imaginary;
    float* __restrict first = pair.first;
    float* __restrict second = pair.second;
    for (int i = 0; i < pair.count; ++i) {
        first[i] = 0.5F * ((real[i] + opposite_real[i]) - (imaginary[i] - opposite_imaginary[i]));
        second[i] = 0.5F * ((imaginary[i] + opposite_imaginary[i]) + (real[i] - opposite_real[i]));
    }
}

}  // namespace skybake::convection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::convection {

HWY_EXPORT(Butterflies);
HWY_EXPORT(Part);

namespace {

void transpose(const float* from, int columns, int rows, float* to) {
    constexpr int kBlock = 16;
    for (int y0 = 0; y0 < rows; y0 += kBlock) {
        for (int x0 = 0; x0 < columns; x0 += kBlock) {
            for (int x = x0; x < std::min(x0 + kBlock, columns); ++x) {
                for (int y = y0; y < std::min(y0 + kBlock, rows); ++y) {
                    to[x * rows + y] = from[y * columns + x];
                }
            }
        }
    }
}

int next_radix(int left) {
    for (const int radix : {4, 2, 3, 5}) {
        if (left % radix == 0) return radix;
    }
    return 0;
}

}  // namespace

bool is_smooth(int length) {
    for (const int prime : {2, 3, 5}) {
        while (length > 1 && length % prime == 0) length /= prime;
    }
    return length == 1;
}

Hartley::Axis Hartley::make_axis(int length) {
    Axis axis{length, {}};
    for (int before = 1; before < length;) {
        const int left = length / before;
        Stage stage{next_radix(left), before, {}, {}};
        for (int block = 0; block < left / stage.radix; ++block) {
            for (int k = 0; k < stage.radix; ++k) {
                const double turns = static_cast<double>(block * k) / left;
                stage.cosine.push_back(static_cast<float>(cosine_of_turns(turns)));
                stage.sine.push_back(static_cast<float>(-cosine_of_turns(turns - 0.25)));
            }
        }
        before *= stage.radix;
        axis.stages.push_back(std::move(stage));
    }
    return axis;
}

Hartley::Hartley(int columns, int rows) : x_(make_axis(columns)), y_(make_axis(rows)) {
    assert(is_smooth(columns) && is_smooth(rows) && columns % 2 == 0 && rows % 2 == 0);
}

// Column i of the left half is the real part of a sequence, and column i of the right half its imaginary one.
void Hartley::transform_columns(const Axis& axis, int columns, float* plane, Scratch& scratch) {
    const int half = columns / 2;
    // Parts of complex numbers that lie a power of two apart would share lines of the cache.
    const int apart = half * axis.length + 48;
    scratch.from.resize(static_cast<std::size_t>(2 * apart));
    scratch.to.resize(static_cast<std::size_t>(2 * apart));
    for (int y = 0; y < axis.length; ++y) {
        std::copy_n(plane + y * columns, half, scratch.from.data() + y * half);
        std::copy_n(plane + y * columns + half, half, scratch.from.data() + apart + y * half);
    }
    for (const Stage& stage : axis.stages) {
        const int blocks = axis.length / (stage.before * stage.radix);
        const int run = stage.before * half;
        for (int b = 0; b < blocks; ++b) {
            const float* from = scratch.from.data() + b * run;
            float* to = scratch.to.data() + b * stage.radix * run;
            HWY_DYNAMIC_DISPATCH(Butterflies)
            (stage.radix,
             {from, from + apart, to, to + apart, blocks * run, run,
              stage.cosine.data() + b * stage.radix, stage.sine.data() + b * stage.radix});
        }
        scratch.from.swap(scratch.to);
    }
    for (int y = 0; y < axis.length; ++y) {
        const float* at = scratch.from.data() + y * half;
        const float* opposite = scratch.from.data() + (axis.length - y) % axis.length * half;
        float* out = plane + y * columns;
        HWY_DYNAMIC_DISPATCH(Part)
        ({at, at + apart, opposite, opposite + apart, half, out, out + half});
    }
}

void Hartley::transform(float* plane, Scratch& scratch) const {
    transform_columns(y_, x_.length, plane, scratch);
    scratch.turned.resize(static_cast<std::size_t>(x_.length) *
                          static_cast<std::size_t>(y_.length));
    transpose(plane, x_.length, y_.length, scratch.turned.data());
    transform_columns(x_, y_.length, scratch.turned.data(), scratch);
    transpose(scratch.turned.data(), y_.length, x_.length, plane);
}

}  // namespace skybake::convection
#endif  // HWY_ONCE
