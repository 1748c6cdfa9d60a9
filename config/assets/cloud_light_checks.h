// Checks of the sections of asset = "cloud_light", which cloud_light.cpp resolves.
#pragma once

#include <cstddef>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_light.h"
#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"

namespace skybake::config {

// Returns the number of channels, or 1 if it cannot be told. It reports a number of suns that no file
// holds (E0129), azimuths that are not one for each sun and a part that the harmonics do not have
// (E0171), and several suns of one file of radiance (E0176).
std::size_t check_contents(const DecodedSection& bake, CloudLightContents contents,
                           Decoder& decoder);

// Reports a clear sky without an atmosphere, and a cloud that rises above the air (E0189). `cloud` is
// null if it has errors.
void check_clear_sky(const DecodedSection& bake, const Cloud* cloud, const RecipeSoFar& recipe,
                     Decoder& decoder);

}  // namespace skybake::config
