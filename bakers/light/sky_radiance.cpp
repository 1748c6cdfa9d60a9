#include "bakers/light/sky_radiance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bakers/air/optical_depth.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// Layers of less depth dim no sunlight that a table would miss (reading_levels.cpp has the same).
constexpr double kThinLayer = 0.02;
constexpr double kGrowth = 4;  // of depths from the edge
// The optical depth to a sun at the horizontal at the first of them.
constexpr double kFirstDepth = 0.3;

// From `edge_km` towards the middle of a layer, whose extinction just inside is `per_km`.
void add_skin(const Medium& medium, double edge_km, double middle_km, double per_km,
              std::vector<double>& altitudes) {
    if (!(per_km > 0)) return;
    const double way_km = kFirstDepth / per_km;
    const double side = middle_km < edge_km ? -1 : 1;
    double depth_km = way_km * way_km / (2 * (medium.ground_radius_km + edge_km));
    for (; depth_km < side * (middle_km - edge_km); depth_km *= kGrowth) {
        altitudes.push_back(edge_km + side * depth_km);
    }
}

}  // namespace

bool LitSkins::hold(double altitude_km) const {
    return std::ranges::any_of(layers, [&](const AltitudeRange& layer) {
        return altitude_km > layer.bottom_km && altitude_km < layer.top_km;
    });
}

LitSkins lit_skins(const Medium& medium) {
    LitSkins skins;
    skins.altitudes_km = quadrature_altitudes_km(medium);
    skins.layers = abrupt_layers_km(medium, kThinLayer);
    for (const AltitudeRange& layer : skins.layers) {
        const double middle_km = 0.5 * (layer.bottom_km + layer.top_km);
        for (const double edge_km : {layer.bottom_km, layer.top_km}) {
            if (edge_km == 0) continue;
            const double inside_km = edge_km + 1e-6 * (middle_km - edge_km);
            add_skin(medium, edge_km, middle_km, largest(extinction_at(medium, inside_km)),
                     skins.altitudes_km);
        }
    }
    std::ranges::sort(skins.altitudes_km);
    return skins;
}

Spectrum SkyRadiance::total() const { return single + multiple + ground; }

struct SkyIntegrator::Piece {
    double from_km;
    double to_km;
    Spectrum depth_from;
    Spectrum depth_to;
};

SkyIntegrator::SkyIntegrator(const SkyMedium& medium, const HigherOrders* higher_orders)
    : medium_(medium),
      higher_orders_(higher_orders),
      shell_(shell_of(medium.air)),
      skins_(lit_skins(medium.air)) {}

Spectrum SkyIntegrator::sunlight(double altitude_km, double s_km) const {
    if (s_km < -horizon_distance_km(shell_, altitude_km)) return {};
    return exponential(-optical_depth_to_top(medium_.air, altitude_km, s_km));
}

void SkyIntegrator::sunlight(double altitude_km, const std::vector<double>& s_km,
                             double* values) const {
    const auto count = static_cast<int>(s_km.size());
    optical_depth_to_top(medium_.air, altitude_km, s_km.data(), count, values);
    for (int i = 0; i < count * medium_.air.channels; ++i) values[i] = exponential(-values[i]);
}

Spectrum SkyIntegrator::depth_between(const SkyRay& ray, double from_km, double to_km) const {
    const double altitude = altitude_on(ray, from_km);
    const double r = shell_.ground_radius_km + altitude;
    return optical_depth_along(medium_.air, altitude, (ray.s_km + from_km) / r, to_km - from_km);
}

std::array<Spectrum, ray_pieces::kNodes> SkyIntegrator::depths_between(
    const SkyRay& ray, double from_km, NodeValues distances_km) const {
    const double altitude = altitude_on(ray, from_km);
    const double r = shell_.ground_radius_km + altitude;
    for (double& distance : distances_km) distance -= from_km;
    std::array<double, kMaxChannels * ray_pieces::kNodes> depths;
    optical_depth_along(medium_.air, altitude, (ray.s_km + from_km) / r, distances_km,
                        depths.data());
    std::array<Spectrum, ray_pieces::kNodes> of_nodes{};
    for (std::size_t i = 0; i < of_nodes.size(); ++i) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(medium_.air.channels); ++c) {
            of_nodes[i][c] = depths[c * of_nodes.size() + i];
        }
    }
    return of_nodes;
}

