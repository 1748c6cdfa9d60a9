// Whether the places that probes name are the texture coordinates that they give: what `verify`
// cannot know without the bakers' mappings.
#pragma once

#include "bakers/io/manifest/verify.h"

namespace skybake {

AssetCheck probe_check();

}  // namespace skybake
