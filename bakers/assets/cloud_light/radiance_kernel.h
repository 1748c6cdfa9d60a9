// The steps of radiance_sweep.h on rows of cells, for vectors. The results have the same bits with every
// instruction set: no number depends on its neighbours in a vector.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bakers/math/harmonics.h"

namespace skybake::cloud_light {

// Rows are followed by so many floats more, which kernels may read and write.
inline constexpr std::size_t kRowSlack = 16;

// A row of each coefficient.
template <class Float>
using CoefficientRows = std::array<Float*, kMostHarmonics>;

// Harmonics of the first of two directions whose azimuths are opposite. Coefficient l^2 + l + m has the other sign
// in the second where its index, and so its order m, is odd.
struct PairHarmonics {
    std::array<float, kMostHarmonics> values{};
    std::size_t count = 0;
};

// Writes the sums of coefficients times harmonics for both directions.
void send_out(const PairHarmonics& pair, const CoefficientRows<const float>& rows,
              std::size_t count, float* first, float* second);

// What rays in the directions of a pair meet in a row, and its weight in each coefficient.
struct PairLight {
    PairHarmonics weights;
    const float* first = nullptr;
    const float* second = nullptr;
};
inline constexpr std::size_t kMostPairs = 16;

// Adds the light of 1 to kMostPairs pairs times its weights.
void gather(std::span<const PairLight> pairs, std::size_t count,
            const CoefficientRows<float>& rows);

// One step of a row of rays. `light` are four rows before the step, of which the weights are shares.
struct RowStep {
    std::array<const float*, 4> light{};
    std::array<float, 4> share{};
    const float* passing = nullptr;       // exp(-x), x the optical depth of the step
    const float* mean_passing = nullptr;  // (1 - exp(-x)) / x
    const float* source = nullptr;
    float part = 1;  // of this step in the cell's mean
};

// With L the light that arrives: after[i] = S + (L - S) exp(-x) and
// mean[i] += part * (S + (L - S) (1 - exp(-x)) / x).
void step_row(const RowStep& step, std::size_t count, float* after, float* mean);

}  // namespace skybake::cloud_light
