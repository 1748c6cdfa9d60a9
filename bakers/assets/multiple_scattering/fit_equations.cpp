#include "bakers/assets/multiple_scattering/fit_equations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/view_ray.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// The tolerance of refine_view_ray: a hundredth of it changes nothing.
constexpr double kRayTolerance = 1e-2;

// A place between two neighbours of `count`; the only one is its own neighbour.
struct Between {
    std::size_t low = 0;
    std::size_t high = 0;
    double share = 0;  // of the high one
};

Between between(double position, std::size_t count) {
    const double clamped = std::clamp(position, 0.0, static_cast<double>(count - 1));
    const auto low = static_cast<std::size_t>(clamped);
    return {low, std::min(low + 1, count - 1), clamped - static_cast<double>(low)};
}

Between row_of(const std::vector<double>& altitudes_km, double altitude_km) {
    const auto above = std::upper_bound(altitudes_km.begin(), altitudes_km.end(), altitude_km);
    if (above == altitudes_km.begin()) return {};
    const auto low = static_cast<std::size_t>(above - altitudes_km.begin()) - 1;
    if (above == altitudes_km.end()) return {low, low, 0};
    return {low, low + 1, (altitude_km - altitudes_km[low]) / (*above - altitudes_km[low])};
}

// A node of a view's rays with what all of them share.
struct Node {
    double altitude_km = 0;
    double distance_km = 0;
    Spectrum weight{};             // integral of T sigma_s
    std::vector<Spectrum> shares;  // of each layer in the scattering
    SolvedSource source;           // per scattering
    Between row;
};

std::vector<Spectrum> layer_shares(const SkyMedium& medium, double altitude_km) {
    const Spectrum total = scattering_at(medium.air, altitude_km);
    std::vector<Spectrum> shares;
    for (const SkyLayer& layer : medium.layers) {
        Spectrum share{};
        if (layer.scatters) share = scattering_at(layer.alone, altitude_km);
        shares.push_back(share_of(share, total));
    }
    return shares;
}

std::vector<Node> nodes_along(const SkyMedium& medium, const SolvedLight& light, const SkyRay& any,
                              const FitAxes& axes) {
    ViewRay ray = trace_view_ray(medium.air, quadrature_altitudes_km(medium.air), any.altitude_km,
                                 any.s_km, any.meets_ground);
    Spectrum whole{};
    for (const RayCell& cell : ray.cells) whole += cell.near_weight + cell.far_weight;
    refine_view_ray(medium.air, whole, kRayTolerance, ray);
    std::vector<std::vector<Spectrum>> phase_moments;
    for (const SkyLayer& layer : medium.layers) {
        phase_moments.push_back(scattered_moments(layer, light.degree()));
    }
    std::vector<Node> nodes;
    for (const RayNode& at : nodes_of(medium.air, ray)) {
        const double r = medium.air.ground_radius_km + at.altitude_km;
        const double mu = std::clamp((any.s_km + at.distance_km) / r, -1.0, 1.0);  // rounding
        const std::vector<Spectrum> shares = layer_shares(medium, at.altitude_km);
        nodes.push_back({at.altitude_km, at.distance_km, at.weight, shares,
                         SolvedSource(light, at.altitude_km, mu, shares, phase_moments),
                         row_of(axes.altitudes_km_of_rows, at.altitude_km)});
    }
    return nodes;
}

// Collects the terms of one equation after the other.
class TermCollector {
  public:
    explicit TermCollector(std::size_t texels) : weights_(texels), used_(texels) {}

    void add(std::size_t texel, double share, const Spectrum& weight) {
        if (!used_[texel]) {
            used_[texel] = true;
            texels_.push_back(texel);
            weights_[texel] = Spectrum(0.0);
        }
        weights_[texel] += share * weight;
    }

    void end_equation(ViewEquations& equations) {
        std::sort(texels_.begin(), texels_.end());
        for (const std::size_t texel : texels_) {
            equations.texels.push_back(texel);
            equations.weights.push_back(weights_[texel]);
            used_[texel] = false;
        }
        texels_.clear();
        equations.first_term.push_back(equations.texels.size());
    }

  private:
    std::vector<Spectrum> weights_;
    std::vector<bool> used_;
    std::vector<std::size_t> texels_;
};

void add_node_terms(const Node& node, const Between& column, std::size_t width,
                    TermCollector& terms) {
    const Between& row = node.row;
    terms.add(row.low * width + column.low, (1 - row.share) * (1 - column.share), node.weight);
    terms.add(row.low * width + column.high, (1 - row.share) * column.share, node.weight);
    terms.add(row.high * width + column.low, row.share * (1 - column.share), node.weight);
    terms.add(row.high * width + column.high, row.share * column.share, node.weight);
}

// Light scattered once along the rays, sunlight taken at the nodes alone.
std::vector<Spectrum> single_scattering(const SkyMedium& medium, const std::vector<Node>& nodes,
                                        const std::vector<SkyRay>& rays) {
    const auto channels = static_cast<std::size_t>(medium.air.channels);
    const std::size_t count = rays.size();
    std::vector<Spectrum> phases(medium.layers.size() * count);
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        for (std::size_t i = 0; i < count; ++i) {
            phases[k * count + i] = first_phase_values(medium.layers[k], rays[i].one_minus_cosine,
                                                       rays[i].one_plus_cosine);
        }
    }
    std::vector<Spectrum> sums(count);
    std::vector<double> sun_s_km(count);
    std::vector<bool> is_lit(count);
    std::vector<double> sunlight(count * kMaxChannels);
    for (const Node& node : nodes) {
        const double horizon_km = horizon_distance_km(shell_of(medium.air), node.altitude_km);
        for (std::size_t i = 0; i < count; ++i) {
            const double s_km = rays[i].sun_s_km + node.distance_km * rays[i].cosine_to_sun;
            is_lit[i] = s_km >= -horizon_km;
            sun_s_km[i] = is_lit[i] ? s_km : 0;
        }
        optical_depth_to_top(medium.air, node.altitude_km, sun_s_km.data(), static_cast<int>(count),
                             sunlight.data());
        for (double& value : sunlight) value = -value;
        exponentials(sunlight.data(), static_cast<int>(count * channels));
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_lit[i]) continue;
            for (std::size_t c = 0; c < channels; ++c) {
                double phase = 0;
                for (std::size_t k = 0; k < medium.layers.size(); ++k) {
                    phase += node.shares[k][c] * phases[k * count + i][c];
                }
                sums[i][c] += node.weight[c] * phase * sunlight[c * count + i];
            }
        }
    }
    return sums;
}

}  // namespace

