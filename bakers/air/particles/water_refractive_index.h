// The refractive index n + i k of liquid water.
//
//   n   0.2 to 1.1 um: Daimon & Masumura 2007 (Appl. Opt. 46, 3811), the Sellmeier formula for
//       distilled water at 20 C, whose digits resolve the dispersion that colours rainbows;
//       1.1 to 4 um: linear between their value at 1.1 um and the table of Hale & Querry 1973
//       (Appl. Opt. 12, 555; 25 C)
//   k   Hale & Querry 1973; ln k is linear in wavelength between its entries
//
// The index is relative to vacuum. Relative to air at sea level n is 3e-4 less, which moves a
// rainbow by 0.05 degrees.
#pragma once

#include "bakers/air/particles/lorenz_mie.h"
#include "config/text/quantity.h"

namespace skybake {

// The wavelength (in vacuum) must be between 0.2 and 4 um.
ComplexNumber water_refractive_index(config::Length wavelength);

}  // namespace skybake
