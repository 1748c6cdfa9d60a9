// Gathers the inputs of a cloud: noises of the recipe and maps from files.
#pragma once

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/math/facts.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Reads the maps of the cloud that `bake` names, and adds their content hashes to `details`, since
// files state only their names. Returns E0300 or E0304 if a map cannot be read.
config::Outcome<CloudInputs> cloud_inputs(const config::Parameters& parameters,
                                          const config::CloudVolumeBake& bake, Facts& details);

// Reads every map that a cloud of the recipe names, even if the cloud is not baked. Returns E0300
// and E0304 at the recipe's line.
[[nodiscard]] std::vector<config::Diagnostic> check_maps(const config::Parameters& parameters);

}  // namespace skybake
