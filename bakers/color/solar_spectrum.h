// The light of the sun outside the air, at the mean distance of the Earth.
#pragma once

namespace skybake {

// Returns W / (m^2 nm) at a wavelength from 360 to 830 nm, 0 outside. Each entry of the table, one
// every 5 nm, is the spectrum weighted with a triangle of 5 nm to either side, so that the
// linear interpolation keeps the energy: integrals with smooth functions hold within 0.1 %. Fraunhofer
// lines narrower than that are smoothed away.
double solar_irradiance_W_per_m2_nm(double wavelength_nm);

}  // namespace skybake
