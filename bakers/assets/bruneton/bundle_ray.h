// A view ray through the air in pieces with quadrature nodes: what the suns of a row of texels, all
// of which look along it, have in common.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

struct BundleNode {
    double distance_km = 0;
    double altitude_km = 0;
    // Of each layer: transmittance from the ray's beginning times scattering per km.
    std::vector<Spectrum> sent;
    // Of each layer: `sent` times the weight of the quadrature over the piece.
    std::vector<Spectrum> weights;
    // The same of a rule that uses the first, third and fifth node of a piece; none for others.
    std::vector<Spectrum> coarse_weights;
};

// Between two distances, with kBundleNodes of Gauss' nodes.
inline constexpr int kBundleNodes = 5;
struct BundlePiece {
    double from_km = 0;
    double to_km = 0;
    std::array<BundleNode, kBundleNodes> nodes;
};

// Cut where sky_row.h cuts its rays.
std::vector<BundlePiece> make_bundle_ray(const SkyMedium& medium,
                                         const std::vector<double>& break_altitudes_km,
                                         const ScatteringView& view);

// The polynomials that are 1 at one node and 0 at the others, at a share in [0, 1] of a piece: so
// what nodes send is interpolated.
std::array<double, kBundleNodes> node_shares(double share);

}  // namespace skybake
