// How all spheres of a layer together scatter light of one wavelength.
//
// Coefficients of different kinds of spheres add up. The phase function of all
// is the mean of theirs, weighted with what each kind scatters: a table whose
// cells are those of the finest.
#pragma once

#include <memory>

#include "bakers/air/particles/tabulated_phase.h"
#include "config/sections/particles.h"

namespace skybake {

struct SphereScattering {
    double extinction_per_m = 0;  // where the layer's density is 1; never below scattering
    double scattering_per_m = 0;
    std::shared_ptr<const TabulatedPhase> phase;
    double error = 0;  // of the phase function, as in ParticleScattering
};

// Returns what the kinds do at their numbers, or at those numbers which give
// the layer's extinction at 550 nm. `accuracy` is that of
// particle_scattering.h; 0 threads means all processors. Between multiples of
// the layer's `step` coefficients follow the power law between the two next to
// the wavelength, and phase functions are linear. Results are kept for the life
// of the process: equal calls return the same pointers. May be called from any
// thread.
std::shared_ptr<const SphereScattering> sphere_scattering(const config::LayerParticles& layer,
                                                          config::Length wavelength,
                                                          double accuracy, int threads);

// Returns the number of all spheres per cubic metre, before they are scaled.
double spheres_per_m3(const config::LayerParticles& layer);

}  // namespace skybake
