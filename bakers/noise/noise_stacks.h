// The octaves of gradient noise and curl noise that a plan is made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"
#include "config/sections/noise.h"

namespace skybake::noise {

AxisCells axis_cells(const TileAxis& axis, int frequency);

// Returns the cells that a tile of a noise's coarsest octave has.
double lowest_cells(const Noise& noise);

// The weights over their sum.
std::vector<double> weights_of(const NoiseOctaves& octaves);

// Keys of one channel of one noise.
struct Keys {
    std::uint64_t noise_seed = 0;
    std::uint64_t channel_seed = 0;
    // Returns the key of octave i.
    std::uint64_t operator()(Purpose purpose, const NoiseOctaves& octaves, std::size_t i) const;
};

// Makes the octaves of one channel from what they share.
struct OctaveMaker {
    const std::array<TileAxis, 3>& axes;
    Keys keys;
    // The noise's loop in time.
    int period = 0;
    int time = 0;
    int time_cells = 1;
    double lowest_cells = 1;  // of the noise's coarsest octave, in a tile

    // Returns octave i, or its derivative along an axis.
    GradientOctave octave(const NoiseOctaves& octaves, std::size_t i, Purpose purpose,
                          double amplitude, int derivative_axis = -1) const;
    // Returns the cells of an octave along time. Small eddies turn over faster than large ones, in a time
    // that is their size to the power 2/3 (Kolmogorov 1941); sizes are the means of the axes.
    int cells_in_time(const std::array<int, 3>& frequency) const;
    // Returns how far the points of an octave's cells are along their paths.
    PathShift shift(const std::array<int, 3>& frequency) const;
};

// Returns the sum of octaves of gradient noise for a channel.
GradientStack gradient_stack(const NoiseChannel& channel, const OctaveMaker& maker);

// Returns one component of the curl of three potentials, curl_x = d potential_z / dy - d potential_y
// / dz and so on around, times `factor`. Derivatives are taken along the tile and divided by the
// greatest frequency of the first octave, so that values are of the order of 1.
GradientStack curl_stack(const NoiseOctaves& octaves, std::size_t component,
                         const std::array<Purpose, 3>& potentials, double factor,
                         const OctaveMaker& maker);

// Returns the displacement of a channel, in tiles of the volume, of which a noise has `repeats`.
WarpPlan warp_plan(const NoiseChannel& channel, const std::array<int, 3>& repeats,
                   const OctaveMaker& maker);

}  // namespace skybake::noise
