// This header computes the coefficients of the air's layers at any wavelength. A layer of a gas or of
// an aerosol says what it is and how much there is of it; a layer given by numbers is known at the
// recipe's wavelengths only.
//
// This header makes spheres of OPAC's kinds of airborne particles, as
// [particles.NAME] has them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "config/optics/aerosol_components.h"
#include "config/sections/atmosphere.h"
#include "config/sections/particles.h"

namespace skybake::config {

// Returns the spheres of a component, with its name. The relative humidity is
// in [0, 0.99].
Particles spheres_of(AerosolComponent component, double relative_humidity);

// Returns the kinds of spheres of a mixture with their numbers near the ground.
std::vector<SphereKind> kinds_of(AerosolMixture mixture, double relative_humidity);

// The wavelength at which optical depths and visibilities of aerosols are stated.
inline constexpr Length aerosol_wavelength{550e-9};

// Returns the extinction at 550 nm of haze in which things can be seen over this distance, by
// Koschmieder's law: 3.912 over the visibility, for a contrast of 2 %, less what clean air at sea
// level scatters (0.0116 /km). It is 0 or less for a visibility beyond 337 km.
InverseLength haze_of_visibility(Length visibility);

// Fills in the scattering and extinction of a layer of a gas or an aerosol, and of spheres with an
// optical depth the extinction at 550 nm; it leaves other layers as they are. `thickness` is that
// of the air. It returns what is wrong, or an empty text: a gas or a kind of spheres is not known
// at a wavelength, the layer has no density within the air, or a coefficient is beyond 1e6 /m.
std::string resolve_matter(Layer& layer, Length thickness, std::span<const Length> wavelengths);

// Returns the atmosphere, given at some wavelengths, at others. Coefficients that are numbers follow
// the power law between the two wavelengths next to them, and beyond the ends that of the nearest
// two; albedos are linear between wavelengths and constant beyond. `given` is in the order of the
// recipe's channels; equal wavelengths among them are allowed. Gases must be known at `wanted`.
Atmosphere atmosphere_at(const Atmosphere& atmosphere, std::span<const Length> given,
                         std::span<const Length> wanted);

// Returns the atmosphere at `count` of its wavelengths, from number `first` on.
Atmosphere channels_of(const Atmosphere& atmosphere, std::size_t first, std::size_t count);

}  // namespace skybake::config
