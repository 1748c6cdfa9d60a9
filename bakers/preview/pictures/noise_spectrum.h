// How a volume's variation is shared among frequencies.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/preview/pictures/volume_slices.h"

namespace skybake {

// The variance of a channel in waves of each frequency: element k is that of the waves whose
// wavenumber, in cycles per tile, rounds to k, so that together they are the variance of the slices
// but for the corners beyond the smallest axis' Nyquist frequency, which ends the spectrum. Element
// 0, the mean, is 0. The mean over some slices across each axis: slices of an isotropic noise show
// its frequencies a little smeared to lower ones. Empty where an axis has fewer than 2 voxels.
std::vector<double> slice_spectrum(const VoxelView& volume, int channel);

// How many slices of a volume of this size that is the mean of.
std::size_t spectrum_slices(const std::array<int, 3>& size);

}  // namespace skybake
