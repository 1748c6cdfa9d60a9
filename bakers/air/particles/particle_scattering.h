// How a kind of particles scatters light of one wavelength, on the average over their sizes.
//
// The integral over sizes is a trapezoidal rule over the logarithm of the radius, whose nodes
// double until half of the last change of the cross-sections and of the phase function at 66 angles
// is within `accuracy`. It falls as the number of nodes and no faster: water hardly absorbs,
// and has resonances narrower than any distance of nodes. 2,000 radii make 1 % of a cloud's phase
// function, 20,000 make 0.1 %.
//
// The angles at which the series is summed double in turn (nodes as in tabulated_phase.h) until
// interpolation between them is within `accuracy`; the cells of the table until lines between
// them are.
//
// Work is bounded: large drops (rain) and spheres all of one size, whose phase function is as
// rugged as interference makes it, end before they reach the accuracy. `error` says how far they
// came: a few per cent for rain, whose noise is fine in angle.
#pragma once

#include <memory>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/tabulated_phase.h"
#include "config/sections/particles.h"

namespace skybake {

struct ParticleScattering {
    double extinction_cross_section_m2 = 0;  // mean over all particles; never below scattering
    double scattering_cross_section_m2 = 0;
    double mean_cosine = 0;  // by the series; the table's own is tabulated_mean_cosine
    TabulatedPhase phase;    // for unpolarised light
    // The estimated relative error of the phase function where it is largest: the worst of radii,
    // angles and table. Against sums over 150,000 radii it was right within a factor of 2.
    double error = 0;
    int radii = 0;   // that were averaged
    int angles = 0;  // at which the series was summed
};

// Spheres may have x = 2 pi r / wavelength up to this, see largest_size_parameter.
constexpr double kLargestSizeParameter = 3e5;

// Of the largest sphere that counts.
double largest_size_parameter(const config::Particles& particles, config::Length wavelength);

// The refractive index of the particles' material; of water for wavelengths of
// water_refractive_index.h.
ComplexNumber refractive_index(const config::Particles& particles, config::Length wavelength);

// For a largest size parameter up to kLargestSizeParameter, a refractive index at least 1e-6 from 1
// (spheres of 1 scatter nothing, and nothing has no phase function) and 1e-6 <= accuracy < 1. The
// same bits for any number of threads; 0 of them means all.
ParticleScattering particle_scattering(const config::Particles& particles,
                                       config::Length wavelength, double accuracy, int threads);

// The same, kept for the life of the process: later calls with the same values (the name aside)
// give what the first one made. May be called from any thread; calls that come while the first one
// is at work make their own.
std::shared_ptr<const ParticleScattering> remembered_particle_scattering(
    const config::Particles& particles, config::Length wavelength, double accuracy, int threads);

}  // namespace skybake
