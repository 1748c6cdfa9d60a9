// How light reaches a point within a cloud.
//
// From the sun: Wrenninge, Kulla & Lundqvist, "Oz: The Great and Volumetric", SIGGRAPH Talks 2013,
// also Hillaire, "Physically Based Sky, Atmosphere and Cloud Rendering in Frostbite", 2016: light
// scattered n times more is like light scattered once, in a thinner medium of weaker and wider
// scattering,
//
//   J = E sum_n b^n p_n(u) exp(-a^n tau),   p_n: the phase function with eccentricities times c^n
//
// tau being the optical depth towards the sun; the way to the eye is dimmed as it is. There is no
// "powder" term. a = c = 1/2 as there; b is 0.7 where they have 1/2. Under a zenith sun a slab of
// optical depth 20 then sends back 0.37 of the light, where two-stream theory for droplets has 0.57
// and b = 1/2 gives 0.15. The sum conserves no energy: a flat slab would send back 0.98 under a sun
// 20 degrees high, and 2.6 at 6 degrees, where thin octaves see light that has not been dimmed. It
// is for clouds that are no slabs.
//
// From sky and ground: two-stream theory. A layer of optical depth tau lets 2 / (2 + (1 - g) tau)
// of diffuse light through (Bohren, "Multiple scattering of light and some of its observable
// consequences", Am. J. Phys. 55, 1987), g being the mean cosine; layers above each other add their
// depths. So the share V of a hemisphere's light is carried from plane to plane by
//
//   1 / V' = 1 / V + (1 - g) sigma h / 2,   V smoothed over its neighbours after each plane
//
// from 1 at the top downwards for the sky, and from 1 at the base upwards for the ground, on a grid
// of blocks of voxels. Smoothing by s, 1 - 2 s, s along x and y stands for slanting directions: a
// variance of h^2 / 2 a plane along each axis is that of directions at 45 degrees.
#pragma once

#include <array>
#include <vector>

#include "bakers/render/cloud_medium.h"
#include "bakers/render/droplet_phase.h"

namespace skybake {

inline constexpr int kOctaves = 8;
inline constexpr double kOctaveBrightness = 0.7;  // b
inline constexpr double kOctaveHalving = 0.5;     // a and c
// Typical of cumulus (Miles, Verlinde & Clothiaux 2000: effective diameters of 8 to 16 um).
inline constexpr double kDropletDiameter_um = 12;

// The phase function of each octave with its brightness: b^n p_n.
struct OctavePhase {
    double brightness = 1;
    DropletPhase phase;
};
std::array<OctavePhase, kOctaves> octave_phases();

// J / E by the sum above.
double sun_scattering(const std::array<OctavePhase, kOctaves>& octaves, double offset, double tau);

// Shares of a hemisphere's diffuse light on a grid of blocks that divide the volume evenly, with
// one more block on each side, as PaddedVolume has them.
struct DiffuseShare {
    PaddedVolume from_sky;
    PaddedVolume from_ground;
    // What gets through the whole layer, as the mean over the tile.
    double through = 1;
};
DiffuseShare diffuse_share(const CloudMedium& medium, int block, int threads);

}  // namespace skybake