double SkyIntegrator::altitude_on(const SkyRay& ray, double distance_km) const {
    return altitude_in_shell_km(shell_, ray.altitude_km, ray.s_km, distance_km);
}

std::array<Spectrum, ray_pieces::kNodes> SkyIntegrator::sunlight(const NodeValues& altitudes_km,
                                                                 const NodeValues& s_km) const {
    NodeValues lit_s_km{};
    for (std::size_t i = 0; i < s_km.size(); ++i) {
        lit_s_km[i] = std::max(s_km[i], -horizon_distance_km(shell_, altitudes_km[i]));
    }
    std::array<Spectrum, ray_pieces::kNodes> light{};
    std::array<double, kMaxChannels * ray_pieces::kNodes> depths;
    optical_depth_to_top(medium_.air, altitudes_km, lit_s_km, depths.data());
    for (std::size_t i = 0; i < s_km.size(); ++i) {
        if (lit_s_km[i] > s_km[i]) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(medium_.air.channels); ++c) {
            light[i][c] = exponential(-depths[c * s_km.size() + i]);
        }
    }
    return light;
}

ScatteringPoint scattering_point(const Shell& shell, const SkyRay& ray, double altitude_km,
                                 double sun_s_km, double distance_km) {
    const double r = shell.ground_radius_km + altitude_km;
    return scattering_point(altitude_km, (ray.s_km + distance_km) / r, sun_s_km / r,
                            ray.cosine_to_sun);
}

// Returns the distances at which the ray is cut, ascending, with both ends.
std::vector<double> SkyIntegrator::cuts_km(const SkyRay& ray) const {
    std::vector<double> cuts;
    for (const RayBreak& at :
         ray_breaks(shell_, ray.altitude_km, ray.s_km, ray.length_km, skins_.altitudes_km)) {
        cuts.push_back(at.distance_km);
    }
    // The sun's ray through P grazes altitude k where |P|^2 - (P . sun)^2 = (R + k)^2 and the sun
    // is below the horizontal there; k = 0 is the edge of the shadow.
    const double nu = ray.cosine_to_sun;
    const double a = ray.one_minus_cosine * ray.one_plus_cosine;
    const double b = ray.s_km - ray.sun_s_km * nu;
    for (const double altitude : skins_.altitudes_km) {
        const double gain = ray.altitude_km - altitude;
        // r^2 - (R + k)^2 - (r mu_s)^2.
        const double c = gain * (2 * shell_.ground_radius_km + ray.altitude_km + altitude) -
                         ray.sun_s_km * ray.sun_s_km;
        const double discriminant = b * b - a * c;
        if (!(a > 0) || discriminant < 0) continue;
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        for (const double x : {q / a, q != 0 ? c / q : 0.0}) {
            if (x > 0 && x < ray.length_km && ray.sun_s_km + x * nu < 0) cuts.push_back(x);
        }
    }
    std::ranges::sort(cuts);
    return cuts;
}

std::vector<Spectrum> SkyIntegrator::phases(const SkyRay& ray) const {
    return mapped<Spectrum>(medium_.layers, [&](const SkyLayer& layer) {
        return first_phase_values(layer, ray.one_minus_cosine, ray.one_plus_cosine);
    });
}

