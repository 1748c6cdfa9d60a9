// The discrete Fourier transform, for pictures.
#pragma once

#include <complex>
#include <vector>

namespace skybake {

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

}  // namespace skybake
