#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/math/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/air/particles/lorenz_mie_kernel.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/particles/mie_series-inl.h"
#include "bakers/math/lanes-inl.h"

#ifndef SKYBAKE_LORENZ_MIE_KERNEL_TILE
#define SKYBAKE_LORENZ_MIE_KERNEL_TILE
namespace skybake {

// Angles of a tile: a multiple of the doubles in the longest vector that Highway has (AVX-512).
constexpr std::size_t kTileAngles = 32;

}  // namespace skybake
#endif

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The terms of a series are taken in blocks, and so are the spheres: the angular functions of one
// block of terms at all angles of a tile stay in the cache while all spheres of a block use them,
// and the terms of a sphere come from memory once for a tile.
constexpr std::size_t kBlockTerms = 64;  // an even number
constexpr std::size_t kBlockSpheres = 64;
constexpr std::size_t kVectors = kTileAngles / Lanes::kCount;
constexpr std::size_t kFunctions = 2 * Lanes::kCount;  // of one term and vector of angles

constexpr std::size_t kRow = kBlockTerms * kFunctions;  // of a block of terms
// Vectors whose recurrences run side by side, since a step waits for the step before.
constexpr std::size_t kTogether = 4;

// Where the recurrence of one vector of angles stands: pi_n, pi_(n-1) and their difference.
struct Recurrence {
    Lanes one_minus, pi, before, step;

    // Writes pi_n + tau_n, and pi_n - tau_n or for even n its negative, as MieTerms have it.
    template <bool kEven>
    HWY_INLINE void advance(double n, double* out) {
        const Lanes drop = one_minus * pi;
        const Lanes t = step - drop;
        const Lanes tau = Lanes(n) * t - before;
        (pi + tau).store(out);
        (kEven ? tau - pi : pi - tau).store(out + Lanes::kCount);
        step = t * Lanes(1 + 1 / n) - drop;
        before = pi;
        pi = pi + step;
    }
};

// Writes a row of functions for each of kTogether vectors of angles: n = first + 1 ... end, and one
// more if that leaves an odd one. `first` is even.
void angular_functions(std::size_t first, std::size_t end, Recurrence* states, double* out) {
    Recurrence local[kTogether];  // in registers
    for (std::size_t v = 0; v < kTogether; ++v) local[v] = states[v];
    for (std::size_t i = first; i < end; i += 2) {
        const double n = static_cast<double>(i + 1);
        for (std::size_t v = 0; v < kTogether; ++v) {
            local[v].advance<false>(n, out + v * kRow);
        }
        for (std::size_t v = 0; v < kTogether; ++v) {
            local[v].advance<true>(n + 1, out + v * kRow + kFunctions);
        }
        out += 2 * kFunctions;
    }
    for (std::size_t v = 0; v < kTogether; ++v) states[v] = local[v];
}

// S_1 + S_2, S_1 - S_2, and both at 180 degrees - theta, real and imaginary parts.
using Amplitudes = std::array<double, 8 * Lanes::kCount>;

// Adds the terms n = first + 1 ... end. The sums are loose variables, which compilers keep in
// registers.
void add_terms(const MieTerms& terms, std::size_t first, std::size_t end, const double* functions,
               double* sums) {
    constexpr std::size_t k = Lanes::kCount;
    Lanes sum_real = Lanes::load(sums);
    Lanes sum_imaginary = Lanes::load(sums + k);
    Lanes difference_real = Lanes::load(sums + 2 * k);
    Lanes difference_imaginary = Lanes::load(sums + 3 * k);
    Lanes back_sum_real = Lanes::load(sums + 4 * k);
    Lanes back_sum_imaginary = Lanes::load(sums + 5 * k);
    Lanes back_difference_real = Lanes::load(sums + 6 * k);
    Lanes back_difference_imaginary = Lanes::load(sums + 7 * k);
    const std::array<double, 4>* term = terms.data() + first;
    for (const std::array<double, 4>* const last = terms.data() + end; term < last; ++term) {
        const Lanes plus = Lanes::load(functions);
        const Lanes minus = Lanes::load(functions + k);
        functions += kFunctions;
        const Lanes s_real((*term)[0]);
        sum_real = sum_real + s_real * plus;
        back_sum_real = back_sum_real + s_real * minus;
        const Lanes s_imaginary((*term)[1]);
        sum_imaginary = sum_imaginary + s_imaginary * plus;
        back_sum_imaginary = back_sum_imaginary + s_imaginary * minus;
        const Lanes d_real((*term)[2]);
        difference_real = difference_real + d_real * minus;
        back_difference_real = back_difference_real + d_real * plus;
        const Lanes d_imaginary((*term)[3]);
        difference_imaginary = difference_imaginary + d_imaginary * minus;
        back_difference_imaginary = back_difference_imaginary + d_imaginary * plus;
    }
    sum_real.store(sums);
    sum_imaginary.store(sums + k);
    difference_real.store(sums + 2 * k);
    difference_imaginary.store(sums + 3 * k);
    back_sum_real.store(sums + 4 * k);
    back_sum_imaginary.store(sums + 5 * k);
    back_difference_real.store(sums + 6 * k);
    back_difference_imaginary.store(sums + 7 * k);
}

