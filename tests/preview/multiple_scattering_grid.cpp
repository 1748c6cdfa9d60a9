#include "tests/preview/multiple_scattering_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake::test {
namespace {

constexpr std::size_t kLevel = 7;
constexpr TransmittanceField::Size kField = {256, 128};
constexpr double kPi = 3.14159265358979323846;

// Between p[1] and p[2].
double cubic(const std::array<double, 4>& p, double t) {
    const double slope_0 = 0.5 * (p[2] - p[0]);
    const double slope_1 = 0.5 * (p[3] - p[1]);
    const double rise = p[2] - p[1];
    const double value = p[1] + t * (slope_0 + t * ((3 * rise - 2 * slope_0 - slope_1) +
                                                    t * (slope_0 + slope_1 - 2 * rise)));
    return std::clamp(value, std::min(p[1], p[2]), std::max(p[1], p[2]));
}

// A position on an axis: the index before it, held within, and the way to the next.
struct Position {
    int index;
    double t;
};
Position position(double x, int count) {
    const double inside = std::clamp(x, 0.0, count - 1.0);
    const int index = std::min(static_cast<int>(inside), count - 2);
    return {index, inside - index};
}

}  // namespace

MultipleScatteringGrid::MultipleScatteringGrid(const Medium& medium, double first_sun_zenith,
                                               double last_sun_zenith, Size size, int threads)
    : thickness_km_(medium.thickness_km),
      first_sun_zenith_(first_sun_zenith),
      columns_per_radian_((size.columns - 1) / (last_sun_zenith - first_sun_zenith)),
      channels_(medium.channels),
      size_(size),
      psi_(static_cast<std::size_t>(size.columns * size.rows * medium.channels)) {
    std::vector<double> suns;
    for (int i = 0; i < size.columns; ++i) {
        const double zenith = first_sun_zenith + i / columns_per_radian_;
        suns.push_back(cosine_of_pi(std::clamp(zenith / kPi, 0.0, 1.0)));
    }
    const std::vector<double> altitudes = quadrature_altitudes_km(medium);
    const Sunlight sunlight(medium, altitudes, kField, threads);
    parallel_for(size.rows, threads, [&](int row) {
        const double y = static_cast<double>(row) / (size.rows - 1);
        const RowQuadrature quadrature = make_row_quadrature(
            medium, altitudes, y * y * thickness_km_, quadrature_levels()[kLevel]);
        integrate_row(medium, sunlight, quadrature, suns.data(), size.columns,
                      psi_.data() + static_cast<std::size_t>(row * channels_ * size.columns));
    });
}

double MultipleScatteringGrid::value(int channel, int column, int row) const {
    const int inside_column = std::clamp(column, 0, size_.columns - 1);
    const int inside_row = std::clamp(row, 0, size_.rows - 1);
    const int index = (inside_row * channels_ + channel) * size_.columns + inside_column;
    return psi_[static_cast<std::size_t>(index)];
}

Spectrum MultipleScatteringGrid::at(double altitude_km, double sun_cos_zenith) const {
    const double zenith = arc_cosine(std::clamp(sun_cos_zenith, -1.0, 1.0));
    const Position across =
        position((zenith - first_sun_zenith_) * columns_per_radian_, size_.columns);
    const Position up = position(
        std::sqrt(std::max(altitude_km, 0.0) / thickness_km_) * (size_.rows - 1), size_.rows);
    Spectrum result{};
    for (int c = 0; c < channels_; ++c) {
        std::array<double, 4> column{};
        for (int j = 0; j < 4; ++j) {
            std::array<double, 4> row{};
            for (int i = 0; i < 4; ++i) {
                row[static_cast<std::size_t>(i)] = value(c, across.index + i - 1, up.index + j - 1);
            }
            column[static_cast<std::size_t>(j)] = cubic(row, across.t);
        }
        result[static_cast<std::size_t>(c)] = cubic(column, up.t);
    }
    return result;
}

}  // namespace skybake::test
