// Light that one view ray sends towards its beginning under many suns at once.
#pragma once

#include <vector>

#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/bundle_ray.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

// Suns by the cosine of their zenith angle where a ray begins and that to the ray. There may be
// none such: what they bring is the smooth continuation of what real ones bring.
struct SunBundle {
    // Room for whole vectors of any width: a multiple of kBundleStep, the last ones copies.
    static constexpr int kBundleStep = 16;

    SunBundle(const std::vector<double>& sun_cosines, const std::vector<double>& cosines_to_sun);

    int wanted = 0;
    int count = 0;
    std::vector<double> sun_cosines;
    std::vector<double> nu;
};

// Adds what the nodes of a piece scatter of sunlight, times lit[i], to
// single[(layer * kMaxChannels + channel) * count + i]. `view` is where the ray begins.
void add_sunlight(const TransmittanceField& field, const ScatteringView& view,
                  const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                  double* single);

// Adds what the coarse nodes of a piece scatter of the solved light to
// scattered[i * kChannelSlots + channel]. `phase_moments` [layer][l] up to the light's degree.
void add_solved_light(const SolvedLight& light,
                      const std::vector<std::vector<Spectrum>>& phase_moments, const Shell& shell,
                      const ScatteringView& view, const BundlePiece& piece, const SunBundle& suns,
                      double* scattered);

}  // namespace skybake
