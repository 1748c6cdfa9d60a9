#include "bakers/assets/optical_depth/shell_sampling.h"

#include "bakers/air/ray_breaks.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

template <class AltitudeOf>
std::vector<double> boundaries_km(double max_altitude_km, int count, const AltitudeOf& altitude) {
    std::vector<double> shells;
    for (int i = 0; i < count; ++i) shells.push_back(altitude(static_cast<double>(i) / count));
    shells.push_back(max_altitude_km);
    return shells;
}

}  // namespace

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
    const double whole = 1 - exponential(-max_altitude_km / mean_scale_height_km);
    return boundaries_km(max_altitude_km, count, [&](double part) {
        return part > 0 ? -mean_scale_height_km * logarithm(1 - part * whole) : 0.0;
    });
}

std::vector<double> uniform_shells_km(double max_altitude_km, int count) {
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

}  // namespace skybake
