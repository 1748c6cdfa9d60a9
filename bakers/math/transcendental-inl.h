// exp, log, arc cosine, sine and cosine that give the same bits with every processor, compiler and vector
// width. They use only additions, multiplications, divisions and square roots, each correctly
// rounded, in one order. The results of the C library's own functions depend on the processor it
// finds (with FMA or without).
//
// Real is double, Lanes or Channels; for exponential_of_negative it is float or FloatLanes. The
// error bounds in ulp are measured against 113-bit arithmetic over 10^6 arguments
// (transcendental_test.cpp).
#if defined(SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#undef SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#else
#define SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#endif

#include <numbers>

#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// ln 2 in two parts. The first has 17 trailing zero bits, so that n * kLn2High is exact for
// |n| < 2^17.
constexpr double kLn2High = 0x1.62e42fefa0000p-1;
constexpr double kLn2Low = 0x1.cf79abc9e3b3ap-40;
// Adding 1.5 * 2^52 to a number below 2^51 leaves its nearest integer in the low bits of the sum.
constexpr double kRoundToInteger = 0x1.8p52;

// Returns e^x for any x that is not NaN, within 1.5 ulp. The result is 0 below -708, where e^x is
// no longer a normal double, and infinity where e^x overflows.
template <class Real>
HWY_INLINE Real exponential(Real x) {
    // e^x = 2^n e^r with n = round(x / ln 2) and |r| <= ln 2 / 2. e^r is a Taylor series, whose
    // truncation error starts at r^14 / 14! < 5e-18. Summing even and odd powers separately
    // shortens the chain of dependent operations.
    const Real inside = minimum(maximum(x, Real(-709.0)), Real(710.0));
    const Real shifted = inside * Real(1.4426950408889634074) + Real(kRoundToInteger);
    const Real n = shifted - Real(kRoundToInteger);
    const Real r = (inside - n * Real(kLn2High)) - n * Real(kLn2Low);
    const Real r2 = r * r;
    Real even = Real(1.0 / 479001600.0);
    even = even * r2 + Real(1.0 / 3628800.0);
    even = even * r2 + Real(1.0 / 40320.0);
    even = even * r2 + Real(1.0 / 720.0);
    even = even * r2 + Real(1.0 / 24.0);
    even = even * r2 + Real(0.5);
    Real odd = Real(1.0 / 6227020800.0);
    odd = odd * r2 + Real(1.0 / 39916800.0);
    odd = odd * r2 + Real(1.0 / 362880.0);
    odd = odd * r2 + Real(1.0 / 5040.0);
    odd = odd * r2 + Real(1.0 / 120.0);
    odd = odd * r2 + Real(1.0 / 6.0);
    const Real value = Real(1.0) + (r + (r2 * even + r * r2 * odd));
    // 2^n is built from its exponent bits, in two factors 2^(n-1) * 2 since n reaches 1024.
    const Real half_scale = add_to_bits(shift_bits_left<52>(shifted), std::uint64_t{1022} << 52);
    const Real scaled = value * half_scale * Real(2.0);
    return select(x < Real(-708.0), Real(0.0), scaled);
}

// Returns e^x for x <= 0, within 2 ulp. The result is 0 below -87, where e^x is no longer a normal
// float.
template <class Real>
HWY_INLINE Real exponential_of_negative(Real x) {
    // e^x = 2^n e^r with n = round(x / ln 2) and |r| <= ln 2 / 2. Adding 1.5 * 2^23 leaves n in the
    // low bits. The first part of ln 2 has 9 trailing zero bits, so that n times it is exact. e^r
    // is a Taylor series, whose truncation error starts at r^8 / 8! < 6e-9.
    const Real inside = maximum(x, Real(-87.0F));
    const Real shifted = inside * Real(1.44269504F) + Real(12582912.0F);
    const Real n = shifted - Real(12582912.0F);
    const Real r = (inside - n * Real(0.693359375F)) - n * Real(-2.12194440e-4F);
    Real p = Real(1.0F / 5040.0F);
    p = p * r + Real(1.0F / 720.0F);
    p = p * r + Real(1.0F / 120.0F);
    p = p * r + Real(1.0F / 24.0F);
    p = p * r + Real(1.0F / 6.0F);
    p = p * r + Real(0.5F);
    p = p * r * r + r + Real(1.0F);
    return select(x < Real(-87.0F), Real(0.0F), p * power_of_two(shifted));
}

