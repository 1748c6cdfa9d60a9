#include "bakers/air/particles/water_refractive_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

struct TableRow {
    double wavelength_um;
    double n;
    double k;
};

constexpr TableRow kTable[] = {
#include "bakers/air/particles/water_refractive_index.inc"
};

// Where Daimon & Masumura's formula hands over to the table.
constexpr double kLastOfFormula_um = 1.1;

// Daimon & Masumura 2007, table 4, 20 C: n^2 - 1 = sum of A w^2 / (w^2 - B).
double formula_index(double wavelength_um) {
    constexpr std::array<std::array<double, 2>, 4> kTerms = {
        std::array{5.684027565e-1, 5.101829712e-3}, std::array{1.726177391e-1, 1.821153936e-2},
        std::array{2.086189578e-2, 2.620722293e-2}, std::array{1.130748688e-1, 1.069792721e1}};
    const double square = wavelength_um * wavelength_um;
    double sum = 1;
    for (const auto& [a, b] : kTerms) sum += a * square / (square - b);
    return std::sqrt(sum);
}

}  // namespace

ComplexNumber water_refractive_index(config::Length wavelength) {
    const double um = wavelength.meters * 1e6;
    const auto* above = std::upper_bound(
        std::begin(kTable), std::end(kTable), um,
        [](double value, const TableRow& row) { return value < row.wavelength_um; });
    // Rounding of the unit may put the ends of the range outside of the table.
    const auto* high = std::clamp(above, std::begin(kTable) + 1, std::end(kTable) - 1);
    const auto* low = high - 1;
    const double share = (um - low->wavelength_um) / (high->wavelength_um - low->wavelength_um);
    const double log_k = (1 - share) * logarithm(low->k) + share * logarithm(high->k);
    if (um <= kLastOfFormula_um) return {formula_index(um), exponential(log_k)};
    const bool joint = low->wavelength_um < kLastOfFormula_um;
    const double from = joint ? kLastOfFormula_um : low->wavelength_um;
    const double n_from = joint ? formula_index(from) : low->n;
    const double n = n_from + (high->n - n_from) * (um - from) / (high->wavelength_um - from);
    return {n, exponential(log_k)};
}

}  // namespace skybake
