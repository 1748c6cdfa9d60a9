#include "bakers/preview/pictures/fourier_transform.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace skybake {
namespace {

using Complex = std::complex<float>;

int smallest_factor(int n) {
    for (int factor = 2; factor * factor <= n; ++factor) {
        if (n % factor == 0) return factor;
    }
    return n;
}

// Multiplies complex numbers. The product of std::complex is slower, because it checks for
// infinities.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

FourierTransform::FourierTransform(int size) : result_(static_cast<std::size_t>(size)) {
    for (int k = 0; k < size; ++k) {
        const double angle = -2 * std::numbers::pi * k / size;
        roots_.emplace_back(static_cast<float>(std::cos(angle)),
                            static_cast<float>(std::sin(angle)));
    }
}

void FourierTransform::operator()(std::vector<Complex>& line) {
    transform(line.data(), 1, static_cast<int>(line.size()), result_.data());
    line.swap(result_);
}

// The transform of from[0], from[stride], ... is a sum over the transforms of its `factor`
// subsequences: F(k) = sum_j exp(-2 pi i j k / count) F_j(k mod (count / factor)).
void FourierTransform::transform(const Complex* from, int stride, int count, Complex* to) const {
    if (count == 1) {
        *to = *from;
        return;
    }
    const int factor = smallest_factor(count);
    const int part = count / factor;
    for (int j = 0; j < factor; ++j) {
        transform(from + static_cast<std::ptrdiff_t>(j) * stride, stride * factor, part,
                  to + static_cast<std::ptrdiff_t>(j) * part);
    }
    std::vector<Complex> terms(static_cast<std::size_t>(factor));
    for (int k = 0; k < part; ++k) {
        for (int j = 0; j < factor; ++j) terms[static_cast<std::size_t>(j)] = to[j * part + k];
        for (int i = 0; i < factor; ++i) {
            const int frequency = i * part + k;
            Complex sum = terms[0];
            for (int j = 1; j < factor; ++j) {
                const auto turn = static_cast<std::size_t>(static_cast<std::int64_t>(j) *
                                                           frequency % count * stride);
                sum += product(terms[static_cast<std::size_t>(j)], roots_[turn]);
            }
            to[frequency] = sum;
        }
    }
}

std::vector<std::vector<Complex>> transformed(const Image2<float>& plane) {
    const auto width = static_cast<std::size_t>(plane.width);
    const auto height = static_cast<std::size_t>(plane.height);
    FourierTransform along_rows(plane.width), along_columns(plane.height);
    std::vector<std::vector<Complex>> columns(width, std::vector<Complex>(height));
    std::vector<Complex> row(width);
    for (std::size_t y = 0; y < height; ++y) {
        const float* const texels = plane.texels.data() + y * width;
        std::copy_n(texels, width, row.begin());
        along_rows(row);
        for (std::size_t x = 0; x < width; ++x) columns[x][y] = row[x];
    }
    for (std::vector<Complex>& column : columns) along_columns(column);
    return columns;
}

}  // namespace skybake
