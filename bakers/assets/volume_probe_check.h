// Whether the places that the probes of a volume name are the texture coordinates that they give.
#pragma once

#include <string>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "config/parameters.h"

namespace skybake {

// One message per failure; `checks` is increased by the number of probes. `parameters` are those
// that the asset carries, `bake` the asset's own among them.
std::vector<std::string> check_volume_places(const ManifestAsset& asset,
                                             const config::Parameters& parameters,
                                             const config::Bake& bake, int& checks);

}  // namespace skybake
