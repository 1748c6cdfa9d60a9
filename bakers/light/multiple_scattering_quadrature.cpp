#include "bakers/light/multiple_scattering_quadrature.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/air/quadrature_rules.h"
#include "bakers/air/ray.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Where tables have all but so much of the extinction, rays are cut at their altitudes alone.
constexpr double kShareOfTables = 0.999;

double smallest(const Spectrum& values, int channels) {
    return *std::min_element(data(values), data(values) + channels);
}

// Azimuths needed where sunlight varies over the azimuth as it does over a turn of the vertical by
// `swing`, in units of the dip of the shell's top: n nodes leave about swing^(2 n).
int azimuth_count(double share, double swing, double tolerance) {
    double power = swing * swing;
    for (int n = 1; n < 8; n *= 2) {
        if (share * power <= tolerance) return n;
        power *= power;
    }
    return 8;
}

}  // namespace

const std::vector<QuadratureLevel>& quadrature_levels() {
    static const std::vector<QuadratureLevel> levels = {
        {4, 5e-1, 1e-1},  {5, 3e-1, 1e-1},  {6, 3.5e-1, 1e-1}, {6, 1e-1, 2e-2},
        {8, 3e-2, 5e-3},  {9, 2e-2, 2e-3},  {10, 1e-2, 1e-3},  {14, 3e-3, 3e-4},
        {20, 1e-3, 1e-4}, {28, 3e-4, 3e-5}, {40, 1e-4, 1e-5},
    };
    return levels;
}

double lookups_per_texel(const QuadratureLevel& level) {
    return 2.0 * level.zenith_nodes * 8 * exponential(logarithm(level.ray_tolerance) / -3);
}

std::vector<double> quadrature_altitudes_km(const Medium& medium) {
    std::vector<double> altitudes = break_altitudes_km(medium, {0.5, 1, 2, 3.5, 6, 10});
    double widest = 0;
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        widest = std::max(widest, layer.scale_height_km);
    }
    // Above the tenth scale height of all other layers only the widest one is left, and rays within
    // it see nothing else but tables. It is empty in double precision above 40.
    Medium tables = medium;
    tables.exponential_layers.clear();
    for (const double count : {14, 18, 22, 26, 30, 35, 40}) {
        const double altitude = count * widest;
        if (!(altitude > 0 && altitude < medium.thickness_km)) break;
        const Spectrum share =
            share_of(extinction_at(tables, altitude), extinction_at(medium, altitude));
        if (!(smallest(share, medium.channels) > kShareOfTables)) altitudes.push_back(altitude);
    }
    std::ranges::sort(altitudes);
    altitudes.erase(std::unique(altitudes.begin(), altitudes.end()), altitudes.end());
    return altitudes;
}

RowQuadrature make_row_quadrature(const Medium& medium, const std::vector<double>& altitudes_km,
                                  double altitude_km, const QuadratureLevel& level) {
    assert(std::ranges::is_sorted(altitudes_km));
    assert(level.zenith_nodes >= 1);
    const Shell shell = shell_of(medium);
    const double r = shell.ground_radius_km + altitude_km;
    const double horizon = -horizon_distance_km(shell, altitude_km) / r;
    const double dip = std::min(1.0, std::sqrt(shell.thickness_km / shell.ground_radius_km));

    RaySphere sphere = trace_all_directions(
        medium, altitudes_km, altitude_km,
        zenith_parts(horizon, altitude_km / shell.thickness_km, level.zenith_nodes));
    RowQuadrature row;
    row.altitude_km = altitude_km;
    for (RaySphere::Direction& direction : sphere.directions) {
        ViewRay& ray = direction.ray;
        const double sine = std::sqrt(std::max(0.0, (1 - direction.mu) * (1 + direction.mu)));
        const Spectrum whole_per_ray = sphere.whole_per_ray(direction);
        refine_view_ray(medium, whole_per_ray, level.ray_tolerance, ray);
        WeightedRay weighted;
        weighted.mu = direction.mu;
        weighted.weight = direction.weight;
        weighted.nodes = nodes_of(medium, ray);
        weighted.hits_ground = ray.hits_ground;
        weighted.length_km = ray.length_km;
        for (const RayNode& node : weighted.nodes) {
            const double swing =
                node.distance_km * sine / ((shell.ground_radius_km + node.altitude_km) * dip);
            weighted.azimuths.push_back(azimuth_count(largest(share_of(node.weight, whole_per_ray)),
                                                      4 * swing, level.azimuth_tolerance));
        }
        const double ground_swing = ray.length_km * sine / (shell.ground_radius_km * dip);
        weighted.ground_azimuths = azimuth_count(1, 4 * ground_swing, level.azimuth_tolerance);
        Spectrum depth{};
        Spectrum absorbed{};
        for (const RayCell& cell : ray.cells) {
            depth += cell.optical_depth;
            absorbed += cell.absorbed;
        }
        weighted.end_transmittance = exponential(-depth);
        row.escape += direction.weight * (weighted.end_transmittance + absorbed);
        row.rays.push_back(std::move(weighted));
    }
    return row;
}

}  // namespace skybake
