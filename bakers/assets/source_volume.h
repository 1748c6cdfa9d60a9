// The cloud volume that another asset is made of: its `of` names the bake.
#pragma once

#include <string>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/facts.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Returns the bake that `of` names. A recipe that was read has it.
const config::CloudVolumeBake& source_volume(const config::Parameters& parameters,
                                             const std::string& of);

// Returns the voxels of that volume as its files hold them, which it shares with the volume's own
// bake. Adds what its cloud is made of to `details`. Returns E0300 or E0304 if a file of the cloud
// cannot be read, and neither value nor diagnostics after an interruption.
config::Outcome<Baked> hold_source_volume(const config::Parameters& parameters,
                                          const std::string& of, const BakeOptions& options,
                                          Facts& details);

}  // namespace skybake
