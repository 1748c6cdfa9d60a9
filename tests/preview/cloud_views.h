// Clouds in memory with the views of them that tests march, and random numbers for them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "bakers/render/cloud_framing.h"
#include "tests/preview/clouds.h"
#include "tests/support/any_values.h"
#include "tests/support/cloud_marches.h"

namespace skybake::test {

// The channels of a marched view.
enum Result { kSunAtBase, kSunAtTop, kFromSky, kFromGround, kOpacity, kDistance, kTransmittance };

inline CloudMedium medium_of(const config::Cloud& cloud, const std::array<int, 3>& size,
                             const std::vector<float>& voxels, int cell = 4) {
    CloudMedium medium = cloud_medium(cloud, voxels.data(), size, 1, 1);
    medium.leaps = leaps_of_voxels(medium, cell, 1);
    return medium;
}

// A picture from below or from above, of a small cloud.
inline MarchSettings small_view(const CloudMedium& medium, const SunDirection& sun) {
    MarchSettings settings = {framed_view(medium, sun, 20, 12)};
    settings.reach_m = 4 * std::max(medium.extent_m[0], medium.extent_m[1]);
    return settings;
}

inline int any_count(int from, int to) { return static_cast<int>(any_number(from, to + 1)); }

}  // namespace skybake::test
