#include "bakers/assets/optical_depth/column_kinds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/particles/layer_phase.h"
#include "bakers/air/ray.h"
#include "bakers/field/certify.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

double mean_height_km(const Medium& unit) {
    if (!unit.exponential_layers.empty()) return unit.exponential_layers.front().scale_height_km;
    double column = 0;
    double greatest = 0;
    for (const PiecewiseLayer& layer : unit.piecewise_layers) {
        for (const LinearPiece& piece : layer.pieces) {
            column += 0.5 * (piece.density_at_bottom + piece.density_at_top) *
                      (piece.top_km - piece.bottom_km);
            greatest = std::max({greatest, piece.density_at_bottom, piece.density_at_top});
        }
    }
    return greatest > 0 ? column / greatest : unit.thickness_km;
}

ColumnKind make_kind(config::Atmosphere atmosphere, const config::Layer& layer) {
    ColumnKind kind;
    kind.name = layer.name;
    kind.layer = layer;
    const config::Layer resolved = with_coefficients(layer);
    for (std::size_t c = 0; c < resolved.extinction.size() && c < kMaxChannels; ++c) {
        kind.extinction_per_km[c] = resolved.extinction[c].per_kilometer();
    }
    config::Layer unit = layer;
    unit.phase = config::Phase::isotropic;
    unit.scattering = {{0.0}};
    unit.extinction = {{1e-3}};  // per metre
    atmosphere.ground_albedo = {0};
    atmosphere.layers = {unit};
    kind.unit = make_medium(atmosphere);
    kind.mean_height_km = mean_height_km(kind.unit);
    return kind;
}

template <class AltitudeOf>
std::vector<double> boundaries_km(double max_altitude_km, int count, const AltitudeOf& altitude) {
    std::vector<double> shells;
    for (int i = 0; i < count; ++i) shells.push_back(altitude(static_cast<double>(i) / count));
    shells.push_back(max_altitude_km);
    return shells;
}

