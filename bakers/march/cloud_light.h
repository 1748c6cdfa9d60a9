// The light that reaches a point within a cloud where none is solved for (light_in_cloud.h).
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

#include "bakers/air/cloud_phase.h"
#include "bakers/march/cloud_medium.h"

namespace skybake {

inline constexpr int kOctaves = 8;
inline constexpr double kOctaveBrightness = 0.7;  // b
inline constexpr double kOctaveHalving = 0.5;     // a and c

// The phase function p_n of an octave and its brightness b^n.
struct OctavePhase {
    double brightness = 1;
    CloudPhase phase;
};
std::array<OctavePhase, kOctaves> octave_phases(const CloudPhase& phase);

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
