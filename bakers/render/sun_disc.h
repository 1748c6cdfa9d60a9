// The sun's disc in pictures of the sky, and the glare around it.
//
// The disc is 0.533 degrees wide and darker towards its limb, more so for short wavelengths:
//
//   L(mu) = E / (pi s^2) (1 + alpha / 2) mu^alpha,   alpha = -0.023 + 0.292 um / wavelength
//
// where s is the disc's radius, mu = sqrt(1 - (angle / s)^2) and E the sunlight that the air lets
// through. The factor keeps the disc's light as it is (Hestroffer & Magnan 1998, "Wavelength
// dependency of the Solar limb darkening", for 416 to 1100 nm). The horizon cuts the disc.
//
// Glare is the light of the disc that a lens or an eye scatters. Both scatter per illuminance of the
// plane that the line of sight meets at a right angle (CIE 146:2002), hence by the cosine of the angle
// from the sun; from 90 degrees on there is none. Only the disc's light is scattered, not that of the
// sky.
//
// An eye has the CIE's total glare function (Vos & van den Berg 1999, CIE 135/1). Its narrowest term, 0.0046 degrees wide, stays with the disc here; the
// others are a veil around it. In 1/sr, for an angle of theta degrees, the age A and the
// pigmentation p of the eye:
//
//   veil = (1 - 0.08 (A / 70)^4) 1.5e5 / (1 + (theta / 0.045)^2)^(3/2)
//          + (1 + 1.6 (A / 70)^4) (400 / t + 3e-8 theta^2 + p (1300 / t^(3/2) + 0.8 / t^(1/2)))
//          + 2.5e-3 p,       t = 1 + (theta / 0.1)^2,   A = 25,   p = 0.5 (brown eyes)
//
// The disc loses what the veil has, two thirds of its light, most of which falls into the disc again
// or next to it.
//
// A lens scatters by the roughness of its surfaces and by dust, which falls with the square of the
// angle's sine up to a right angle (KenKnight 1984, "Light Scattered from Polished Optical Surfaces:
// Wings of the Point Spread Function", NASA Workshop on Improvements to Photometry):
//
//   veil = w / (pi ln(1 + 1 / s^2)) / (sin^2 theta + s^2)
//
// Its integral over the half sphere, by the cosine, is the share w of the light. What is scattered by less
// than the disc's radius s stays in the disc. w = 0.01 is this program's choice; such a veil is brighter
// than a clear sky within about 4 degrees of the sun.
//
// Hard cases: a disc half below the horizon, a pixel wider than the disc, the veil in the middle of
// the disc, tables whose wavelengths are unknown, one channel.
#pragma once

#include <cstddef>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/render/sky_rays.h"
#include "bakers/render/sky_tables.h"
#include "config/sections/preview.h"

namespace skybake {

using config::Glare;

// Returns alpha at a wavelength.
double limb_exponent(double wavelength_nm);

// Returns the wavelength of a channel; of channels whose wavelength is unknown, that of green light.
double wavelength_nm_of(const SkyTables& tables, std::size_t channel);

// Returns the brightness of the disc at an angle from its middle, as a share of the disc's mean
// brightness; `angle_share` is the angle over the disc's radius, in [0, 1].
double limb_darkening(double angle_share, double wavelength_nm);

// Return the veil of an eye and that of a lens in 1/sr at an angle in [0, 90] degrees from a point of
// light and from the disc's middle, per illuminance.
double glare_veil(double degrees);
double lens_veil(double degrees);

// Adds the disc, and its glare, to the radiance of a picture in the tables' channels. Channels whose
// wavelength is unknown are as dark at the limb as green light is.
void add_sun(const SkyMedium& medium, const SkyTables& tables, const SkyView& view, Glare glare,
             Image2<float>& radiance);

}  // namespace skybake
