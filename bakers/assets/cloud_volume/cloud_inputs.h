// Gathers the inputs of a cloud: noises of the recipe, and maps and volumes from files.
//
// Checks the files that the clouds of a recipe are made from, before any of them is baked.
#pragma once

#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/math/facts.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Reads the maps of the cloud that `bake` names and opens its volume. Adds to `details` the content
// hashes of maps, since files state only their names, and what the volume is like. Returns E0300 or
// E0304 if a file cannot be read. The volume is opened once for all assets that share intermediates.
// So is the coverage searched that gives a cloud with `cover` its cover, at the size of `bake`; E0412
// if there is none. After an interruption there may be neither inputs nor diagnostics.
Outcome<CloudInputs> cloud_inputs(const Parameters& parameters, const CloudVolumeBake& bake,
                                  Facts& details, const BakeOptions& options = {});

// Takes the part of the inputs that changes with time: noises, and what has grown. False after an interruption.
bool take_shape(const Parameters& parameters, const CloudVolumeBake& bake, CloudInputs& inputs,
                Facts& details, const BakeOptions& options);

// Returns the memory that reading the cloud's maps takes.
double bytes_to_read_maps(const Cloud& cloud);

// Reads every map and volume that the recipe names, even if no bake needs it. Returns E0300
// and E0304 at the recipe's line.
[[nodiscard]] std::vector<Diagnostic> check_cloud_files(const Parameters& parameters);

}  // namespace skybake
