#include "bakers/assets/bruneton/bundle_ray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

constexpr std::size_t kRayNodes = kBundleNodes;
constexpr std::array<std::size_t, 3> kCoarse = {0, 2, 4};

// Lagrange's polynomial of `node` among `nodes` at x.
template <class Nodes>
double lagrange(const Nodes& nodes, std::size_t node, double x) {
    double value = 1;
    for (const std::size_t other : nodes) {
        if (other == node) continue;
        value *= (x - ray_pieces::gauss_rule().nodes[other]) /
                 (ray_pieces::gauss_rule().nodes[node] - ray_pieces::gauss_rule().nodes[other]);
    }
    return value;
}

constexpr std::array<std::size_t, kRayNodes> kAll = {0, 1, 2, 3, 4};

// [coarse node][node]: the integral of what a node sends times a parabola through coarse nodes.
const std::array<std::array<double, kRayNodes>, 3>& coarse_rule() {
    static const auto rule = [] {
        std::array<std::array<double, kRayNodes>, 3> shares{};
        for (std::size_t j = 0; j < kCoarse.size(); ++j) {
            for (std::size_t i = 0; i < kRayNodes; ++i) {
                shares[j][i] = lagrange(kCoarse, kCoarse[j], ray_pieces::gauss_rule().nodes[i]);
            }
        }
        return shares;
    }();
    return rule;
}

class BundleRayMaker {
  public:
    BundleRayMaker(const SkyMedium& medium, const ScatteringView& view)
        : medium_(medium), view_(view), shell_(shell_of(medium.air)) {}

    Spectrum depth(double distance_km) const {
        const double r = shell_.ground_radius_km + view_.altitude_km;
        return optical_depth_along(medium_.air, view_.altitude_km,
                                   std::clamp(view_.s_km / r, -1.0, 1.0), distance_km);
    }

    void add(double from_km, double to_km, const Spectrum& depth_from, const Spectrum& depth_to,
             int halvings) {
        const auto deepest = ray_pieces::lit_depth(depth_from, depth_to, medium_.air.channels);
        if (!deepest) return;
        const bool is_long =
            to_km - from_km >
            ray_pieces::longest_piece_km(shell_, view_.altitude_km, view_.s_km, from_km, to_km);
        if ((*deepest > ray_pieces::kLargestDepth || is_long) &&
            halvings < ray_pieces::kMostHalvings) {
            const double middle = 0.5 * (from_km + to_km);
            const Spectrum depth_middle = depth(middle);
            add(from_km, middle, depth_from, depth_middle, halvings + 1);
            add(middle, to_km, depth_middle, depth_to, halvings + 1);
            return;
        }
        pieces_.push_back(piece(from_km, to_km));
    }

    std::vector<BundlePiece> take() { return std::move(pieces_); }

  private:
    BundlePiece piece(double from_km, double to_km) const {
        BundlePiece result;
        result.from_km = from_km;
        result.to_km = to_km;
        const double width = to_km - from_km;
        for (std::size_t i = 0; i < kRayNodes; ++i) {
            BundleNode& node = result.nodes[i];
            node.distance_km = from_km + width * ray_pieces::gauss_rule().nodes[i];
            node.altitude_km = std::clamp(
                altitude_along_km(shell_, view_.altitude_km, view_.s_km, node.distance_km), 0.0,
                shell_.thickness_km);  // rounding
            const Spectrum passing = exponential(-depth(node.distance_km));
            for (const SkyLayer& layer : medium_.layers) {
                Spectrum sent{};
                if (layer.scatters) sent = scattering_at(layer.alone, node.altitude_km) * passing;
                node.sent.push_back(sent);
                node.weights.push_back(width * ray_pieces::gauss_rule().weights[i] * sent);
            }
        }
        for (std::size_t j = 0; j < kCoarse.size(); ++j) {
            std::vector<Spectrum>& weights = result.nodes[kCoarse[j]].coarse_weights;
            weights.resize(medium_.layers.size());
            for (std::size_t i = 0; i < kRayNodes; ++i) {
                for (std::size_t k = 0; k < weights.size(); ++k) {
                    weights[k] += coarse_rule()[j][i] * result.nodes[i].weights[k];
                }
            }
        }
        return result;
    }

    const SkyMedium& medium_;
    const ScatteringView& view_;
    Shell shell_;
    std::vector<BundlePiece> pieces_;
};

}  // namespace

std::vector<BundlePiece> make_bundle_ray(const SkyMedium& medium,
                                         const std::vector<double>& break_altitudes_km,
                                         const ScatteringView& view) {
    BundleRayMaker maker(medium, view);
    if (!(view.length_km > 0)) return {};
    const std::vector<RayBreak> cuts = ray_breaks(shell_of(medium.air), view.altitude_km, view.s_km,
                                                  view.length_km, break_altitudes_km);
    Spectrum depth{};
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const Spectrum next = maker.depth(cuts[i + 1].distance_km);
        maker.add(cuts[i].distance_km, cuts[i + 1].distance_km, depth, next, 0);
        depth = next;
    }
    return maker.take();
}

std::array<double, kBundleNodes> node_shares(double share) {
    std::array<double, kBundleNodes> shares{};
    for (std::size_t i = 0; i < kRayNodes; ++i) shares[i] = lagrange(kAll, i, share);
    return shares;
}

}  // namespace skybake