// Returns ln x for normal x > 0, within 1.5 ulp.
template <class Real>
HWY_INLINE Real logarithm(Real x) {
    // x = 2^k m with m in [sqrt(1/2), sqrt 2). ln m = 2 artanh(s) with s = (m - 1) / (m + 1) and
    // |s| < 0.1716 is a power series, whose truncation error starts at s^23 / 23 < 2e-19.
    constexpr std::uint64_t kOne = std::uint64_t{0x3ff0000000000000};
    constexpr std::uint64_t kSqrtHalf = std::uint64_t{0x3fe6a09e667f3bcd};
    const Real biased = add_to_bits(x, kOne - kSqrtHalf);
    const Real m = add_to_bits(and_bits(biased, std::uint64_t{0x000fffffffffffff}), kSqrtHalf);
    // The exponent, an integer in the low bits, becomes a double when the bits of 2^52 are added.
    const Real exponent =
        add_to_bits(shift_bits_right<52>(biased), std::uint64_t{0x4330000000000000});
    const Real k = exponent - Real(0x1p52 + 1023.0);
    const Real f = m - Real(1.0);
    const Real s = f / (m + Real(1.0));
    const Real z = s * s;
    Real p = Real(1.0 / 21.0);
    p = p * z + Real(1.0 / 19.0);
    p = p * z + Real(1.0 / 17.0);
    p = p * z + Real(1.0 / 15.0);
    p = p * z + Real(1.0 / 13.0);
    p = p * z + Real(1.0 / 11.0);
    p = p * z + Real(1.0 / 9.0);
    p = p * z + Real(1.0 / 7.0);
    p = p * z + Real(1.0 / 5.0);
    p = p * z + Real(1.0 / 3.0);
    // 2s = f - s f, so that f, which is exact, carries the leading digits.
    const Real tail = Real(2.0) * s * z * p - s * f;
    return k * Real(kLn2High) + (f + (tail + k * Real(kLn2Low)));
}

// Returns arccos x for x in [-1, 1], with an absolute error below 2e-16.
template <class Real>
HWY_INLINE Real arc_cosine(Real x) {
    // arcsin(t) = t + t z P(z) with z = t^2 <= 1/4; for |x| > 1/2,
    // arccos(x) = 2 arcsin(sqrt((1 - x) / 2)). P interpolates at Chebyshev's nodes, within 4e-18 of
    // arcsin(t) / t.
    const Real a = absolute(x);
    const auto outer = a > Real(0.5);
    const Real z = select(outer, (Real(1.0) - a) * Real(0.5), a * a);
    const Real t = select(outer, square_root(z), a);
    Real p = Real(0.028757851367421564708);
    p = p * z + Real(-0.014851887071247203224);
    p = p * z + Real(0.017400879442694022443);
    p = p * z + Real(0.0054575067186403583004);
    p = p * z + Real(0.010322814350185779287);
    p = p * z + Real(0.011479177415184905896);
    p = p * z + Real(0.013971212973552933304);
    p = p * z + Real(0.017352392720869972942);
    p = p * z + Real(0.022372172942149887875);
    p = p * z + Real(0.030381944138531247287);
    p = p * z + Real(0.044642857146355429783);
    p = p * z + Real(0.074999999999984329332);
    p = p * z + Real(0.16666666666666667827);
    const Real arc_sine = t + t * z * p;
    const auto negative = x < Real(0.0);
    const Real near = select(negative, Real(std::numbers::pi * 0.5) + arc_sine,
                             Real(std::numbers::pi * 0.5) - arc_sine);
    const Real far =
        select(negative, Real(std::numbers::pi) - Real(2.0) * arc_sine, Real(2.0) * arc_sine);
    return select(outer, far, near);
}

