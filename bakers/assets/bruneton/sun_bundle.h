// The light that one view ray sends towards its beginning under many suns at once.
#pragma once

#include <vector>

#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/bundle_ray.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

// Suns, each given by the cosine of its zenith angle where a ray begins and by the cosine of its
// angle to the ray. No direction need have both: the light is then the smooth continuation of that
// of real suns.
struct SunBundle {
    // The count is a multiple of kBundleStep, which gives room for whole vectors of any width; the
    // entries beyond `wanted` are copies.
    static constexpr int kBundleStep = 16;

    SunBundle(const std::vector<double>& sun_cosines, const std::vector<double>& cosines_to_sun);

    int wanted = 0;
    int count = 0;
    std::vector<double> sun_cosines;
    std::vector<double> nu;
};

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
