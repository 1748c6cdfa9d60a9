// Gathers what a cloud is made of: noises of the recipe and maps from files.
#pragma once

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/math/facts.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Reads the maps of the cloud that `bake` names, and adds their content hashes to `details`, since
// files carry just their names. E0300, E0304: a map cannot be read.
config::Outcome<CloudInputs> cloud_inputs(const config::Parameters& parameters,
                                          const config::CloudVolumeBake& bake, Facts& details);

// Reads every map that a cloud of the recipe names, whether it is baked or not. E0300, E0304, at
// the recipe's line.
[[nodiscard]] std::vector<config::Diagnostic> check_maps(const config::Parameters& parameters);

}  // namespace skybake
