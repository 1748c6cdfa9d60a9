// Calculates how many samples a march towards the sun may skip, for each cell.
//
// All marches towards the sun have the same direction, so they can skip more than the distance to
// the nearest occupied cell in any direction allows. The places that marches from anywhere in a
// cell c reach at time t are the box c + t d, which moves through the grid. Its corners cross into
// other cells at times that are the same for all c. Between two crossings, the box lies in at most
// three cells along each axis. So one test per crossing finds the time up to which the box meets no
// occupied cell.
//
// The box is wider by kBeamMargin on each side, to allow for rounding of samples' places: t d is at
// most kLongestBeam voxels, and a product and a sum in float round it and the place by less than 4
// * 2^-24 of 2 kLongestBeam, which is half of the margin.
#pragma once

#include <array>
#include <vector>

#include "bakers/march/cloud_medium.h"
#include "bakers/math/vectors.h"

namespace skybake {

inline constexpr double kLongestBeam = 4096;   // voxels
inline constexpr double kBeamMargin = 0x1p-8;  // voxels

// Returns one number per cell, x fastest: how many samples after a sample in this cell are
// certainly in empty cells, or -1 if the cell is occupied. `direction` is in voxels per step
// between samples. A march has at most `samples` samples.
//
// If cells do not divide a tile that repeats, or if the march or the volume is longer than
// kLongestBeam, the result follows from the reach of the grid alone.
std::vector<float> sun_leaps(const LeapGrid& grid, const std::array<int, 3>& voxels,
                             const glm::dvec3& direction, int samples, int threads);

}  // namespace skybake
