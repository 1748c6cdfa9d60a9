#include "bakers/light/solver/transport.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "bakers/air/quadrature_rules.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/air/view_ray.h"
#include "bakers/light/solver/needed_degrees.h"
#include "bakers/light/solver/residual_search.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Returns 1 - e^-x. Where the difference would cancel it is summed as a series, whose truncation
// error starts at x^8 / 9!.
double one_minus_exponential(double x) {
    if (x > 0.03) return 1 - exponential(-x);
    double series = 1;
    for (int n = 8; n >= 2; --n) series = 1 - series * x / n;
    return series * x;
}

FanPoint point_at(const std::vector<double>& levels_km, double distance_km, double altitude_km,
                  int level) {
    const int last = static_cast<int>(levels_km.size()) - 1;
    if (level >= 0) {
        return level < last ? FanPoint{distance_km, altitude_km, level, 0}
                            : FanPoint{distance_km, altitude_km, last - 1, 1};
    }
    const auto above = std::ranges::upper_bound(levels_km, altitude_km);
    const int below = std::clamp(static_cast<int>(above - levels_km.begin()) - 1, 0, last - 1);
    const auto i = static_cast<std::size_t>(below);
    return {distance_km, altitude_km, below,
            (altitude_km - levels_km[i]) / (levels_km[i + 1] - levels_km[i])};
}

void integrate_layers(const SkyMedium& medium, const ViewRay& view, FanRay& ray) {
    const Shell shell = shell_of(medium.air);
    const std::size_t layers = medium.layers.size();
    std::vector<double> altitudes;
    for (const RayCell& cell : view.cells) {
        const double width = cell.to.distance_km - cell.from.distance_km;
        for (const double node : cell_rule::kNodes) {
            altitudes.push_back(altitude_on(shell, view, cell.from.distance_km + width * node));
        }
    }
    std::vector<std::vector<Coefficients>> of_layer;
    for (const SkyLayer& layer : medium.layers) {
        of_layer.push_back(coefficients_at(layer.alone, altitudes));
    }
    ray.near.assign(view.cells.size() * layers, Spectrum(0.0));
    ray.far.assign(view.cells.size() * layers, Spectrum(0.0));
    Spectrum depth{};
    for (std::size_t i = 0; i < view.cells.size(); ++i) {
        const double width = view.cells[i].to.distance_km - view.cells[i].from.distance_km;
        Spectrum extinction[cell_rule::kGauss] = {};
        for (std::size_t k = 0; k < layers; ++k) {
            for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
                extinction[j] += of_layer[k][i * cell_rule::kGauss + j].extinction_per_km;
            }
        }
        Spectrum cell_depth{};
        Spectrum lost{};  // by the nodes
        Spectrum share[cell_rule::kGauss] = {};
        for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
            Spectrum up_to{};
            for (std::size_t k = 0; k < cell_rule::kGauss; ++k) {
                up_to += cell_rule::kUpTo[j][k] * extinction[k];
            }
            share[j] = cell_rule::kWeights[j] * exponential(-width * up_to);
            lost += share[j] * extinction[j];
            cell_depth += width * cell_rule::kWeights[j] * extinction[j];
        }
        // The nodes share out exactly what the cell takes from the light.
        const Spectrum before = exponential(-depth);
        Spectrum factor{};
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            if (!(lost[c] > 0)) continue;
            factor[c] = before[c] * one_minus_exponential(cell_depth[c]) / lost[c];
            depth[c] += cell_depth[c];
        }
        for (std::size_t k = 0; k < layers; ++k) {
            for (std::size_t j = 0; j < cell_rule::kGauss; ++j) {
                const Spectrum scattered =
                    factor * share[j] * of_layer[k][i * cell_rule::kGauss + j].scattering_per_km;
                ray.near[i * layers + k] += scattered * (1 - cell_rule::kNodes[j]);
                ray.far[i * layers + k] += scattered * cell_rule::kNodes[j];
            }
        }
    }
    ray.end_transmittance = exponential(-depth);
}

