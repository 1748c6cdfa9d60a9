// The pieces into which a ray through the air is cut so that Gauss's rule with five nodes integrates
// the light of each.
//
// Optical depths follow from the extinction at the nodes by collocation: the polynomial through
// the extinction at the five nodes of a piece is integrated up to each node and over the piece. The
// integral of the light is then that of Gauss's method for differential equations, of order ten,
// like the quadrature itself. It costs two exponentials per layer and node, where an exact depth from
// the ray's beginning costs about a hundred.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"
#include "bakers/math/quadrature.h"

namespace skybake::ray_pieces {

inline constexpr std::size_t kNodes = 5;
inline constexpr double kLargestDepth = 1;  // optical depth of a piece, along the ray
// Light that has passed this optical depth contributes e^-25 = 1e-11 of its radiance.
inline constexpr double kLastLight = 25;
// The largest number of halvings of a piece: 2^-20 of a ray is a few metres.
inline constexpr int kMostHalvings = 20;
// Over a piece of a row of rays the vertical turns by less than this, about a degree. Along a
// horizontal ray at dusk the sun's rays graze one scale height after the other, a few degrees apart.
inline constexpr double kLongestTurn = 1.0 / 48;

// Returns Gauss's rule with kNodes nodes on [0, 1].
const QuadratureRule& gauss_rule();

// Light that was scattered before is smooth: the first, third and fifth node are enough for it, with
// what the air sends from all five. shares[j][i] is the parabola that is 1 at coarse node j, at node i.
inline constexpr std::array<std::size_t, 3> kCoarseNodes = {0, 2, 4};
using CoarseShares = std::array<std::array<double, kNodes>, kCoarseNodes.size()>;
const CoarseShares& coarse_shares();

// Returns the greatest length of the piece of a ray between two distances from its start, in km. It
// grows with the distance from the planet's centre only far outside of the planet: in air that is a
// hundred radii deep a ray would otherwise have thousands of pieces.
double longest_piece_km(const Shell& shell, double altitude_km, double s_km, double from_km,
                        double to_km);

// Returns the greatest optical depth of a piece, from the depths at its ends, over the channels
// whose light still reaches it; nothing if no light does.
std::optional<double> lit_depth(const Spectrum& from, const Spectrum& to, int channels);

struct Node {
    double distance_km = 0;    // from the ray's beginning
    double altitude_km = 0;    // in [0, thickness]
    double width_km = 0;       // its weight in an integral over the distance
    Spectrum transmittance{};  // from the ray's beginning
};

struct Piece {
    double from_km = 0;
    double to_km = 0;
    std::array<Node, kNodes> nodes;
};

struct CutRay {
    std::vector<Piece> pieces;  // pieces lit from the ray's beginning, ascending
    Spectrum depth{};           // optical depth of the whole ray
};

// A node of a part of a piece.
struct StretchNode {
    double distance_km = 0;
    double altitude_km = 0;
    double width_km = 0;
    // The polynomials that are 1 at one node of the piece and 0 at the others: what nodes send is
    // interpolated by them.
    std::array<double, kNodes> shares{};
};

// Returns the nodes of the stretch from ... to of a piece of the ray that starts at an altitude with
// s = r mu.
std::array<StretchNode, kNodes> stretch(const Shell& shell, double altitude_km, double s_km,
                                        double piece_from_km, double piece_to_km, double from_km,
                                        double to_km);

// Cuts the ray that starts at an altitude in [0, thickness] with s = r mu where it crosses one of
// the altitudes and at its lowest point, and halves the pieces until they are short enough.
CutRay cut(const Medium& medium, double altitude_km, double s_km, double length_km,
           const std::vector<double>& break_altitudes_km);

}  // namespace skybake::ray_pieces
