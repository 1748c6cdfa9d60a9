#include "config/sweep/sobol.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace skybake::config {
namespace {

// The initial direction numbers are the first rows of `new-joe-kuo-6.21201`
// (https://web.maths.unsw.edu.au/~fkuo/sobol), whose licence asks for this notice:
//
// Copyright (c) 2008, Frances Y. Kuo and Stephen Joe
// All rights reserved.
//
// Redistribution and use in source and binary forms, with or without modification, are permitted
// provided that the following conditions are met:
//
//   * Redistributions of source code must retain the above copyright notice, this list of
//     conditions and the following disclaimer.
//   * Redistributions in binary form must reproduce the above copyright notice, this list of
//     conditions and the following disclaimer in the documentation and/or other materials provided
//     with the distribution.
//   * Neither the names of the copyright holders nor the names of the University of New South Wales
//     and the University of Waikato and its contributors may be used to endorse or promote products
//     derived from this software without specific prior written permission.
//
// THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS ``AS IS'' AND ANY EXPRESS OR IMPLIED
// WARRANTIES, INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS
// FOR A PARTICULAR PURPOSE ARE DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDERS BE LIABLE FOR
// ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT
// NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR SERVICES; LOSS OF USE, DATA, OR PROFITS; OR
// BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY, WHETHER IN CONTRACT, STRICT
// LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF THIS
// SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
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
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
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
