// The light that a layer scatters, all orders of it, in the cells of a grid: the fixed point of
//
//   J = w' sum_lm chi'_l a_lm Y_lm,   a_lm: the coefficients of the radiance that J and J_1 emit
//
// J_1 is sunlight that is scattered for the first time. The cloud is scaled (cloud_scattering.h).
#pragma once

#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/assets/cloud_light/radiance_levels.h"
#include "bakers/math/bake_options.h"

namespace skybake::cloud_light {

struct SolvedRadiance {
    // Coefficients of J without J_1 per extinction of the scaled cloud, in 1/sr for an irradiance of 1:
    // the light in direction d is the sum of coefficients times harmonics of d.
    CellFields scattered;
    std::vector<float> sun_depths;  // of places, x fastest; empty without a sun
    int sweeps = 0;
    double change = 0;  // of J in the last sweep: root mean square over that of J
};

// The change at which the solution ends. In towering cumulus the error was four times as large.
inline constexpr double kLargestChange = 2e-4;

// Solves for the light of several sources in the same cells, which are as many as places; each has its
// centre at one.
class RadianceSolver {
  public:
    // The layer must outlive it.
    RadianceSolver(const CloudLayer& layer, const PlaceGrid& places,
                   const CloudScattering& scattering, int degree, const BakeOptions& options);

    // The light is incomplete once options.progress is cancelled.
    SolvedRadiance solve(const LayerSources& sources, const BakeOptions& options,
                         double largest_change = kLargestChange) const;

    // s of the scaled cloud.
    double extinction_share() const { return scaled_.extinction_share; }

  private:
    const CloudLayer& layer_;
    PlaceGrid places_;
    ScaledScattering scaled_;
    RadianceLevels levels_;
};

// Solves for the light of some sources alone.
inline SolvedRadiance solve_radiance(const CloudLayer& layer, const PlaceGrid& places,
                                     const CloudScattering& scattering, int degree,
                                     const LayerSources& sources, const BakeOptions& options) {
    return RadianceSolver(layer, places, scattering, degree, options).solve(sources, options);
}

}  // namespace skybake::cloud_light