ViewEquations view_equations(const SkyMedium& medium, const SolvedLight& light,
                             const FitSample& sample, const FitView& view, const FitAxes& axes) {
    const Shell shell = shell_of(medium.air);
    std::vector<SkyRay> rays;
    for (std::size_t i = 0; i < sample.rays_per_view(); ++i) {
        rays.push_back(sample.ray(shell, view, i));
    }
    const std::vector<Node> nodes = nodes_along(medium, light, rays.front(), axes);
    ViewEquations equations;
    equations.single = single_scattering(medium, nodes, rays);
    TermCollector terms(axes.texels());
    for (const SkyRay& ray : rays) {
        Spectrum sum{};
        for (const Node& node : nodes) {
            const double sun_s_km = ray.sun_s_km + node.distance_km * ray.cosine_to_sun;
            const ScatteringPoint point =
                scattering_point(shell, ray, node.altitude_km, sun_s_km, node.distance_km);
            sum += node.weight * node.source.scattered(point.sun_cos_zenith, point.azimuth_cosine);
            add_node_terms(node, between(axes.column_of(point.sun_cos_zenith), axes.width()),
                           axes.width(), terms);
        }
        terms.end_equation(equations);
        equations.multiple.push_back(sum);
    }
    return equations;
}

namespace {

SunZenith sun_of(double cosine) { return {cosine, std::sqrt((1 - cosine) * (1 + cosine))}; }

std::vector<SunZenith> suns_of(const SunAxis& axis, const FitScene& scene, int suns_per_column) {
    // Darker suns than the axis' last bring that one's light.
    const double lowest = std::max(cosine_of(scene.largest_sun_zenith), axis.darkest);
    const double highest = std::max(cosine_of(scene.smallest_sun_zenith), lowest);
    std::vector<SunZenith> suns = {sun_of(lowest)};
    for (std::size_t i = 0; i + 1 < axis.cosines.size(); ++i) {
        for (int k = 0; k < suns_per_column; ++k) {
            const double share = static_cast<double>(k) / suns_per_column;
            const double cosine = (1 - share) * axis.cosines[i] + share * axis.cosines[i + 1];
            if (cosine > lowest && cosine < highest) suns.push_back(sun_of(cosine));
        }
    }
    if (highest > lowest) suns.push_back(sun_of(highest));
    return suns;
}

// mu = from + (to - from) x^2: Gauss' nodes in x, d mu = 2 x dx.
void add_views(int camera, double from, double to, int count, bool meets_ground,
               std::vector<FitView>& views) {
    const QuadratureRule rule = gauss_legendre(count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = rule.nodes[i];
        const double mu = from + (to - from) * x * x;
        views.push_back(
            {camera, mu, std::sqrt((1 - mu) * (1 + mu)), meets_ground, 2 * x * rule.weights[i]});
    }
}

}  // namespace

SkyRay FitSample::ray(const Shell& shell, const FitView& view, std::size_t index) const {
    const SunZenith& sun = suns[index / azimuth_cosines.size()];
    const SkyDirection direction =
        sky_direction(sun, view.mu, view.sine, azimuth_cosines[index % azimuth_cosines.size()]);
    const double altitude_km = cameras_km[static_cast<std::size_t>(view.camera)];
    return camera_ray(shell, altitude_km, sun, direction).in_air;
}

FitSample sample_scene(const Shell& shell, const SunAxis& axis, const FitScene& scene,
                       const FitDensity& density) {
    FitSample sample;
    sample.suns = suns_of(axis, scene, density.suns_per_column);
    for (int i = 0; i < density.azimuths; ++i) {
        sample.azimuth_cosines.push_back(cosine_of_pi((i + 0.5) / density.azimuths));
    }
    const double range_km = scene.highest_camera_km - scene.lowest_camera_km;
    const int cameras = range_km > 0 ? density.cameras : 1;
    for (int i = 0; i < cameras; ++i) {
        const double x = cameras > 1 ? static_cast<double>(i) / (cameras - 1) : 0;
        const double altitude_km = scene.lowest_camera_km + range_km * x * x;
        const double r = shell.ground_radius_km + altitude_km;
        const double horizon = -horizon_distance_km(shell, altitude_km) / r;
        // From space the sky ends where rays graze the top of the air.
        const double above_top_km = altitude_km - shell.thickness_km;
        const double edge =
            above_top_km > 0
                ? -std::sqrt(square_gain_km2(shell, shell.thickness_km, above_top_km)) / r
                : 1;
        sample.cameras_km.push_back(altitude_km);
        add_views(i, horizon, edge, density.sky_views, false, sample.views);
        if (altitude_km > 0) {
            add_views(i, horizon, -1, density.ground_views, true, sample.views);
        }
    }
    return sample;
}

}  // namespace skybake
