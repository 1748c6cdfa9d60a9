// How a volume's variation is shared among frequencies.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {

// The discrete Fourier transform:
//
// F(k) = sum_n f(n) exp(-2 pi i k n / N) of lines of N numbers, N of any size >= 1, by Cooley and
// Tukey's recursion over the prime factors of N: N times their sum operations.
class FourierTransform {
  public:
    explicit FourierTransform(int size);

    // Replaces the line, of `size` numbers.
    void operator()(std::vector<std::complex<float>>& line);

  private:
    void transform(const std::complex<float>* from, int stride, int count,
                   std::complex<float>* to) const;

    std::vector<std::complex<float>> roots_;  // exp(-2 pi i k / N)
    std::vector<std::complex<float>> result_;
};

// The variance of a channel in waves of each frequency: element k is that of the waves whose
// wavenumber, in cycles per tile, rounds to k, so that together they are the variance of the slices
// but for the corners beyond the smallest axis' Nyquist frequency, which ends the spectrum. Element
// 0, the mean, is 0. The mean over some slices across each axis: slices of an isotropic noise show
// its frequencies a little smeared to lower ones. Empty where an axis has fewer than 2 voxels.
std::vector<double> slice_spectrum(const VoxelView& volume, int channel);

// How many slices of a volume of this size that is the mean of.
std::size_t spectrum_slices(const std::array<int, 3>& size);

}  // namespace skybake
