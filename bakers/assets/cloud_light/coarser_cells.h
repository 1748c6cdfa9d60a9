// Cells of a layer taken together, and light between grids of them.
#pragma once

#include <array>

#include "bakers/assets/cloud_light/radiance_sweep.h"
#include "bakers/math/bake_options.h"

namespace skybake::cloud_light {

// How many cells a coarser one takes along each axis.
using CellFactors = std::array<int, 3>;
inline constexpr CellFactors kSameCells = {1, 1, 1};

// Along x and y, where cells repeat, the smallest of 2, 3 and 5 that divides them and leaves two, or 1. Along z 2:
// the highest cells may reach above the layer.
CellFactors coarser_factors(const std::array<int, 3>& size);

// Cells that have the mean extinction.
LayerCells coarser_cells(const LayerCells& cells, const CellFactors& factors);

// Returns the mean of light per extinction in coarser cells, weighted by extinction, so that they send out as much;
// 0 where nothing does.
CellFields mean_light(const CellFields& light, const CellFields& extinction,
                      const CellFactors& factors, const BakeOptions& options);

// Adds a weight times light of coarser cells, interpolated linearly between their centres.
void add_interpolated(const CellFields& coarse, const CellFactors& factors, float weight,
                      CellFields& fine, const BakeOptions& options);

}  // namespace skybake::cloud_light
