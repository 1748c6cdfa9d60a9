// One [clouds.NAME] with its height profile, maps and towers.
#pragma once

#include <span>
#include <string>

#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::config {

// `noises` are those of the recipe. Reports names of noises that are not there (E0130), scaled
// frequencies that are too high (E0128), and a map of types where the profile blends none (E0111).
Cloud decode_cloud(const std::string& name, const Place& place, const Table& table,
                   std::span<const Noise> noises, Decoder& decoder);

}  // namespace skybake::config
