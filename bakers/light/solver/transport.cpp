#include "bakers/light/solver/transport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace skybake {

namespace {

// Nodes that add less than this share of the light from all around are left out.
constexpr double kLeastShare = 1e-6;

// Moments up to a degree are told apart by as many azimuths over half a turn, and one more. Where
// the sun moves over the terminator with the azimuth, twice as many.
int azimuth_count(double turn_sine, double dip_sine, int degree) {
    const int least = std::max(4, degree + 1);
    return turn_sine < dip_sine ? least : 2 * least;
}

}  // namespace

LevelTransport make_level_transport(const SkyMedium& medium, const RayFan& fan, int degree) {
    const Shell shell = shell_of(medium.air);
    const double r = shell.ground_radius_km + fan.altitude_km;
    const double dip_sine = horizon_distance_km(shell, shell.thickness_km) /
                            (shell.ground_radius_km + shell.thickness_km);
    const std::size_t layers = medium.layers.size();
    std::vector<std::vector<Spectrum>> phases;
    for (const SkyLayer& layer : medium.layers) {
        phases.push_back(legendre_moments(layer.phase, degree));
    }
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    LevelTransport transport;
    const auto add_weights = [&](const Spectrum& weights) {
        transport.weights.insert(transport.weights.end(), data(weights),
                                 data(weights) + kChannelSlots);
    };
    for (const FanRay& ray : fan.rays) {
        TransportRay made;
        made.mu = ray.mu;
        made.weight = ray.weight;
        const auto add_turn = [&](TransportNode& node, double distance_km, double altitude_km) {
            const double to_r = shell.ground_radius_km + altitude_km;
            node.turn_cosine = (r + distance_km * ray.mu) / to_r;
            node.turn_sine = distance_km * ray.sine / to_r;
            node.azimuths = azimuth_count(node.turn_sine, dip_sine, degree);
        };
        for (std::size_t k = 0; k < ray.points.size(); ++k) {
            std::vector<Spectrum> scattered(layers);
            double most = 0;
            for (std::size_t i = 0; i < layers; ++i) {
                if (k > 0) scattered[i] += ray.far[(k - 1) * layers + i];
                if (k + 1 < ray.points.size()) scattered[i] += ray.near[k * layers + i];
                most = std::max(most, largest(scattered[i]));
            }
            if (!(most > kLeastShare)) continue;
            const FanPoint& point = ray.points[k];
            TransportNode node;
            node.level = point.level;
            node.fraction = point.fraction;
            add_turn(node, point.distance_km, point.altitude_km);
            node.weights = transport.weights.size();
            zenith_harmonics(degree,
                             std::clamp((r * ray.mu + point.distance_km) /
                                            (shell.ground_radius_km + point.altitude_km),
                                        -1.0, 1.0),  // rounding
                             harmonics.data());
            for (int l = 0; l <= degree; ++l) {
                Spectrum once{};
                for (std::size_t i = 0; i < layers; ++i) {
                    once += scattered[i] * phases[i][static_cast<std::size_t>(l)];
                }
                for (int m = 0; m <= l; ++m) {
                    add_weights(harmonics[static_cast<std::size_t>(moment_index(l, m))] * once);
                }
            }
            made.nodes.push_back(node);
        }
        if (ray.hits_ground) {
            TransportNode node;
            node.ground = true;
            add_turn(node, ray.length_km, 0);
            node.weights = transport.weights.size();
            add_weights(ray.end_transmittance * medium.air.ground_albedo * std::numbers::inv_pi);
            made.nodes.push_back(node);
        }
        transport.rays.push_back(std::move(made));
    }
    return transport;
}

}  // namespace skybake
