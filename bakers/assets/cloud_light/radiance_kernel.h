// The steps of radiance_sweep.h on rows of cells, for vectors. The results have the same bits with every
// instruction set: no number depends on its neighbours in a vector.
#pragma once

#include <array>
#include <cstddef>

namespace skybake::cloud_light {

// Rows are followed by so many floats more, which kernels may read and write.
inline constexpr std::size_t kRowSlack = 16;

// sums[i] += weight * values[i], for i < count.
void add_scaled(const float* values, float weight, std::size_t count, float* sums);

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
