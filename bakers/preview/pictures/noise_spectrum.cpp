#include "bakers/preview/pictures/noise_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "bakers/math/parallel.h"

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

namespace {

using Line = std::vector<std::complex<float>>;

// Returns the plane's two-dimensional transform, made along rows first.
std::vector<Line> transformed(const Image2<float>& plane) {
    const auto width = static_cast<std::size_t>(plane.width);
    const auto height = static_cast<std::size_t>(plane.height);
    FourierTransform along_rows(plane.width), along_columns(plane.height);
    std::vector<Line> columns(width, Line(height));
    Line row(width);
    for (std::size_t y = 0; y < height; ++y) {
        const float* const texels = plane.texels.data() + y * width;
        std::copy_n(texels, width, row.begin());
        along_rows(row);
        for (std::size_t x = 0; x < width; ++x) columns[x][y] = row[x];
    }
    for (Line& column : columns) along_columns(column);
    return columns;
}

// Returns the frequency, in cycles per tile, of coefficient `i` of `count`.
int cycles(std::size_t i, int count) {
    const int k = static_cast<int>(i);
    return std::min(k, count - k);
}

// By Parseval's theorem, the sum of the coefficients' squares divided by the square of their number
// is the mean square.
std::vector<double> spectrum_of(const Image2<float>& plane, std::size_t size) {
    const std::vector<Line> columns = transformed(plane);
    const double count = double{1} * plane.width * plane.height;
    std::vector<double> spectrum(size);
    for (std::size_t x = 0; x < columns.size(); ++x) {
        for (std::size_t y = 0; y < columns[x].size(); ++y) {
            const double wavenumber = std::hypot(cycles(x, plane.width), cycles(y, plane.height));
            const auto k = static_cast<std::size_t>(std::lround(wavenumber));
            if (k == 0 || k >= size) continue;
            const std::complex<double> coefficient(columns[x][y]);
            spectrum[k] += std::norm(coefficient) / (count * count);
        }
    }
    return spectrum;
}

struct Plane {
    int axis = 0;
    int at = 0;
};

// Returns evenly spaced planes. The larger they are, the fewer are taken, so that the time is about
// that of 12 planes of 128 x 128.
std::vector<Plane> planes_of(const std::array<int, 3>& size) {
    const int largest = *std::max_element(size.begin(), size.end());
    const int per_axis = std::clamp(512 / largest, 1, 4);
    std::vector<Plane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        const int count = size[static_cast<std::size_t>(axis)];
        for (int i = 0; i < per_axis; ++i)
            planes.push_back({axis, (2 * i + 1) * count / (2 * per_axis)});
    }
    return planes;
}

}  // namespace

std::vector<double> slice_spectrum(const VoxelView& volume, int channel) {
    const int smallest = *std::min_element(volume.size.begin(), volume.size.end());
    if (smallest < 2) return {};
    const std::size_t size = static_cast<std::size_t>(smallest) / 2 + 1;
    const std::vector<Plane> planes = planes_of(volume.size);
    std::vector<std::vector<double>> spectra(planes.size());
    parallel_for(static_cast<int>(planes.size()), 0, [&](int i) {
        const Plane& plane = planes[static_cast<std::size_t>(i)];
        spectra[static_cast<std::size_t>(i)] =
            spectrum_of(slice(volume, channel, plane.axis, plane.at), size);
    });
    std::vector<double> mean(size);
    for (const std::vector<double>& spectrum : spectra) {
        for (std::size_t k = 0; k < size; ++k) {
            mean[k] += spectrum[k] / static_cast<double>(spectra.size());
        }
    }
    return mean;
}

std::size_t spectrum_slices(const std::array<int, 3>& size) { return planes_of(size).size(); }

}  // namespace skybake
