// The light that one view ray sends towards its beginning under many suns at once.
#pragma once

#include <vector>

#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/bundle_ray.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/sun_bundle.h"

namespace skybake {

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
