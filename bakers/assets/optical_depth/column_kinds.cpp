#include "bakers/assets/optical_depth/column_kinds.h"

#include <algorithm>

#include "bakers/air/optical_depth.h"
#include "bakers/air/optical_depth_reference.h"
#include "bakers/air/particles/layer_phase.h"

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

double reference_mean_density(const ColumnKind& kind, const ColumnPath& path) {
    constexpr double kRelative = 1e-10;
    if (path.length_km <= 0) return density_of(kind, path.altitude_km);
    return reference_optical_depth_along(kind.unit, path.altitude_km, path.s_km, path.length_km,
                                         kRelative)[0] /
           path.length_km;
}

}  // namespace skybake
