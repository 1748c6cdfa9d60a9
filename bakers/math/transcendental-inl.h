// exp, log, arc cosine and cosine that give the same bits on every CPU, compiler and vector width:
// only additions, multiplications, divisions and square roots, each correctly rounded, in one
// order. The C library's own change with the CPU it finds (FMA or not).
//
// Real is double, Lanes or Channels, or of exponential_of_negative float or FloatLanes. The bounds
// in ulp are measured against 113-bit arithmetic over 10^6 arguments (transcendental_test.cpp).
#if defined(SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#undef SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#else
#define SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
#endif

#include <numbers>

#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// ln 2 in two parts: the first has 17 trailing zero bits, so that n * kLn2High is exact for |n| <
// 2^17.
constexpr double kLn2High = 0x1.62e42fefa0000p-1;
constexpr double kLn2Low = 0x1.cf79abc9e3b3ap-40;
// Adding 1.5 * 2^52 to a number below 2^51 leaves its nearest integer in the low bits of the sum.
constexpr double kRoundToInteger = 0x1.8p52;

// e^x for any x that is not NaN, within 1.5 ulp; 0 below -708, where e^x leaves the normal doubles,
// infinity where it overflows.
template <class Real>
HWY_INLINE Real exponential(Real x) {
    // e^x = 2^n e^r with n = round(x / ln 2), |r| <= ln 2 / 2, and Taylor's series for e^r: the
    // first term left out is r^14 / 14! < 5e-18. Even and odd powers side by side shorten the
    // chain.
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
    // 2^n by its exponent bits, in two factors since n reaches 1024: 2^(n-1) * 2.
    const Real half_scale = add_to_bits(shift_bits_left<52>(shifted), std::uint64_t{1022} << 52);
    const Real scaled = value * half_scale * Real(2.0);
    return select(x < Real(-708.0), Real(0.0), scaled);
}

// e^x for x <= 0, within 2 units in the last place; 0 below -87, where e^x leaves the normal
// floats.
template <class Real>
HWY_INLINE Real exponential_of_negative(Real x) {
    // e^x = 2^n e^r with n = round(x / ln 2), |r| <= ln 2 / 2: adding 1.5 * 2^23 leaves n in the
    // low bits. Of ln 2 the first part has 9 trailing zero bits, so that n times it is exact.
    // Taylor's series for e^r: the first term left out is r^8 / 8! < 6e-9.
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

// ln x for normal x > 0, within 1.5 ulp.
template <class Real>
HWY_INLINE Real logarithm(Real x) {
    // x = 2^k m with m in [sqrt(1/2), sqrt 2): ln m = 2 artanh(s), s = (m - 1) / (m + 1), |s| <
    // 0.1716, by its series; the first term left out is s^23 / 23 < 2e-19.
    constexpr std::uint64_t kOne = std::uint64_t{0x3ff0000000000000};
    constexpr std::uint64_t kSqrtHalf = std::uint64_t{0x3fe6a09e667f3bcd};
    const Real biased = add_to_bits(x, kOne - kSqrtHalf);
    const Real m = add_to_bits(and_bits(biased, std::uint64_t{0x000fffffffffffff}), kSqrtHalf);
    // The exponent, an integer in the low bits, becomes a double by the bits of 2^52.
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
    // 2s = f - s f, so that the exact f carries the leading digits.
    const Real tail = Real(2.0) * s * z * p - s * f;
    return k * Real(kLn2High) + (f + (tail + k * Real(kLn2Low)));
}

// arccos x for x in [-1, 1], within 2e-16 absolute.
template <class Real>
HWY_INLINE Real arc_cosine(Real x) {
    // arcsin(t) = t + t z P(z), z = t^2 <= 1/4; beyond 1/2 by arccos(x) = 2 arcsin(sqrt((1 - x) /
    // 2)). P interpolates at Chebyshev's nodes, within 4e-18 of arcsin(t) / t.
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

// cos(pi x) for x in [0, 1], within 3e-16 absolute; exactly 0 at 1/2.
template <class Real>
HWY_INLINE Real cosine_of_pi(Real x) {
    // cos(pi x) = sin(pi (1/2 - x)), and sin(pi t) for |t| <= 1/2 by Taylor's series: the first
    // term left out is (pi/2)^23 / 23! < 2e-18.
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

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_CORE_TRANSCENDENTAL_INL_H_