constexpr int kLimbNodesOfFlatPlanets = 2;

// The largest change of a ray's altitude over a cell under a low sun, as a share of the largest scale
// height. The rays' transmittance changes over a scale height.
constexpr double kTwilightStep = 0.7;

// Returns the thickness that a table's column would have at its largest density, its scale height if
// it is exponential; or 0 for slabs and tents, which have fewer pieces than tables.
double scale_height_km(const PiecewiseLayer& layer) {
    if (layer.pieces.size() < 3) return 0;
    double densest = 0;
    double column_km = 0;
    for (const LinearPiece& piece : layer.pieces) {
        densest = std::max({densest, piece.density_at_bottom, piece.density_at_top});
        column_km += 0.5 * (piece.density_at_bottom + piece.density_at_top) *
                     (piece.top_km - piece.bottom_km);
    }
    return densest > 0 ? column_km / densest : 0;
}

// Returns the step for refine_for_twilight, or 0 if no layer thins out gradually: then levels
// between its kinks are all that is known about scales.
double twilight_step_km(const Medium& medium) {
    double height_km = 0;
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        height_km = std::max(height_km, layer.scale_height_km);
    }
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        if (largest(layer.scattering_per_km) > 0) {
            height_km = std::max(height_km, scale_height_km(layer));
        }
    }
    return kTwilightStep * height_km;
}

// Around a flat planet the limb is next to nothing, so its nodes go to the other parts.
std::vector<ZenithPart> solver_parts(const Shell& shell, double horizon, double height,
                                     int zenith_nodes) {
    std::vector<ZenithPart> parts = zenith_parts(horizon, height, zenith_nodes);
    if (!is_flat_planet(shell)) return parts;
    for (ZenithPart& part : parts) {
        const bool is_limb = part.to == 0;
        part.nodes = is_limb ? kLimbNodesOfFlatPlanets : zenith_nodes;
    }
    return parts;
}

// Cells are not refined for twilight if `step_km` is 0.
RayFan make_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                int zenith_nodes, double tolerance, double step_km) {
    assert(level >= 0 && static_cast<std::size_t>(level) < levels_km.size());
    assert(std::ranges::is_sorted(levels_km) && zenith_nodes >= 1);
    const Shell shell = shell_of(medium.air);
    const double altitude = levels_km[static_cast<std::size_t>(level)];
    const double r = shell.ground_radius_km + altitude;
    const double horizon = -horizon_distance_km(shell, altitude) / r;
    RaySphere sphere = trace_all_directions(
        medium.air, levels_km, altitude,
        solver_parts(shell, horizon, altitude / shell.thickness_km, zenith_nodes));
    RayFan fan;
    fan.altitude_km = altitude;
    for (RaySphere::Direction& direction : sphere.directions) {
        ViewRay& view = direction.ray;
        const Spectrum whole_per_ray = sphere.whole_per_ray(direction);
        refine_view_ray(medium.air, whole_per_ray, tolerance, view);
        if (step_km > 0) refine_for_twilight(medium.air, whole_per_ray, step_km, view);
        FanRay ray;
        ray.mu = direction.mu;
        ray.sine = std::sqrt((1 - ray.mu) * (1 + ray.mu));
        ray.weight = direction.weight;
        ray.hits_ground = view.hits_ground;
        ray.length_km = view.length_km;
        ray.points.push_back(point_at(levels_km, 0, altitude, level));
        for (const RayCell& cell : view.cells) {
            const double at = altitude_on(shell, view, cell.to.distance_km);
            ray.points.push_back(point_at(levels_km, cell.to.distance_km, at, cell.to.level));
        }
        integrate_layers(medium, view, ray);
        fan.rays.push_back(std::move(ray));
    }
    return fan;
}

// Points that contribute less than this share of the light from all directions make no nodes.
constexpr double kLeastShare = 1e-6;

