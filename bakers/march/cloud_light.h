// The light that reaches a point within a cloud where none is solved for (light_in_cloud.h), and the phase
// function of cloud droplets.
//
// Sunlight follows Wrenninge, Kulla & Lundqvist, "Oz: The Great and Volumetric", SIGGRAPH Talks
// 2013, and Hillaire, "Physically Based Sky, Atmosphere and Cloud Rendering in Frostbite", 2016.
// Light that is scattered n more times is treated like light that is scattered once in a thinner
// medium, whose scattering is weaker and wider:
//
//   J = E sum_n b^n p_n(u) exp(-a^n tau),   p_n: the phase function with eccentricities times c^n
//
// tau is the optical depth towards the sun. The path to the eye is attenuated with the full optical
// depth. There is no "powder" term. a = c = 1/2 as in these papers; b is 0.7 instead of their 1/2.
// Under a sun at the zenith, a slab of optical depth 20 then reflects 0.37 of the light; two-stream
// theory for droplets gives 0.57, and b = 1/2 gives 0.15. The sum does not conserve energy: a flat
// slab would reflect 0.98 of the light with the sun at 20 degrees and 2.6 at 6 degrees, because
// thin octaves see light that has not been attenuated. The method is for clouds that are not slabs.
//
// Light from sky and ground follows two-stream theory. A layer of optical depth tau transmits the
// share 2 / (2 + (1 - g) tau) of diffuse light (Bohren, "Multiple scattering of light and some of
// its observable consequences", Am. J. Phys. 55, 1987), where g is the mean cosine of scattering.
// The depths of layers above each other add up, so the share V of a hemisphere's light is carried
// from plane to plane by
//
//   1 / V' = 1 / V + (1 - g) sigma h / 2,   V smoothed over its neighbours after each plane
//
// on a grid of blocks of voxels: for the sky from V = 1 at the top downwards, and for the ground
// from V = 1 at the base upwards. Smoothing with the weights s, 1 - 2 s, s along x and y represents
// slanting directions: a variance of h^2 / 2 per plane along each axis is that of directions at 45
// degrees.
#pragma once

#include <array>

#include "bakers/march/cloud_medium.h"

namespace skybake {

// The phase function of cloud droplets: a blend of Henyey-Greenstein's and Draine's functions,
// which fits Mie's theory for water droplets of 5 to 50 um and any visible wavelength.
//
//   p(u) = (1 - w) HG(g_hg; u) + w D(g_d, alpha; u)                                        1/sr
//   HG(g; u) = 1/4pi (1 - g^2) / (1 + g^2 - 2 g u)^(3/2)
//   D(g, alpha; u) = HG(g; u) (1 + alpha u^2) / (1 + alpha (1 + 2 g^2) / 3)
//
// with u the cosine of the scattering angle and w, g_hg, g_d, alpha functions of the droplets'
// diameter. Jendersie & d'Eon, "An Approximate Mie Scattering Function for Fog and Cloud
// Rendering", SIGGRAPH Talks 2023; Draine 2003.
struct DropletPhase {
    double hg_g = 0;
    double draine_g = 0;
    double draine_alpha = 0;
    double draine_share = 0;  // w
};

// The paper's fit for 5 <= diameter <= 50 um.
DropletPhase droplet_phase(double diameter_um);

// Multiplies g_hg, g_d and alpha by `eccentricity` in [0, 1]; 0 gives isotropic scattering.
DropletPhase widened(const DropletPhase& phase, double eccentricity);

// Returns the phase function in 1/sr at the cosine 1 - `offset`. This form stays exact near the
// forward peak.
double phase_value(const DropletPhase& phase, double offset);

// The mean cosine g of the scattering angle.
double mean_cosine(const DropletPhase& phase);

// The share 1 - g of light that droplets of the usual diameter send back, as two-stream theory counts it.
double backward_share();

inline constexpr int kOctaves = 8;
inline constexpr double kOctaveBrightness = 0.7;  // b
inline constexpr double kOctaveHalving = 0.5;     // a and c
// A typical value for cumulus (Miles, Verlinde & Clothiaux 2000: effective diameters of 8 to 16
// um).
inline constexpr double kDropletDiameter_um = 12;

// The phase function p_n of an octave and its brightness b^n.
struct OctavePhase {
    double brightness = 1;
    DropletPhase phase;
};
std::array<OctavePhase, kOctaves> octave_phases();

// Returns J / E by the sum above.
double sun_scattering(const std::array<OctavePhase, kOctaves>& octaves, double offset, double tau);

// The shares of each hemisphere's diffuse light, on a grid of blocks that divide the volume evenly.
// The grid has one more block on each side, as a PaddedVolume has one more voxel.
struct DiffuseShare {
    PaddedVolume from_sky;
    PaddedVolume from_ground;
    // The share that passes the whole layer, as the mean over the tile.
    double through = 1;
};
DiffuseShare diffuse_share(const CloudMedium& medium, int block, int threads);

}  // namespace skybake
