// The light that one view ray sends towards its beginning under many suns at once. The ray is in pieces with
// quadrature nodes: that part is common to all suns of a row of texels, which share it.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/sun_bundle.h"

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

// Adds the sunlight that the nodes of a piece scatter, multiplied by lit[i], to single[(layer *
// kMaxChannels + channel) * count + i]. The ray begins at `view`.
void add_sunlight(const TransmittanceField& field, const ScatteringView& view,
                  const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                  double* single);

// Adds the solved light that the coarse nodes of a piece scatter to scattered[i * kChannelSlots +
// channel]. `phase_moments` is [layer][l] up to the light's degree.
void add_solved_light(const SolvedLight& light,
                      const std::vector<std::vector<Spectrum>>& phase_moments, const Shell& shell,
                      const ScatteringView& view, const BundlePiece& piece, const SunBundle& suns,
                      double* scattered);

}  // namespace skybake
