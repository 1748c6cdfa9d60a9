// Hillaire's multiple scattering by the quadrature of the paper and of its sample: the baseline to
// which all other figures are ratios, and `method = "as_in_paper"`.
//
// It uses 64 directions, uniform over the sphere, and 20 steps each, evaluated at 0.3 of a step,
// with sunlight from a bilinear lookup of a 256x64 transmittance table ("A Scalable and Production
// Ready Sky and Atmosphere Rendering Technique", EGSR 2020, section 5.5).
#pragma once

#include "bakers/air/medium.h"
#include "bakers/field/image.h"

namespace skybake {

// Makes the transmittance table that the method reads, in Bruneton's mapping.
Image2<float> as_in_paper_transmittance(const Medium& medium, int threads);

// Returns Psi (1/sr) at an altitude for one sun, computed as the paper describes.
Spectrum multiple_scattering_as_in_paper(const Medium& medium, const Image2<float>& transmittance,
                                         double altitude_km, double sun_cos_zenith);

}  // namespace skybake
