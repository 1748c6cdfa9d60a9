// The sky that a runtime renders from Bruneton's tables of scattering.
#pragma once

#include <array>

#include "bakers/report/truth/sky_methods.h"

namespace skybake {

// The size of the tables. The default is that of a bake.
struct BrunetonSkySize {
    std::array<int, 3> texels = {256, 128, 32};
    int nu_size = 8;
    double sun_cos_zenith_min = -0.20791169081775934;
};

// Bakes the tables as float, on one thread, from the medium alone. Mie layers are those whose phase
// function has a g, and those of spheres. If `combined`, the A channel of the table holds only the
// red light of the Mie layers, and the other colours are estimated as in the implementation of
// 2017:
//
//   mie = A (colour / red) (rayleigh_red / mie_red) (mie_colour / rayleigh_colour)
//
// with the coefficients at the ground.
AirRadiance bruneton_sky(const SkyMedium& medium, const BrunetonSkySize& size, bool combined);

}  // namespace skybake
