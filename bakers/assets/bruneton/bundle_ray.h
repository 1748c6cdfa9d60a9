// A view ray through the air, in pieces with quadrature nodes: the part that is common to all suns
// of a row of texels, which share this view ray.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

struct BundleNode {
    double distance_km = 0;
    double altitude_km = 0;
    // For each layer, the transmittance from the ray's beginning times the scattering per km.
    std::vector<Spectrum> sent;
    // For each layer, `sent` times the weight of the quadrature over the piece.
    std::vector<Spectrum> weights;
    // The same for a rule that uses the first, third and fifth node of a piece; empty for the
    // others.
    std::vector<Spectrum> coarse_weights;
};

// A piece between two distances, with kBundleNodes of Gauss's nodes.
inline constexpr int kBundleNodes = 5;
struct BundlePiece {
    double from_km = 0;
    double to_km = 0;
    std::array<BundleNode, kBundleNodes> nodes;
};

// Makes the pieces of a ray, which is cut where sky_row.h cuts its rays.
std::vector<BundlePiece> make_bundle_ray(const SkyMedium& medium,
                                         const std::vector<double>& break_altitudes_km,
                                         const ScatteringView& view);

}  // namespace skybake
