// Checks whether the places that probes name correspond to their texture coordinates, which
// `verify` cannot know without the bakers' mappings.
#pragma once

#include "bakers/io/manifest/verify.h"

namespace skybake {

AssetCheck probe_check();

}  // namespace skybake
