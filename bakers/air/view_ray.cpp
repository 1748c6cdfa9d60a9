#include "bakers/air/view_ray.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// However little light it scatters, no cell of a ray that is refined spans more than this
// variation.
constexpr double kLargestVariation = 2.5;
constexpr int kMostPasses = 24;
// Three Gauss nodes integrate e^-x over this much within 1e-4.
constexpr double kLargestOpacity = 2;
// Light that has passed this optical depth, e^-14, contributes nothing that a table could hold.
constexpr double kLastLight = 14;
// Cells that scatter less than this share of the light from all directions are not refined for
// twilight.
constexpr double kLeastTwilightShare = 1e-6;

// Integrates the cells between neighbouring breaks; the first break is the ray's beginning.
std::vector<RayCell> integrate_cells(const Medium& medium, const ViewRay& ray,
                                     const std::vector<RayBreak>& breaks) {
    const Shell shell = shell_of(medium);
    const std::size_t count = breaks.size() - 1;
    std::vector<RayCell> cells(count);
    std::vector<double> altitudes(count * cell_rule::kGauss);
    for (std::size_t i = 0; i < count; ++i) {
        cells[i].from = breaks[i];
        cells[i].to = breaks[i + 1];
        const double width = breaks[i + 1].distance_km - breaks[i].distance_km;
        for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
            altitudes[i * cell_rule::kGauss + j] =
                altitude_on(shell, ray, breaks[i].distance_km + width * cell_rule::kNodes[j]);
        }
    }
    const std::vector<Coefficients> coefficients = coefficients_at(medium, altitudes);

    // Optical depth up to each node, then the transmittances all at once.
    std::vector<Spectrum> transmittance(count * cell_rule::kGauss);
    Spectrum before{};
    for (std::size_t i = 0; i < count; ++i) {
        RayCell& cell = cells[i];
        const Coefficients* at = coefficients.data() + i * cell_rule::kGauss;
        const double width = cell.to.distance_km - cell.from.distance_km;
        Spectrum mean{};
        Spectrum low = at[0].extinction_per_km;
        Spectrum high = low;
        for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
            const Spectrum& extinction = at[j].extinction_per_km;
            mean += cell_rule::kWeights[j] * extinction;
            low = minimum(low, extinction);
            high = maximum(high, extinction);
            Spectrum depth = before;
            for (std::size_t k = 0; k < cell_rule::kGauss; ++k) {
                depth += width * cell_rule::kUpTo[j][k] * at[k].extinction_per_km;
            }
            transmittance[i * cell_rule::kGauss + j] = -depth;
        }
        cell.optical_depth = mean * width;
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            if (before[c] < kLastLight) {
                cell.opacity = std::max(cell.opacity, cell.optical_depth[c]);
            }
        }
        before += cell.optical_depth;
        const double spread = largest(share_of(high - low, mean));
        const bool empty = mean == Spectrum(0.0);
        // The vertical turns by width / r; sunlight changes over the dip of the shell's top.
        const double dip = std::min(1.0, std::sqrt(shell.thickness_km / shell.ground_radius_km));
        const double turn = width / (shell.ground_radius_km * dip);
        cell.variation = empty ? 0 : spread + cell.opacity + 4 * turn;
    }
    exponentials(data(transmittance.front()),
                 static_cast<int>(transmittance.size() * transmittance.front().length()));

    for (std::size_t i = 0; i < count; ++i) {
        RayCell& cell = cells[i];
        const double width = cell.to.distance_km - cell.from.distance_km;
        for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
            const Coefficients& at = coefficients[i * cell_rule::kGauss + j];
            const Spectrum factor =
                width * cell_rule::kWeights[j] * transmittance[i * cell_rule::kGauss + j];
            const Spectrum scattered = factor * at.scattering_per_km;
            cell.near_weight += scattered * (1 - cell_rule::kNodes[j]);
            cell.far_weight += scattered * cell_rule::kNodes[j];
            cell.absorbed += factor * (at.extinction_per_km - at.scattering_per_km);
        }
    }
    return cells;
}

