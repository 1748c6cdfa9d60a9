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

#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// pi_n + tau_n and pi_n - tau_n of one vector of angles, n = 1 ... count, one after the other.
void angular_functions(Lanes one_minus, std::size_t count, double* out) {
    Lanes pi(1.0);
    Lanes before(0.0);
    Lanes step(1.0);  // pi_n - pi_(n-1)
    for (std::size_t i = 0; i < count; ++i) {
        const double n = static_cast<double>(i + 1);
        const Lanes drop = one_minus * pi;
        const Lanes t = step - drop;
        const Lanes tau = Lanes(n) * t - before;
        (pi + tau).store(out + 2 * i * Lanes::kCount);
        (pi - tau).store(out + (2 * i + 1) * Lanes::kCount);
        step = t * Lanes(1 + 1 / n) - drop;
        before = pi;
        pi = pi + step;
    }
}

// S_1 + S_2 and S_1 - S_2 at theta and at 180 degrees - theta.
struct Amplitudes {
    Lanes sum_real, sum_imaginary;
    Lanes difference_real, difference_imaginary;
    Lanes back_sum_real, back_sum_imaginary;
    Lanes back_difference_real, back_difference_imaginary;
};

// Term n; its sign at 180 degrees - theta is minus for even n.
template <bool kEven>
HWY_INLINE void add_term(const double* term, const double* functions, Amplitudes& to) {
    const Lanes plus = Lanes::load(functions);
    const Lanes minus = Lanes::load(functions + Lanes::kCount);
    const Lanes sum_real(term[0]);
    const Lanes sum_imaginary(term[1]);
    const Lanes difference_real(term[2]);
    const Lanes difference_imaginary(term[3]);
    to.sum_real = to.sum_real + sum_real * plus;
    to.sum_imaginary = to.sum_imaginary + sum_imaginary * plus;
    to.difference_real = to.difference_real + difference_real * minus;
    to.difference_imaginary = to.difference_imaginary + difference_imaginary * minus;
    const auto add = [](Lanes x, Lanes y) HWY_ATTR { return kEven ? x - y : x + y; };
    to.back_sum_real = add(to.back_sum_real, sum_real * minus);
    to.back_sum_imaginary = add(to.back_sum_imaginary, sum_imaginary * minus);
    to.back_difference_real = add(to.back_difference_real, difference_real * plus);
    to.back_difference_imaginary = add(to.back_difference_imaginary, difference_imaginary * plus);
}

Amplitudes amplitudes(const MieTerms& terms, const double* functions) {
    const Lanes zero(0.0);
    Amplitudes result = {zero, zero, zero, zero, zero, zero, zero, zero};
    constexpr std::size_t kStride = 2 * Lanes::kCount;
    std::size_t i = 0;
    for (; i + 2 <= terms.size(); i += 2) {
        add_term<false>(terms[i].data(), functions + i * kStride, result);
        add_term<true>(terms[i + 1].data(), functions + (i + 1) * kStride, result);
    }
    if (i < terms.size()) add_term<false>(terms[i].data(), functions + i * kStride, result);
    return result;
}

// |(sum + sign difference) / 2|^2 times `weight`, added to `to`.
HWY_INLINE void add_intensity(double weight, Lanes real, Lanes imaginary, double* to) {
    (Lanes::load(to) + Lanes(0.25 * weight) * (real * real + imaginary * imaginary)).store(to);
}

// The angles of one tile: a multiple of any vector's length, its arrays as those of MieIntensities.
void add_tile(std::span<const MieTerms> spheres, std::span<const double> weights,
              const double* one_minus_cosines, std::size_t angles, double* const* sums) {
    std::size_t most = 0;
    for (const MieTerms& terms : spheres) most = std::max(most, terms.size());
    std::vector<double> functions(2 * Lanes::kCount * most);
    for (std::size_t k = 0; k < angles; k += Lanes::kCount) {
        angular_functions(Lanes::load(one_minus_cosines + k), most, functions.data());
        for (std::size_t s = 0; s < spheres.size(); ++s) {
            const Amplitudes at = amplitudes(spheres[s], functions.data());
            const double weight = weights[s];
            add_intensity(weight, at.sum_real + at.difference_real,
                          at.sum_imaginary + at.difference_imaginary, sums[0] + k);
            add_intensity(weight, at.sum_real - at.difference_real,
                          at.sum_imaginary - at.difference_imaginary, sums[1] + k);
            add_intensity(weight, at.back_sum_real + at.back_difference_real,
                          at.back_sum_imaginary + at.back_difference_imaginary, sums[2] + k);
            add_intensity(weight, at.back_sum_real - at.back_difference_real,
                          at.back_sum_imaginary - at.back_difference_imaginary, sums[3] + k);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(add_tile);

namespace {

// Doubles in the longest vector that Highway has (AVX-512); tiles of angles are filled up to it.
constexpr std::size_t kTileAngles = 8;

}  // namespace

MieTerms mie_terms(const MieCoefficients& coefficients) {
    MieTerms terms;
    terms.reserve(coefficients.a.size());
    for (std::size_t i = 0; i < coefficients.a.size(); ++i) {
        const double n = static_cast<double>(i + 1);
        const double c = (2 * n + 1) / (n * (n + 1));
        const ComplexNumber sum = c * (coefficients.a[i] + coefficients.b[i]);
        const ComplexNumber difference = c * (coefficients.a[i] - coefficients.b[i]);
        terms.push_back({sum.real, sum.imaginary, difference.real, difference.imaginary});
    }
    return terms;
}

void add_mie_intensities(std::span<const MieTerms> spheres, std::span<const double> weights,
                         const std::vector<double>& one_minus_cosines, int threads,
                         MieIntensities& sums) {
    assert(spheres.size() == weights.size());
    assert(sums.perpendicular.size() == one_minus_cosines.size() &&
           sums.parallel.size() == one_minus_cosines.size() &&
           sums.back_perpendicular.size() == one_minus_cosines.size() &&
           sums.back_parallel.size() == one_minus_cosines.size());
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
            rows[i] = padded.data() + (i + 1) * kTileAngles;
            std::copy_n(outputs[i]->data() + first, used, rows[i]);
        }
        HWY_DYNAMIC_DISPATCH(add_tile)(spheres, weights, padded.data(), kTileAngles, rows.data());
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