void SkyIntegrator::add_piece(const SkyRay& ray, const std::vector<Spectrum>& phases,
                              const Piece& piece, int halvings, SkyRadiance& sum) const {
    const auto depth =
        ray_pieces::lit_depth(piece.depth_from, piece.depth_to, medium_.air.channels);
    if (!depth) return;
    if (*depth > ray_pieces::kLargestDepth && halvings < ray_pieces::kMostHalvings) {
        const double middle = 0.5 * (piece.from_km + piece.to_km);
        const Spectrum depth_middle = piece.depth_from + depth_between(ray, piece.from_km, middle);
        add_piece(ray, phases, {piece.from_km, middle, piece.depth_from, depth_middle},
                  halvings + 1, sum);
        add_piece(ray, phases, {middle, piece.to_km, depth_middle, piece.depth_to}, halvings + 1,
                  sum);
        return;
    }
    const double width = piece.to_km - piece.from_km;
    NodeValues distances, altitudes, sun_s;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        distances[i] = piece.from_km + width * ray_pieces::gauss_rule().nodes[i];
        altitudes[i] = altitude_on(ray, distances[i]);
        sun_s[i] = ray.sun_s_km + distances[i] * ray.cosine_to_sun;
    }
    const std::array<Spectrum, ray_pieces::kNodes> sun = sunlight(altitudes, sun_s);
    const std::array<Spectrum, ray_pieces::kNodes> depths =
        depths_between(ray, piece.from_km, distances);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double altitude = altitudes[i];
        const Spectrum depth_here = piece.depth_from + depths[i];
        Spectrum towards_eye{};
        std::vector<Spectrum> scattering(medium_.layers.size());
        for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
            if (!medium_.layers[k].scatters) continue;
            scattering[k] = scattering_at(medium_.layers[k].alone, altitude);
            towards_eye += scattering[k] * phases[k];
        }
        Spectrum again{};
        if (higher_orders_) {
            again = higher_orders_->scattered(
                scattering_point(shell_, ray, altitude, sun_s[i], distances[i]), scattering);
        }
        const Spectrum weight =
            width * ray_pieces::gauss_rule().weights[i] * exponential(-depth_here);
        sum.single += weight * towards_eye * sun[i];
        sum.multiple += weight * again;
    }
}

Spectrum SkyIntegrator::ground_radiance(double sun_s_km) const {
    const double mu = sun_s_km / shell_.ground_radius_km;
    const Spectrum sky = higher_orders_ ? higher_orders_->sky_irradiance(mu) : Spectrum{};
    return medium_.air.ground_albedo / std::numbers::pi *
           (std::max(mu, 0.0) * sunlight(0, sun_s_km) + sky);
}

SkyRadiance SkyIntegrator::radiance(double altitude_km, const SunZenith& sun,
                                    const SkyDirection& direction) const {
    return radiance(sky_ray(shell_, altitude_km, sun, direction));
}

SkyRadiance SkyIntegrator::radiance(const SkyRay& ray) const {
    SkyRadiance sum = up_to(ray, {ray.length_km}).front();
    if (ray.meets_ground) {
        sum.ground = ground_radiance(ray.sun_s_km + ray.length_km * ray.cosine_to_sun);
        sum.ground *= sum.transmittance;
    }
    return sum;
}

std::vector<SkyRadiance> SkyIntegrator::up_to(const SkyRay& ray,
                                              const std::vector<double>& distances_km) const {
    assert(std::ranges::is_sorted(distances_km));
    std::vector<double> cuts = ray.length_km > 0 ? cuts_km(ray) : std::vector<double>{0};
    cuts.insert(cuts.end(), distances_km.begin(), distances_km.end());
    std::ranges::sort(cuts);
    const std::vector<Spectrum> of_layers = phases(ray);
    std::vector<SkyRadiance> result;
    SkyRadiance sum;
    Spectrum depth{};
    std::size_t cut = 0;
    for (const double distance : distances_km) {
        for (; cuts[cut] < distance; ++cut) {
            if (!(cuts[cut] < cuts[cut + 1])) continue;
            const Spectrum next = depth + depth_between(ray, cuts[cut], cuts[cut + 1]);
            add_piece(ray, of_layers, {cuts[cut], cuts[cut + 1], depth, next}, 0, sum);
            depth = next;
        }
        sum.transmittance = exponential(-depth);
        result.push_back(sum);
    }
    return result;
}

}  // namespace skybake
