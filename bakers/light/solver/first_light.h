// The light that was scattered or reflected once, with every layer's true phase function: what all
// further orders begin with.
//
// Along a ray of fixed azimuth sunlight is taken as linear between the fan's points, and where the
// planet's shadow crosses a cell, up to the shadow's edge alone, where sunlight is what grazes the
// ground: it jumps there, by a factor in thin air.
#pragma once

#include <vector>

#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/forward_peak_light.h"
#include "bakers/light/solver/light_field.h"
#include "bakers/light/solver/ray_fan.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// The moments at the fan's level into `out` (one level of a LightField of this degree), and for
// the ground, where `sky_irradiance` is not null, the sky's irradiance. The same bits for any
// vector width.
void gather_first_light(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                        const RayFan& fan, const TransmittanceField& sunlight, const SunAxis& suns,
                        int degree, double* out, double* sky_irradiance);

}  // namespace skybake
