// The sky as a runtime makes it of Bruneton's tables of scattering.
#pragma once

#include <array>

#include "bakers/report/truth/sky_methods.h"

namespace skybake {

// The size of a bake by default.
struct BrunetonSkySize {
    std::array<int, 3> texels = {256, 128, 32};
    int nu_size = 8;
    double sun_cos_zenith_min = -0.20791169081775934;
};

// Bakes the tables on one thread, from nothing but the medium, as float. Layers whose phase
// function has a g, and those of spheres, are Mie's. `combined`: their light is in A of the table,
// red alone, and its colours are guessed as the implementation of 2017 does:
//
//   mie = A (colour / red) (rayleigh_red / mie_red) (mie_colour / rayleigh_colour)
//
// with the coefficients at the ground.
AirRadiance bruneton_sky(const SkyMedium& medium, const BrunetonSkySize& size, bool combined);

}  // namespace skybake
