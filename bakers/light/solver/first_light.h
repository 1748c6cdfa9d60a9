// The light that was scattered or reflected once, with every layer's true phase function: what all
// further orders begin with.
//
// Along a ray of fixed azimuth sunlight is taken as linear between the fan's points, and where the
// planet's shadow crosses a cell, up to the shadow's edge alone, where sunlight is what grazes the
// ground: it jumps there, by a factor in thin air.
#pragma once

#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/light/solver/transport.h"

namespace skybake {

// Light that was scattered once, into the forward peaks of spheres (forward_peak.h).
//
// It comes from next to the sun. On the ray to the sun itself each point sends T_sun sigma_s,
// whatever its distance, since the way on from there is the way that sunlight would have taken: the
// moments are T_sun tau_s chi_l Y_lm(sun), tau_s the layer's scattering depth to the sun, chi_l the
// peak's moments. That leaves out how the light differs within 10 degrees of the sun.

struct SplitPhase {
    WidePhase wide;
    std::vector<Spectrum> peak;  // chi_0 .. chi_degree of the peak, chi_0 its share; or empty
};

// One for each layer of the medium.
std::vector<SplitPhase> split_phases(const SkyMedium& medium, int degree);

// Adds the light in the peaks at an altitude to the moments of one level of a LightField of this
// degree, and for the ground, where `sky_irradiance` is not null, to the sky's irradiance.
void add_forward_peaks(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                       double altitude_km, const SunAxis& suns, int degree, double* out,
                       double* sky_irradiance);

// The moments at the fan's level into `out` (one level of a LightField of this degree), and for
// the ground, where `sky_irradiance` is not null, the sky's irradiance. The same bits for any
// vector width.
void gather_first_light(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                        const RayFan& fan, const TransmittanceField& sunlight, const SunAxis& suns,
                        int degree, double* out, double* sky_irradiance);

}  // namespace skybake