// |(sum +- difference) / 2|^2 times `weight`, added to `to`.
HWY_INLINE void add_intensity(Lanes quarter, Lanes real, Lanes imaginary, double* to) {
    (Lanes::load(to) + quarter * (real * real + imaginary * imaginary)).store(to);
}

void add_intensities(const Amplitudes& amplitudes, double weight, std::size_t k,
                     double* const* sums) {
    const auto at = [&](std::size_t i)
                        HWY_ATTR { return Lanes::load(amplitudes.data() + i * Lanes::kCount); };
    const Lanes quarter(0.25 * weight);
    add_intensity(quarter, at(0) + at(2), at(1) + at(3), sums[0] + k);
    add_intensity(quarter, at(0) - at(2), at(1) - at(3), sums[1] + k);
    add_intensity(quarter, at(4) + at(6), at(5) + at(7), sums[2] + k);
    add_intensity(quarter, at(4) - at(6), at(5) - at(7), sums[3] + k);
}

// Fetches terms into the cache while those of another sphere are added.
void prefetch(const MieTerms& terms, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < std::min(end, terms.size()); i += 2) hwy::Prefetch(&terms[i]);
}

// The first `vectors` vectors of angles of one tile, for one block of spheres.
void add_block(std::span<const MieTerms> spheres, std::span<const double> weights,
               const double* one_minus_cosines, std::size_t vectors, double* const* sums) {
    std::size_t most = 0;
    for (const MieTerms& terms : spheres) most = std::max(most, terms.size());
    Recurrence states[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
        states[v] = {Lanes::load(one_minus_cosines + v * Lanes::kCount), 1.0, 0.0, 1.0};
    }
    std::vector<Amplitudes> amplitudes(spheres.size() * vectors, Amplitudes{});
    alignas(64) std::array<double, kTogether * kRow> functions;
    for (std::size_t first = 0; first < most; first += kBlockTerms) {
        const std::size_t last = std::min(first + kBlockTerms, most);
        for (std::size_t v = 0; v < vectors; v += kTogether) {
            angular_functions(first, last, states + v, functions.data());
            for (std::size_t s = 0; s < spheres.size(); ++s) {
                if (s + 1 < spheres.size()) prefetch(spheres[s + 1], first, last);
                const std::size_t end = std::min(last, spheres[s].size());
                if (first >= end) continue;
                for (std::size_t i = 0; i < std::min(kTogether, vectors - v); ++i) {
                    add_terms(spheres[s], first, end, functions.data() + i * kRow,
                              amplitudes[s * vectors + v + i].data());
                }
            }
        }
    }
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        for (std::size_t v = 0; v < vectors; ++v) {
            add_intensities(amplitudes[s * vectors + v], weights[s], v * Lanes::kCount, sums);
        }
    }
}

// The first `angles` angles of one tile, whose arrays are those of MieIntensities and as long as
// the tile.
void add_tile(std::span<const MieTerms> spheres, std::span<const double> weights,
              const double* one_minus_cosines, std::size_t angles, double* const* sums) {
    const std::size_t vectors = (angles + Lanes::kCount - 1) / Lanes::kCount;
    for (std::size_t first = 0; first < spheres.size(); first += kBlockSpheres) {
        const std::size_t count = std::min(kBlockSpheres, spheres.size() - first);
        add_block(spheres.subspan(first, count), weights.subspan(first, count), one_minus_cosines,
                  vectors, sums);
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(add_tile);
HWY_EXPORT(all_series);

void mie_series(std::span<const double> size_parameters, ComplexNumber refractive_index,
                std::span<MieTerms> terms, std::span<MieEfficiencies> efficiencies) {
    assert(terms.size() == size_parameters.size() && efficiencies.size() == terms.size());
    HWY_DYNAMIC_DISPATCH(all_series)(size_parameters, refractive_index, terms, efficiencies);
}

void add_mie_intensities(std::span<const MieTerms> spheres, std::span<const double> weights,
                         const std::vector<double>& one_minus_cosines, int threads,
                         MieIntensities& sums) {
    assert(spheres.size() == weights.size());
    const std::size_t angles = one_minus_cosines.size();
    const std::array<std::vector<double>*, 4> outputs = {
        &sums.perpendicular, &sums.parallel, &sums.back_perpendicular, &sums.back_parallel};
    const std::size_t tiles = (angles + kTileAngles - 1) / kTileAngles;
    parallel_for(static_cast<int>(tiles), threads, [&](int tile) {
        const std::size_t first = static_cast<std::size_t>(tile) * kTileAngles;
        const std::size_t used = std::min(kTileAngles, angles - first);
        std::array<double, 5 * kTileAngles> padded{};
        std::copy_n(one_minus_cosines.data() + first, used, padded.data());
        std::array<double*, 4> rows{};
        for (std::size_t i = 0; i < rows.size(); ++i) {
            assert(outputs[i]->size() == angles);
            rows[i] = padded.data() + (i + 1) * kTileAngles;
            std::copy_n(outputs[i]->data() + first, used, rows[i]);
        }
        HWY_DYNAMIC_DISPATCH(add_tile)(spheres, weights, padded.data(), used, rows.data());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::copy_n(rows[i], used, outputs[i]->data() + first);
        }
    });
}

MieIntensities no_intensities(std::size_t angles) {
    const std::vector<double> zeros(angles, 0.0);
    return {zeros, zeros, zeros, zeros};
}

}  // namespace skybake
#endif  // HWY_ONCE
