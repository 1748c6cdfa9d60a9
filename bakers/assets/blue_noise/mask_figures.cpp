#include "bakers/assets/blue_noise/mask_figures.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "bakers/field/certify.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

using Wave = std::complex<double>;

// exp(-2 pi i n / size) for n = 0 to size - 1.
std::vector<Wave> unit_roots(std::size_t size) {
    std::vector<Wave> roots(size);
    for (std::size_t n = 0; n < size; ++n) {
        const double turns = static_cast<double>(n) / static_cast<double>(size);
        roots[n] = {cosine_of_turns(turns), -cosine_of_turns(turns - 0.25)};
    }
    return roots;
}

// The wavenumbers of an axis, from below 0 to above 0, that are low.
int largest_low(std::size_t size) {
    const double edge = kLowFrequency * static_cast<double>(size);
    const auto below = static_cast<int>(std::ceil(edge)) - 1;
    return std::min(below, static_cast<int>(size) / 2);
}

std::size_t wrapped(int wavenumber, std::size_t size) {
    const auto count = static_cast<int>(size);
    return static_cast<std::size_t>((wavenumber % count + count) % count);
}

// The coefficient of one wave along a line of values, `stride` apart.
template <class Value>
Wave coefficient(const Value* values, std::size_t stride, const std::vector<Wave>& roots,
                 std::size_t wavenumber) {
    Wave sum = 0;
    std::size_t root = 0;
    for (std::size_t n = 0; n < roots.size(); ++n) {
        const Wave& factor = roots[root];
        const Value& value = values[n * stride];
        sum += value * factor;
        root += wavenumber;
        if (root >= roots.size()) root -= roots.size();
    }
    return sum;
}

// Sums of squares of coefficients, and how many there are.
struct Power {
    double low = 0;
    double all = 0;
    double low_count = 0;
    double all_count = 0;

    double ratio() const {
        if (low_count == 0 || all == 0) return 0;
        return (low / low_count) / (all / all_count);
    }
};

// By Parseval's theorem, the power of all waves but the mean is n times the sum of the squares of
// the values' differences from their mean.
void add_all(const float* values, std::size_t count, std::size_t stride, Power& power) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += double{values[i * stride]};
    const double mean = sum / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double difference = double{values[i * stride]} - mean;
        power.all += static_cast<double>(count) * difference * difference;
    }
    power.all_count += static_cast<double>(count - 1);
}

void add_low_of_frame(const float* values, const std::vector<Wave>& roots_x,
                      const std::vector<Wave>& roots_y, Power& power) {
    const std::size_t width = roots_x.size();
    const std::size_t height = roots_y.size();
    const int most_x = largest_low(width);
    const int most_y = largest_low(height);
    std::vector<double> row(width);
    std::vector<Wave> column(height);
    for (int k = -most_x; k <= most_x; ++k) {
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) row[x] = double{values[y * width + x]};
            column[y] = coefficient(row.data(), 1, roots_x, wrapped(k, width));
        }
        for (int l = -most_y; l <= most_y; ++l) {
            const double across = k / static_cast<double>(width);
            const double up = l / static_cast<double>(height);
            const double frequency = std::sqrt(across * across + up * up);
            if ((k == 0 && l == 0) || frequency >= kLowFrequency) continue;
            power.low += std::norm(coefficient(column.data(), 1, roots_y, wrapped(l, height)));
            ++power.low_count;
        }
    }
}

double window_mean(const float* frame, const std::array<int, 3>& size, int left, int lower) {
    const int columns = std::min(kMaskWindow, size[0]);
    const int rows = std::min(kMaskWindow, size[1]);
    double sum = 0;
    for (int y = 0; y < rows; ++y) {
        const float* row = frame + static_cast<std::ptrdiff_t>((lower + y) % size[1]) * size[0];
        for (int x = 0; x < columns; ++x) sum += double{row[(left + x) % size[0]]};
    }
    return sum / (columns * rows);
}

}  // namespace

ErrorFigures unevenness(const MaskView& mask) {
    ErrorStatistics errors;
    const auto count = static_cast<std::ptrdiff_t>(mask.pixels());
    for (std::size_t frame = 0; frame < mask.frames(); ++frame) {
        const auto first = mask.values->begin() + static_cast<std::ptrdiff_t>(frame) * count;
        std::vector<float> sorted(first, first + count);
        std::ranges::sort(sorted);
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            errors.add(double{sorted[i]} -
                       (static_cast<double>(i) + 0.5) / static_cast<double>(count));
        }
    }
    return errors.figures();
}

ErrorFigures window_error(const MaskView& mask) {
    ErrorStatistics errors;
    for (std::size_t frame = 0; frame < mask.frames(); ++frame) {
        const float* values = mask.values->data() + frame * mask.pixels();
        for (int y = 0; y < mask.size[1]; ++y) {
            for (int x = 0; x < mask.size[0]; ++x) {
                errors.add(window_mean(values, mask.size, x, y) - 0.5);
            }
        }
    }
    return errors.figures();
}

double low_power_of_frames(const MaskView& mask) {
    const auto roots_x = unit_roots(static_cast<std::size_t>(mask.size[0]));
    const auto roots_y = unit_roots(static_cast<std::size_t>(mask.size[1]));
    Power power;
    for (std::size_t frame = 0; frame < mask.frames(); ++frame) {
        const float* values = mask.values->data() + frame * mask.pixels();
        add_all(values, mask.pixels(), 1, power);
        add_low_of_frame(values, roots_x, roots_y, power);
    }
    return power.ratio();
}

double low_power_over_time(const MaskView& mask) {
    const std::vector<Wave> roots = unit_roots(mask.frames());
    const int most = largest_low(mask.frames());
    Power power;
    for (std::size_t pixel = 0; pixel < mask.pixels(); ++pixel) {
        const float* values = mask.values->data() + pixel;
        if (most > 0) add_all(values, mask.frames(), mask.pixels(), power);
        for (int k = 1; k <= most; ++k) {
            std::vector<double> line(mask.frames());
            for (std::size_t t = 0; t < line.size(); ++t) {
                line[t] = double{values[t * mask.pixels()]};
            }
            power.low += 2 * std::norm(coefficient(line.data(), 1, roots, wrapped(k, line.size())));
            power.low_count += 2;
        }
    }
    return power.ratio();
}

}  // namespace skybake