// Returns the light that points of a ray scatter to its beginning: [point * layers + layer]. A point below
// kLeastShare is 0 and its share moved to the point before it, since light that is lost at each of
// the thousands of scatterings in thick fog would add up to a percent.
std::vector<Spectrum> shares_of_points(const FanRay& ray, std::size_t layers) {
    const std::size_t points = ray.points.size();
    std::vector<Spectrum> shares(points * layers);
    for (std::size_t k = points; k-- > 0;) {
        double most = 0;
        for (std::size_t i = 0; i < layers; ++i) {
            Spectrum& share = shares[k * layers + i];
            if (k > 0) share += ray.far[(k - 1) * layers + i];
            if (k + 1 < points) share += ray.near[k * layers + i];
            most = std::max(most, largest(share));
        }
        if (most > kLeastShare || k == 0) continue;
        for (std::size_t i = 0; i < layers; ++i) {
            shares[(k - 1) * layers + i] += shares[k * layers + i];
            shares[k * layers + i] = Spectrum(0.0);
        }
    }
    return shares;
}

// Moments up to a degree are told apart by as many azimuths over half a turn, and one more. Where
// the sun moves over the terminator with the azimuth, twice as many.
int azimuth_count(double turn_sine, double dip_sine, int degree) {
    const int least = std::max(4, degree + 1);
    return turn_sine < dip_sine ? least : 2 * least;
}

// Adds the falls between columns of light to `falls`, and 0 for the last.
void add_falls(const double* light, int columns, std::vector<double>& falls) {
    const auto mean = [light](int column) {
        const double* channels = light + static_cast<std::size_t>(column) * kChannelSlots;
        return std::accumulate(channels, channels + kMaxChannels, 0.0);
    };
    for (int column = 0; column + 1 < columns; ++column) {
        falls.push_back(fall_between(mean(column), mean(column + 1)));
    }
    falls.push_back(0);
}

}  // namespace

RayFan make_ray_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                    int zenith_nodes, double tolerance) {
    return make_fan(medium, levels_km, level, zenith_nodes, tolerance, 0);
}

RayFan make_twilight_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                         int zenith_nodes, double tolerance) {
    return make_fan(medium, levels_km, level, zenith_nodes, tolerance,
                    twilight_step_km(medium.air));
}

LayerMoments::LayerMoments(const SkyMedium& medium, int to_degree) : degree(to_degree) {
    assert(degree >= 0);
    for (const SkyLayer& layer : medium.layers) moments.push_back(scattered_moments(layer, degree));
}

LayerMoments::LayerMoments(const SkyMedium& medium, int to_degree,
                           const std::vector<double>& altitudes_km)
    : LayerMoments(medium, to_degree) {
    degrees = needed_degrees(medium, altitudes_km, degree);
}

