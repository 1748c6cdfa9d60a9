// Whether files of a table of Bruneton's have their reader's parameters beside them.
#pragma once

#include "config/parameters.h"

namespace skybake::config {

// The table of scattering of convention takram.
inline bool has_companion(const BrunetonBake& bake) {
    return bake.convention == BrunetonConvention::takram && bake.table == BrunetonTable::scattering;
}

}  // namespace skybake::config
