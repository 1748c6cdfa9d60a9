// The light of the sun outside the air, at the mean distance of the Earth.
#pragma once

namespace skybake {

// Returns W / (m^2 nm) at a wavelength from 360 to 830 nm, 0 outside: a piecewise linear function
// with a node every 5 nm that is next to the measured spectrum in least squares. So its integral
// with any function that is linear between these nodes, as CIE's matching functions are here, is
// that of the measured spectrum itself; with smooth functions it holds within 1e-4. A single value
// is not the spectrum's: Fraunhofer lines narrower than the nodes' distance pull their neighbours
// down and up.
double solar_irradiance_W_per_m2_nm(double wavelength_nm);

}  // namespace skybake
