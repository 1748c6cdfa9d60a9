// How many samples a march towards the sun may leave out, cell by cell.
//
// All such marches go one way, so that more is known of them than the distance to the nearest
// occupied cell in any direction: from anywhere in a cell c they pass through c + t d, a box that
// moves through the grid. Its corners cross from cell to cell at times that are the same for all
// cells; between two of them it lies in at most three cells along each axis, which are either all
// empty or not. So the time for which it meets none that is occupied is found by one look per
// crossing.
//
// The box is wider by kBeamMargin on each side, for the roundings of samples' places: t d is at
// most kLongestBeam voxels, a product and a sum of floats round it and the place by less than
// 4 * 2^-24 of 2 kLongestBeam, which is half of the margin.
#pragma once

#include <array>
#include <vector>

#include "bakers/math/vectors.h"
#include "bakers/render/cloud_medium.h"

namespace skybake {

inline constexpr double kLongestBeam = 4096;   // voxels
inline constexpr double kBeamMargin = 0x1p-8;  // voxels

// Per cell, x fastest: the number of samples after one in it that are in empty cells for sure, or
// -1 where it is occupied. `direction` is in voxels per step between samples; at most `samples` of
// them are made.
//
// Where cells do not divide a tile that repeats, or where beams or the volume are longer than
// kLongestBeam, by the reach of the grid alone.
std::vector<float> sun_leaps(const LeapGrid& grid, const std::array<int, 3>& voxels,
                             const glm::dvec3& direction, int samples, int threads);

}  // namespace skybake
