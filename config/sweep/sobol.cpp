#include "config/sweep/sobol.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace skybake::config {
namespace {

constexpr int bits = 32;

using DirectionNumbers = std::array<std::uint32_t, bits>;

// This is a primitive polynomial over GF(2), x^degree + a_1 x^(degree - 1) + ... + 1, whose inner
// coefficients are the bits of `inner`, and the first m_i of its recurrence.
struct Polynomial {
    int degree;
    unsigned inner;
    std::array<std::uint32_t, 6> initial;
};

constexpr std::array<Polynomial, sobol_dimensions - 1> polynomials = {{
#include "config/sweep/sobol_polynomials.inc"
}};

// Returns v_i = m_i 2^(32 - i). The code states the recurrence of the m_i, which the polynomial
// gives, in terms of the v_i.
constexpr DirectionNumbers direction_numbers(const Polynomial& polynomial) {
    DirectionNumbers v{};
    for (int i = 0; i < bits; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (i < polynomial.degree) {
            v[at] = polynomial.initial[at] << (bits - 1 - i);
            continue;
        }
        const auto first = static_cast<std::size_t>(i - polynomial.degree);
        v[at] = v[first] ^ (v[first] >> polynomial.degree);
        for (int k = 1; k < polynomial.degree; ++k) {
            const bool present = (polynomial.inner >> (polynomial.degree - 1 - k) & 1) != 0;
            if (present) v[at] ^= v[static_cast<std::size_t>(i - k)];
        }
    }
    return v;
}

constexpr std::array<DirectionNumbers, sobol_dimensions> all_direction_numbers() {
    std::array<DirectionNumbers, sobol_dimensions> all{};
    // The first dimension is van der Corput's sequence: every m_i is 1.
    for (std::size_t i = 0; i < bits; ++i) all[0][i] = std::uint32_t{1} << (bits - 1 - i);
    for (std::size_t d = 1; d < all.size(); ++d) all[d] = direction_numbers(polynomials[d - 1]);
    return all;
}

constexpr auto directions = all_direction_numbers();

}  // namespace

std::uint32_t sobol_bits(std::uint32_t index, int dimension) {
    assert(dimension >= 0 && dimension < sobol_dimensions);
    const DirectionNumbers& v = directions[static_cast<std::size_t>(dimension)];
    std::uint32_t x = 0;
    for (std::size_t i = 0; index != 0; ++i, index >>= 1) {
        x ^= v[i] & (0 - (index & 1));  // no branch: these bits are hard to predict
    }
    return x;
}

std::uint32_t sobol_direction(int bit, int dimension) {
    assert(bit >= 0 && bit < bits && dimension >= 0 && dimension < sobol_dimensions);
    return directions[static_cast<std::size_t>(dimension)][static_cast<std::size_t>(bit)];
}

double sobol_coordinate(std::uint32_t index, int dimension) {
    // The points are in the order of Gray's code (Antonov and Saleev 1979), as in Joe and Kuo's own
    // program.
    constexpr double two_to_32 = 4294967296.0;
    return sobol_bits(index ^ (index >> 1), dimension) / two_to_32;
}

}  // namespace skybake::config
