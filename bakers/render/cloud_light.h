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

// The fit of the paper for 5 <= diameter <= 50 um.
DropletPhase droplet_phase(double diameter_um);

// With g_hg, g_d and alpha times `eccentricity` in [0, 1]: isotropic at 0.
DropletPhase widened(const DropletPhase& phase, double eccentricity);

// In 1/sr, at a cosine of 1 - `offset`, which stays exact near the forward peak.
double phase_value(const DropletPhase& phase, double offset);

// The mean cosine g of scattering angles.
double mean_cosine(const DropletPhase& phase);

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
