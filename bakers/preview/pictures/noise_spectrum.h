// The spectrum of a volume: how its variance is distributed over frequencies.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {

// The discrete Fourier transform of lines of N numbers, for any N >= 1:
//
//   F(k) = sum_n f(n) exp(-2 pi i k n / N)
//
// The recursion of Cooley and Tukey over the prime factors of N takes N times the sum of these
// factors operations.
class FourierTransform {
  public:
    explicit FourierTransform(int size);

    // Replaces a line of `size` numbers by its transform.
    void operator()(std::vector<std::complex<float>>& line);

  private:
    void transform(const std::complex<float>* from, int stride, int count,
                   std::complex<float>* to) const;

    std::vector<std::complex<float>> roots_;  // exp(-2 pi i k / N)
    std::vector<std::complex<float>> result_;
};

// Returns the variance of a channel in waves of each frequency. Element k is the variance of waves
// whose wavenumber, in cycles per tile, rounds to k; element 0, the mean, is 0. The spectrum ends
// at the Nyquist frequency of the smallest axis. Its sum is the variance of the slices, without the
// waves beyond that frequency.
//
// The result is the mean over some slices across each axis. In slices, the frequencies of an
// isotropic noise are smeared a little to lower ones. The result is empty if an axis has fewer than
// 2 voxels.
std::vector<double> slice_spectrum(const VoxelView& volume, int channel);

// Returns the number of slices that slice_spectrum averages for a volume of this size.
std::size_t spectrum_slices(const std::array<int, 3>& size);

}  // namespace skybake