// Halves cells until `split` returns false for all of them.
template <class Predicate>
void halve_cells(const Medium& medium, ViewRay& ray, const Predicate& split) {
    for (int pass = 0; pass < kMostPasses; ++pass) {
        std::vector<RayBreak> breaks = {{0, -1}};
        for (const RayCell& cell : ray.cells) {
            if (split(cell)) {
                breaks.push_back({0.5 * (cell.from.distance_km + cell.to.distance_km), -1});
            }
            breaks.push_back(cell.to);
        }
        if (breaks.size() == ray.cells.size() + 1) return;
        ray.cells = integrate_cells(medium, ray, breaks);
    }
}

bool too_coarse(const RayCell& cell, const Spectrum& whole, double tolerance) {
    const double share = largest(share_of(cell.near_weight + cell.far_weight, whole));
    return share * cell.variation * cell.variation > tolerance ||
           (cell.variation > kLargestVariation && share > 1e-2 * tolerance);
}

}  // namespace

ViewRay trace_view_ray(const Medium& medium, const std::vector<double>& break_altitudes_km,
                       double altitude_km, double s_km, bool hits_ground) {
    assert(std::ranges::is_sorted(break_altitudes_km));
    const Shell shell = shell_of(medium);
    ViewRay ray;
    ray.altitude_km = altitude_km;
    ray.s_km = s_km;
    ray.hits_ground = hits_ground;
    ray.length_km = hits_ground ? distance_to_ground_km(shell, altitude_km, s_km)
                                : distance_to_top_km(shell, altitude_km, s_km);
    if (!(ray.length_km > 0)) return ray;
    ray.cells = integrate_cells(
        medium, ray, ray_breaks(shell, altitude_km, s_km, ray.length_km, break_altitudes_km));
    halve_cells(medium, ray, [](const RayCell& cell) { return cell.opacity > kLargestOpacity; });
    return ray;
}

RaySphere trace_all_directions(const Medium& medium, const std::vector<double>& break_altitudes_km,
                               double altitude_km, const std::vector<ZenithPart>& parts) {
    const double r = medium.ground_radius_km + altitude_km;
    RaySphere sphere;
    for (const ZenithPart& part : parts) {
        const QuadratureRule rule = gauss_legendre(part.nodes);
        const double range = part.to - part.from;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            // mu = from + range x^2 puts nodes where paths grow long.
            const double x = rule.nodes[i];
            const double mu = part.from + range * x * x;
            const double weight = rule.weights[i] * x * std::fabs(range);
            sphere.directions.push_back({mu, weight,
                                         trace_view_ray(medium, break_altitudes_km, altitude_km,
                                                        r * mu, part.below_horizon)});
            for (const RayCell& cell : sphere.directions.back().ray.cells) {
                sphere.whole += weight * (cell.near_weight + cell.far_weight);
            }
        }
    }
    return sphere;
}

void refine_view_ray(const Medium& medium, const Spectrum& whole, double tolerance, ViewRay& ray) {
    assert(tolerance > 0);
    halve_cells(medium, ray,
                [&](const RayCell& cell) { return too_coarse(cell, whole, tolerance); });
}

void refine_for_twilight(const Medium& medium, const Spectrum& whole, double step_km,
                         ViewRay& ray) {
    assert(step_km > 0);
    const Shell shell = shell_of(medium);
    halve_cells(medium, ray, [&](const RayCell& cell) {
        const double share = largest(share_of(cell.near_weight + cell.far_weight, whole));
        if (!(share > kLeastTwilightShare)) return false;
        const double from = altitude_on(shell, ray, cell.from.distance_km);
        const double to = altitude_on(shell, ray, cell.to.distance_km);
        const double high = std::max(from, to);
        const double sine = horizon_distance_km(shell, high) / (shell.ground_radius_km + high);
        const double length = cell.to.distance_km - cell.from.distance_km;
        return std::fabs(to - from) + length * sine > step_km;
    });
}

std::vector<RayNode> nodes_of(const Medium& medium, const ViewRay& ray) {
    const Shell shell = shell_of(medium);
    std::vector<RayNode> nodes = {{ray.altitude_km, 0, -1, {}}};
    nodes.reserve(ray.cells.size() + 1);
    for (const RayCell& cell : ray.cells) {
        nodes.back().weight += cell.near_weight;
        nodes.push_back({altitude_on(shell, ray, cell.to.distance_km), cell.to.distance_km,
                         cell.to.level, cell.far_weight});
    }
    return nodes;
}

}  // namespace skybake
