// Sums of rows of voxels, for vectors. The results have the same bits with every instruction set:
// each sum has its own lane, and its terms are added in the order given.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bakers/air/cloud_phase.h"

namespace skybake::cloud_light {

// Rows may begin anywhere in memory.
inline constexpr std::size_t kDepthBlock = 64;

struct WeightedRow {
    const float* values = nullptr;
    float weight = 0;
};

// sums[i] = sum over rows of weight * values[i], for i < kDepthBlock.
void add_rows(std::span<const WeightedRow> rows, float* sums);

// Eight rows between which values are filtered: x fastest, then y, then z.
struct FilteredRow {
    std::array<const float*, 8> corners{};
    std::array<float, 3> share{};
    float weight = 0;
};

// sums[i] = sum over rows of weight * density(filtered value i), for i < kDepthBlock. The optics have
// an edge.
void add_filtered_rows(std::span<const FilteredRow> rows, const CloudOptics& optics, float* sums);

}  // namespace skybake::cloud_light