template <class Number>
LevelTransport<Number> make_level_transport(const SkyMedium& medium, const RayFan& fan,
                                            const LayerMoments& of_layers) {
    const int degree = of_layers.degree;
    const std::vector<int>& degrees = of_layers.degrees;
    const auto degree_of = [&](const FanPoint& point) {
        if (degrees.empty()) return degree;
        const auto level = static_cast<std::size_t>(point.level);
        return std::max(degrees[level], point.fraction > 0 ? degrees[level + 1] : 0);
    };
    const Shell shell = shell_of(medium.air);
    const double r = shell.ground_radius_km + fan.altitude_km;
    const double dip_sine = horizon_distance_km(shell, shell.thickness_km) /
                            (shell.ground_radius_km + shell.thickness_km);
    const std::size_t layers = medium.layers.size();
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    std::vector<double> weights(harmonics.size() * kChannelSlots);
    LevelTransport<Number> transport;
    std::size_t points = 0;
    for (const FanRay& ray : fan.rays) points += ray.points.size() + 1;
    transport.weights.reserve(points * block_count(degree));
    for (const FanRay& ray : fan.rays) {
        TransportRay made;
        made.mu = ray.mu;
        made.weight = ray.weight;
        const auto add_turn = [&](TransportNode& node, double distance_km, double altitude_km) {
            const double to_r = shell.ground_radius_km + altitude_km;
            node.turn_cosine = (r + distance_km * ray.mu) / to_r;
            node.turn_sine = distance_km * ray.sine / to_r;
            node.azimuths = azimuth_count(node.turn_sine, dip_sine, node.degree);
        };
        const std::vector<Spectrum> shares = shares_of_points(ray, layers);
        for (std::size_t k = 0; k < ray.points.size(); ++k) {
            const Spectrum* const scattered = shares.data() + k * layers;
            const bool is_dark = std::all_of(scattered, scattered + layers,
                                             [](const Spectrum& of) { return largest(of) == 0; });
            if (is_dark) continue;
            const FanPoint& point = ray.points[k];
            TransportNode node;
            node.level = point.level;
            node.fraction = point.fraction;
            node.degree = degree_of(point);
            add_turn(node, point.distance_km, point.altitude_km);
            node.weights = transport.weights.size();
            zenith_harmonics(node.degree,
                             std::clamp((r * ray.mu + point.distance_km) /
                                            (shell.ground_radius_km + point.altitude_km),
                                        -1.0, 1.0),  // rounding
                             harmonics.data());
            for (int l = 0; l <= node.degree; ++l) {
                Spectrum once{};
                for (std::size_t i = 0; i < layers; ++i) {
                    once += scattered[i] * of_layers.moments[i][static_cast<std::size_t>(l)];
                }
                for (int m = 0; m <= l; ++m) {
                    const auto lm = static_cast<std::size_t>(moment_index(l, m));
                    const Spectrum weight = harmonics[lm] * once;
                    std::copy_n(data(weight), kChannelSlots, weights.data() + lm * kChannelSlots);
                }
            }
            transport.weights.resize(node.weights + block_count(node.degree));
            write_blocks(node.degree, weights.data(), transport.weights.data() + node.weights);
            made.nodes.push_back(node);
        }
        if (ray.hits_ground) {
            TransportNode node;
            node.ground = true;
            node.degree = degrees.empty() ? degree : std::min(degree, kDegreeOfAir);
            add_turn(node, ray.length_km, 0);
            node.weights = transport.weights.size();
            const Spectrum reflected =
                ray.end_transmittance * medium.air.ground_albedo * std::numbers::inv_pi;
            write_blocks(0, data(reflected), &transport.weights.emplace_back());
            made.nodes.push_back(node);
        }
        transport.rays.push_back(std::move(made));
    }
    return transport;
}

void SteepSuns::follow(const LightField& estimate) {
    if (*std::ranges::max_element(stencils) == 0) return;
    const LightScale light = resolved_light(estimate);
    falls.clear();
    ground_falls.clear();
    const double* columns = light.data();
    for (int level = 0; level <= estimate.levels; ++level) {
        add_falls(columns, estimate.suns, level < estimate.levels ? falls : ground_falls);
        columns += static_cast<std::size_t>(estimate.suns) * kChannelSlots;
    }
}

template <class Number>
void apply_transports(const std::vector<LevelTransport<Number>>& transports, const SunAxis& suns,
                      const SteepSuns& steep, const BlockedLight<Number>& light, int threads,
                      LightField& image) {
    parallel_for(image.levels, threads, [&](int level) {
        apply_transport(transports[static_cast<std::size_t>(level)], suns, steep, light,
                        image.at(level, 0), level == 0 ? image.sky_irradiance.data() : nullptr);
    });
}

template LevelTransport<float> make_level_transport(const SkyMedium&, const RayFan&,
                                                    const LayerMoments&);
template LevelTransport<double> make_level_transport(const SkyMedium&, const RayFan&,
                                                     const LayerMoments&);
template void apply_transports(const std::vector<LevelTransport<float>>&, const SunAxis&,
                               const SteepSuns&, const BlockedLight<float>&, int, LightField&);
template void apply_transports(const std::vector<LevelTransport<double>>&, const SunAxis&,
                               const SteepSuns&, const BlockedLight<double>&, int, LightField&);

}  // namespace skybake