// The rest of a path after `length_km`.
ColumnPath rest_of(const Shell& shell, const ColumnPath& path, double length_km) {
    return {end_altitude_km(shell, {path.altitude_km, path.s_km, length_km}), path.s_km + length_km,
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

// A stored table with the lookups that a runtime makes. Values are in the order of transmittances().
struct StoredColumns {
    const std::vector<ColumnKind>& kinds;
    int channels;
    const ColumnTable& table;
    const Level& level;
    PixelType type;

    std::vector<double> transmittances_of(const ColumnPath& path) const {
        std::vector<double> means = look_up(level, type, table.texture_coordinates(path));
        for (double& mean : means) mean = mean_density_of_stored(mean);
        return transmittances(kinds, channels, path.length_km, means);
    }

    std::vector<double> exact_transmittances_of(const ColumnPath& path) const {
        std::vector<double> means;
        for (const ColumnKind& kind : kinds) means.push_back(mean_density(kind, path));
        return transmittances(kinds, channels, path.length_km, means);
    }
};

}  // namespace

std::vector<ColumnKind> make_column_kinds(const config::Atmosphere& atmosphere,
                                          const std::vector<std::string>& names) {
    std::vector<ColumnKind> kinds;
    for (const std::string& name : names) {
        for (const config::Layer& layer : atmosphere.layers) {
            if (layer.name == name) kinds.push_back(make_kind(atmosphere, layer));
        }
    }
    return kinds;
}

ColumnGeometry column_geometry(const std::vector<ColumnKind>& kinds) {
    ColumnGeometry geometry;
    geometry.shell = shell_of(kinds.front().unit);
    geometry.scale.thickness_km = geometry.shell.thickness_km;
    geometry.scale.fine_km = geometry.shell.thickness_km;
    for (const ColumnKind& kind : kinds) {
        geometry.scale.fine_km = std::min(geometry.scale.fine_km, 2 * kind.mean_height_km);
    }
    return geometry;
}

double density_of(const ColumnKind& kind, double altitude_km) {
    return extinction_at(kind.unit, altitude_km)[0];
}

double mean_density(const ColumnKind& kind, const ColumnPath& path) {
    if (path.length_km <= 0) return density_of(kind, path.altitude_km);
    const double r = kind.unit.ground_radius_km + path.altitude_km;
    return optical_depth_along(kind.unit, path.altitude_km, path.s_km / r, path.length_km)[0] /
           path.length_km;
}

std::vector<double> mean_densities(const ColumnKind& kind, const std::vector<ColumnPath>& paths) {
    std::vector<double> altitudes, s, lengths;
    for (const ColumnPath& path : paths) {
        const double r = kind.unit.ground_radius_km + path.altitude_km;
        altitudes.push_back(path.altitude_km);
        s.push_back(r * (path.s_km / r));  // rounded as mean_density has it, by way of the cosine
        lengths.push_back(path.length_km);
    }
    std::vector<double> means(paths.size());
    optical_depth_along(kind.unit, altitudes, s, lengths, means.data());
    for (std::size_t i = 0; i < means.size(); ++i) {
        means[i] = lengths[i] > 0 ? means[i] / lengths[i] : density_of(kind, altitudes[i]);
    }
    return means;
}

double reference_mean_density(const ColumnKind& kind, const ColumnPath& path) {
    constexpr double kRelative = 1e-10;
    if (path.length_km <= 0) return density_of(kind, path.altitude_km);
    return reference_optical_depth_along(kind.unit, path.altitude_km, path.s_km, path.length_km,
                                         kRelative)[0] /
           path.length_km;
}

double mean_scale_height_km(const std::vector<ColumnKind>& kinds) {
    double weighted = 0;
    double weights = 0;
    for (const ColumnKind& kind : kinds) {
        const Spectrum& of = kind.extinction_per_km;
        const double extinction = of.x + of.y + of.z;
        weighted += extinction * kind.mean_height_km;
        weights += extinction;
    }
    return weights > 0 ? weighted / weights : kinds.front().mean_height_km;
}

std::vector<double> equal_attenuation_shells_km(double mean_scale_height_km, double max_altitude_km,
                                                int count) {
    assert(mean_scale_height_km > 0 && count >= 1);
    const double whole = 1 - exponential(-max_altitude_km / mean_scale_height_km);
    return boundaries_km(max_altitude_km, count, [&](double part) {
        return part > 0 ? -mean_scale_height_km * logarithm(1 - part * whole) : 0.0;
    });
}

std::vector<double> uniform_shells_km(double max_altitude_km, int count) {
    assert(count >= 1);
    return boundaries_km(max_altitude_km, count,
                         [&](double part) { return part * max_altitude_km; });
}

double sampled_mean_density(const ColumnKind& kind, const std::vector<double>& shells_km,
                            const ColumnPath& path) {
    if (path.length_km <= 0) return density_of(kind, path.altitude_km);
    const Shell shell = shell_of(kind.unit);
    const std::vector<RayBreak> breaks =
        ray_breaks(shell, path.altitude_km, path.s_km, path.length_km, shells_km);
    double column = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double from = breaks[i].distance_km;
        const double to = breaks[i + 1].distance_km;
        const double altitude =
            altitude_along_km(shell, path.altitude_km, path.s_km, 0.5 * (from + to));
        if (altitude < shells_km.back()) column += (to - from) * density_of(kind, altitude);
    }
    return column / path.length_km;
}

std::vector<double> transmittances(const std::vector<ColumnKind>& kinds, int channels,
                                   double length_km, const std::vector<double>& mean_densities) {
    assert(mean_densities.size() == kinds.size());
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

ColumnErrors measure_columns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, bool to_top, const Level& level,
                             PixelType type, int points) {
    const Shell& shell = table.geometry().shell;
    const StoredColumns stored = {kinds, channels, table, level, type};
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
