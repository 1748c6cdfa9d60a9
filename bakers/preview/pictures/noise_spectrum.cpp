#include "bakers/preview/pictures/noise_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "bakers/math/parallel.h"
#include "bakers/preview/pictures/fourier.h"

namespace skybake {
namespace {

using Line = std::vector<std::complex<float>>;

// The plane's two-dimensional transform, rows first.
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

// The frequency, in cycles per tile, that coefficient `i` of `count` stands for.
int cycles(std::size_t i, int count) {
    const int k = static_cast<int>(i);
    return std::min(k, count - k);
}

// Parseval: the coefficients' squares over the square of their number add up to the mean square.
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

// Evenly spread; the fewer, the larger they are: a preview's time is about that of 12 of 128 x 128.
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
