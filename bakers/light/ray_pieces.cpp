#include "bakers/light/ray_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/math/transcendental.h"

namespace skybake::ray_pieces {
namespace {

using NodeShares = std::array<std::array<double, kNodes>, kNodes>;

constexpr std::array<std::size_t, kNodes> kAllNodes = {0, 1, 2, 3, 4};

// Lagrange's polynomial of one of the nodes at x.
template <std::size_t kCount>
double node_polynomial(const std::array<std::size_t, kCount>& among, std::size_t node, double x) {
    const std::vector<double>& nodes = gauss_rule().nodes;
    double value = 1;
    for (const std::size_t other : among) {
        if (other == node) continue;
        value *= (x - nodes[other]) / (nodes[node] - nodes[other]);
    }
    return value;
}

// [i][j]: the integral of the polynomial of node j from 0 to node i. Gauss's rule is exact for it.
const NodeShares& shares_up_to_nodes() {
    static const NodeShares shares = [] {
        NodeShares found{};
        for (std::size_t i = 0; i < kNodes; ++i) {
            const double end = gauss_rule().nodes[i];
            for (std::size_t j = 0; j < kNodes; ++j) {
                for (std::size_t k = 0; k < kNodes; ++k) {
                    found[i][j] += end * gauss_rule().weights[k] *
                                   node_polynomial(kAllNodes, j, end * gauss_rule().nodes[k]);
                }
            }
        }
        return found;
    }();
    return shares;
}

// Returns the altitude of a node of the ray that starts at altitude_km.
class Cutter {
  public:
    Cutter(const Medium& medium, double altitude_km, double s_km)
        : medium_(medium), shell_(shell_of(medium)), altitude_km_(altitude_km), s_km_(s_km) {}

    // Pieces must be added in ascending order.
    void add(double from_km, double to_km, int halvings) {
        Piece piece = {from_km, to_km, {}};
        std::array<Spectrum, kNodes> extinction;
        Spectrum depth_to = ray_.depth;
        const double width = to_km - from_km;
        for (std::size_t i = 0; i < kNodes; ++i) {
            Node& node = piece.nodes[i];
            node.distance_km = from_km + width * gauss_rule().nodes[i];
            node.altitude_km = altitude_in_shell_km(shell_, altitude_km_, s_km_, node.distance_km);
            node.width_km = width * gauss_rule().weights[i];
            extinction[i] = extinction_at(medium_, node.altitude_km);
            depth_to += node.width_km * extinction[i];
        }
        const auto deepest = lit_depth(ray_.depth, depth_to, medium_.channels);
        if (deepest && halvings < kMostHalvings &&
            (*deepest > kLargestDepth || is_long(from_km, to_km))) {
            const double middle = 0.5 * (from_km + to_km);
            add(from_km, middle, halvings + 1);
            add(middle, to_km, halvings + 1);
            return;
        }
        if (deepest) {
            find_transmittances(extinction, width, piece);
            ray_.pieces.push_back(piece);
        }
        ray_.depth = depth_to;
    }

    CutRay take() { return std::move(ray_); }

  private:
    bool is_long(double from_km, double to_km) const {
        return to_km - from_km > longest_piece_km(shell_, altitude_km_, s_km_, from_km, to_km);
    }

    void find_transmittances(const std::array<Spectrum, kNodes>& extinction, double width_km,
                             Piece& piece) const {
        for (std::size_t i = 0; i < kNodes; ++i) {
            Spectrum depth = ray_.depth;
            for (std::size_t j = 0; j < kNodes; ++j) {
                depth += width_km * shares_up_to_nodes()[i][j] * extinction[j];
            }
            piece.nodes[i].transmittance = exponential(-depth);
        }
    }

    const Medium& medium_;
    Shell shell_;
    double altitude_km_;
    double s_km_;
    CutRay ray_;
};

}  // namespace

const QuadratureRule& gauss_rule() {
    static const QuadratureRule rule = gauss_legendre(static_cast<int>(kNodes));
    return rule;
}

const CoarseShares& coarse_shares() {
    static const CoarseShares shares = [] {
        CoarseShares found{};
        for (std::size_t j = 0; j < kCoarseNodes.size(); ++j) {
            for (std::size_t i = 0; i < kNodes; ++i) {
                found[j][i] = node_polynomial(kCoarseNodes, kCoarseNodes[j], gauss_rule().nodes[i]);
            }
        }
        return found;
    }();
    return shares;
}

std::array<StretchNode, kNodes> stretch(const Shell& shell, double altitude_km, double s_km,
                                        double piece_from_km, double piece_to_km, double from_km,
                                        double to_km) {
    std::array<StretchNode, kNodes> nodes;
    for (std::size_t j = 0; j < kNodes; ++j) {
        StretchNode& node = nodes[j];
        node.distance_km = from_km + (to_km - from_km) * gauss_rule().nodes[j];
        node.altitude_km = altitude_in_shell_km(shell, altitude_km, s_km, node.distance_km);
        node.width_km = (to_km - from_km) * gauss_rule().weights[j];
        const double share = (node.distance_km - piece_from_km) / (piece_to_km - piece_from_km);
        for (std::size_t i = 0; i < kNodes; ++i)
            node.shares[i] = node_polynomial(kAllNodes, i, share);
    }
    return nodes;
}

double longest_piece_km(const Shell& shell, double altitude_km, double s_km, double from_km,
                        double to_km) {
    const double r = shell.ground_radius_km + altitude_km;
    const double square = (r - s_km) * (r + s_km);
    const double nearest = std::max({s_km + from_km, -(s_km + to_km), 0.0});
    const double r_nearest = std::sqrt(std::max(square, 0.0) + nearest * nearest);
    return kLongestTurn * std::max(shell.ground_radius_km, 0.5 * r_nearest);
}

std::optional<double> lit_depth(const Spectrum& from, const Spectrum& to, int channels) {
    std::optional<double> depth;
    for (int c = 0; c < channels; ++c) {
        if (data(from)[c] > kLastLight) continue;
        depth = std::max(depth.value_or(0), data(to)[c] - data(from)[c]);
    }
    return depth;
}

CutRay cut(const Medium& medium, double altitude_km, double s_km, double length_km,
           const std::vector<double>& break_altitudes_km) {
    Cutter cutter(medium, altitude_km, s_km);
    if (length_km > 0) {
        const std::vector<RayBreak> breaks =
            ray_breaks(shell_of(medium), altitude_km, s_km, length_km, break_altitudes_km);
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            if (!(breaks[i].distance_km < breaks[i + 1].distance_km)) continue;
            cutter.add(breaks[i].distance_km, breaks[i + 1].distance_km, 0);
        }
    }
    return cutter.take();
}

}  // namespace skybake::ray_pieces
