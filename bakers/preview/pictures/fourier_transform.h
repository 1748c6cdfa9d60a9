// The discrete Fourier transform of lines and planes, for pictures of spectra.
#pragma once

#include <complex>
#include <vector>

#include "bakers/field/image.h"

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

// Returns the columns of a plane's transform.
std::vector<std::vector<std::complex<float>>> transformed(const Image2<float>& plane);

}  // namespace skybake