// Returns cos(pi x) for x in [0, 1], with an absolute error below 3e-16; exactly 0 at 1/2.
template <class Real>
HWY_INLINE Real cosine_of_pi(Real x) {
    // cos(pi x) = sin(pi (1/2 - x)), and sin(pi t) for |t| <= 1/2 is a Taylor series, whose
    // truncation error starts at (pi/2)^23 / 23! < 2e-18.
    const Real t = (Real(0.5) - x) * Real(std::numbers::pi);
    const Real z = t * t;
    Real p = Real(-1.0 / 51090942171709440000.0);
    p = p * z + Real(1.0 / 121645100408832000.0);
    p = p * z + Real(-1.0 / 355687428096000.0);
    p = p * z + Real(1.0 / 1307674368000.0);
    p = p * z + Real(-1.0 / 6227020800.0);
    p = p * z + Real(1.0 / 39916800.0);
    p = p * z + Real(-1.0 / 362880.0);
    p = p * z + Real(1.0 / 5040.0);
    p = p * z + Real(-1.0 / 120.0);
    p = p * z + Real(1.0 / 6.0);
    return t - t * z * p;
}

// Sets sine and cosine to those of x for |x| <= 1e6, each with an absolute error below 3e-16.
template <class Real>
HWY_INLINE void sine_and_cosine(Real x, Real& sine, Real& cosine) {
    // x = n pi / 2 + r, |r| <= pi / 4 (1 + 2^-30). pi / 2 in three parts of 33 bits: n has at most
    // 20, so that the products are exact, and so is the first difference, whose bits lie between
    // those of x and 1; the others round once each. What the parts leave out of pi / 2 is below
    // 2^-103.
    constexpr double kHigh = 0x1.921fb544p0;
    constexpr double kMiddle = 0x1.0b4611a6p-34;
    constexpr double kLow = 0x1.3198a2ep-69;
    const Real n = floor_of(x * Real(0.63661977236758134308) + Real(0.5));
    const Real r = ((x - n * Real(kHigh)) - n * Real(kMiddle)) - n * Real(kLow);
    const Real z = r * r;
    // The Taylor series are truncated; their errors start at (pi/4)^19 / 19! and (pi/4)^18 / 18! <
    // 3e-18.
    Real s = Real(1.0 / 355687428096000.0);
    s = s * z - Real(1.0 / 1307674368000.0);
    s = s * z + Real(1.0 / 6227020800.0);
    s = s * z - Real(1.0 / 39916800.0);
    s = s * z + Real(1.0 / 362880.0);
    s = s * z - Real(1.0 / 5040.0);
    s = s * z + Real(1.0 / 120.0);
    s = s * z - Real(1.0 / 6.0);
    Real c = Real(1.0 / 20922789888000.0);
    c = c * z - Real(1.0 / 87178291200.0);
    c = c * z + Real(1.0 / 479001600.0);
    c = c * z - Real(1.0 / 3628800.0);
    c = c * z + Real(1.0 / 40320.0);
    c = c * z - Real(1.0 / 720.0);
    c = c * z + Real(1.0 / 24.0);
    c = c * z - Real(0.5);
    const Real of_sine = r + r * (z * s);
    const Real of_cosine = Real(1.0) + z * c;
    // The quarter of a turn, 0 to 3: odd ones swap the two, and the signs are + +, + -, - -, - +.
    const Real half = floor_of(n * Real(0.5));
    const auto swaps = half * Real(2.0) < n;
    const auto turns = floor_of(half * Real(0.5)) * Real(2.0) < half;
    const Real first = select(swaps, of_cosine, of_sine);
    const Real second = select(swaps, -of_sine, of_cosine);
    sine = select(turns, -first, first);
    cosine = select(turns, -second, second);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
