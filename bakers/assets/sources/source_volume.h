// The cloud volume that another asset is made of: its `of` names the bake.
#pragma once

#include <string>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/math/bake_options.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Returns the bake that `of` names. A recipe that was read has it.
const config::CloudVolumeBake& source_volume(const config::Parameters& parameters,
                                             const std::string& of);

// Returns the voxels of that volume as its files hold them, which it shares with the volume's own
// bake. Adds what its cloud is made of to the details of `made`, which is made of them, and their
// time to its own. Returns E0300 or E0304 if a file of the cloud cannot be read, and neither value
// nor diagnostics after an interruption.
config::Outcome<Baked> hold_source_volume(const config::Parameters& parameters,
                                          const std::string& of, const BakeOptions& options,
                                          Baked& made);

// Returns whether a march may sum the densities of the volume as its files hold them.
bool is_marched_as_stored(const config::Cloud& cloud);

// Returns what an asset that is made of a cloud volume needs, for its baker's row.
template <class Asset>
std::vector<Need> needs_of_source(const config::Parameters& parameters, const Asset& asset,
                                  Certification) {
    return needs_of_voxels(parameters, source_volume(parameters, asset.of));
}

// Returns the files that such an asset reads, for its baker's row.
template <class Asset>
std::vector<InputFile> inputs_of_source(const config::Parameters& parameters, const Asset& asset) {
    return cloud_volume_inputs(parameters, source_volume(parameters, asset.of));
}

}  // namespace skybake
