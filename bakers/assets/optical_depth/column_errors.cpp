#include "bakers/assets/optical_depth/column_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/field/certify_volume.h"
#include "bakers/field/error_statistics.h"
#include "bakers/math/low_discrepancy.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// The rest of a path after `length_km`.
ColumnPath rest_of(const Shell& shell, const ColumnPath& path, double length_km) {
    const double altitude = altitude_along_km(shell, path.altitude_km, path.s_km, length_km);
    return {std::clamp(altitude, 0.0, shell.thickness_km), path.s_km + length_km,
            path.length_km - length_km};
}

ColumnPath reversed(const Shell& shell, const ColumnPath& path) {
    const ColumnPath end = rest_of(shell, path, path.length_km);
    return {end.altitude_km, -end.s_km, path.length_km};
}

void add_differences(const std::vector<double>& a, const std::vector<double>& b,
                     ErrorStatistics& statistics) {
    for (std::size_t i = 0; i < a.size(); ++i) statistics.add(a[i] - b[i]);
}

}  // namespace

std::vector<double> transmittances(const std::vector<ColumnKind>& kinds, int channels,
                                   double length_km, const std::vector<double>& mean_densities) {
    const auto colours = static_cast<std::size_t>(channels);
    std::vector<double> depths((kinds.size() + 1) * colours);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        for (std::size_t c = 0; c < colours; ++c) {
            const double depth = kinds[k].extinction_per_km[c] * mean_densities[k] * length_km;
            depths[c] += depth;
            depths[(k + 1) * colours + c] = depth;
        }
    }
    for (double& depth : depths) depth = exponential(-depth);
    return depths;
}

StoredColumns::StoredColumns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, const Level& level, config::PixelType type)
    : kinds_(kinds), channels_(channels), table_(table), level_(level), type_(type) {}

std::vector<double> StoredColumns::transmittances_of(const ColumnPath& path) const {
    std::vector<double> means = look_up(level_, type_, table_.texture_coordinates(path));
    for (double& mean : means) mean = mean_density_of_stored(mean);
    return transmittances(kinds_, channels_, path.length_km, means);
}

std::vector<double> StoredColumns::exact_transmittances_of(const ColumnPath& path) const {
    std::vector<double> means;
    for (const ColumnKind& kind : kinds_) means.push_back(mean_density(kind, path));
    return transmittances(kinds_, channels_, path.length_km, means);
}

ColumnErrors measure_columns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, bool to_top, const Level& level,
                             config::PixelType type, int points) {
    const Shell& shell = table.geometry().shell;
    const StoredColumns stored(kinds, channels, table, level, type);
    const auto colours = static_cast<std::ptrdiff_t>(channels);
    ErrorStatistics together, additivity, symmetry;
    std::vector<ErrorStatistics> alone(kinds.size());
    for (int i = 0; i < points; ++i) {
        const ColumnPath path = table.path_at(table.lookup_place(low_discrepancy_point(i)));
        const std::vector<double> found = stored.transmittances_of(path);
        const std::vector<double> exact = stored.exact_transmittances_of(path);
        for (std::size_t j = 0; j < found.size(); ++j) {
            const std::size_t group = j / static_cast<std::size_t>(colours);
            (group == 0 ? together : alone[group - 1]).add(found[j] - exact[j]);
        }
        // Shares of the length, spread evenly and unlike the places: the golden section's
        // multiples.
        const double turn = (i + 1) * 0.61803398874989485;
        const double length = path.length_km * (turn - std::floor(turn));
        const ColumnPath first = {path.altitude_km, path.s_km, length};
        std::vector<double> product =
            to_top ? stored.exact_transmittances_of(first) : stored.transmittances_of(first);
        const std::vector<double> second = stored.transmittances_of(rest_of(shell, path, length));
        for (std::size_t j = 0; j < product.size(); ++j) product[j] *= second[j];
        add_differences(found, product, additivity);
        if (!to_top) {
            add_differences(found, stored.transmittances_of(reversed(shell, path)), symmetry);
        }
    }
    ColumnErrors errors{together.figures(), {}, additivity.figures(), symmetry.figures(), points};
    for (const ErrorStatistics& of_kind : alone) errors.alone.push_back(of_kind.figures());
    return errors;
}

}  // namespace skybake
