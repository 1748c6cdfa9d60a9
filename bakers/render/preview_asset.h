// A baked asset in memory, as a preview looks at it: what its file holds, not what the baker meant.
#pragma once

#include <vector>

#include "bakers/field/image.h"
#include "bakers/io/manifest/manifest.h"

namespace skybake {

struct PreviewAsset {
    ManifestAsset entry;
    Image2<float> table;  // of a table; row 0 is v = 0
    std::vector<float>
        voxels;  // level 0 of a volume: x fastest, then y, then z; channels interleaved
};

}  // namespace skybake
