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

// Hale & Querry 1973, table I.
constexpr TableRow kTable[] = {
    {0.200, 1.396, 1.10e-7}, {0.225, 1.373, 4.90e-8}, {0.250, 1.362, 3.35e-8},
    {0.275, 1.354, 2.35e-8}, {0.300, 1.349, 1.60e-8}, {0.325, 1.346, 1.08e-8},
    {0.350, 1.343, 6.50e-9}, {0.375, 1.341, 3.50e-9}, {0.400, 1.339, 1.86e-9},
    {0.425, 1.338, 1.30e-9}, {0.450, 1.337, 1.02e-9}, {0.475, 1.336, 9.35e-10},
    {0.500, 1.335, 1.00e-9}, {0.525, 1.334, 1.32e-9}, {0.550, 1.333, 1.96e-9},
    {0.575, 1.333, 3.60e-9}, {0.600, 1.332, 1.09e-8}, {0.625, 1.332, 1.39e-8},
    {0.650, 1.331, 1.64e-8}, {0.675, 1.331, 2.23e-8}, {0.700, 1.331, 3.35e-8},
    {0.725, 1.330, 9.15e-8}, {0.750, 1.330, 1.56e-7}, {0.775, 1.330, 1.48e-7},
    {0.800, 1.329, 1.25e-7}, {0.825, 1.329, 1.82e-7}, {0.850, 1.329, 2.93e-7},
    {0.875, 1.328, 3.91e-7}, {0.900, 1.328, 4.86e-7}, {0.925, 1.328, 1.06e-6},
    {0.950, 1.327, 2.93e-6}, {0.975, 1.327, 3.48e-6}, {1.0, 1.327, 2.89e-6},
    {1.2, 1.324, 9.89e-6},   {1.4, 1.321, 1.38e-4},   {1.6, 1.317, 8.55e-5},
    {1.8, 1.312, 1.15e-4},   {2.0, 1.306, 1.10e-3},   {2.2, 1.296, 2.89e-4},
    {2.4, 1.279, 9.56e-4},   {2.6, 1.242, 3.17e-3},   {2.65, 1.219, 6.70e-3},
    {2.70, 1.188, 0.019},    {2.75, 1.157, 0.059},    {2.80, 1.142, 0.115},
    {2.85, 1.149, 0.185},    {2.90, 1.201, 0.268},    {2.95, 1.292, 0.298},
    {3.00, 1.371, 0.272},    {3.05, 1.426, 0.240},    {3.10, 1.467, 0.192},
    {3.15, 1.483, 0.135},    {3.20, 1.478, 0.0924},   {3.25, 1.467, 0.0610},
    {3.30, 1.450, 0.0368},   {3.35, 1.432, 0.0261},   {3.40, 1.420, 0.0195},
    {3.45, 1.410, 0.0132},   {3.50, 1.400, 0.0094},   {3.6, 1.385, 0.00515},
    {3.7, 1.374, 0.00360},   {3.8, 1.364, 0.00340},   {3.9, 1.357, 0.00380},
    {4.0, 1.351, 0.00460}};

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
