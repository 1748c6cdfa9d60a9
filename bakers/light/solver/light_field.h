// The unknowns of a solution: moments of light at every level for every sun, and the sky's
// irradiance of the ground.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/light/solver/light_moments.h"
#include "bakers/math/vectors.h"

namespace skybake {

// Values stand in groups of kChannelSlots, one per channel and unused ones 0. Moments of azimuthal
// order m are over sin^m of the sun's zenith angle: so they are smooth in its cosine where the sun
// is at the zenith.
struct LightField {
    int levels = 0;
    int suns = 0;
    int degree = 0;
    // [((level * suns + sun) * moment_count(degree) + lm) * kChannelSlots + channel]
    std::vector<double> moments;
    // [sun * kChannelSlots + channel]
    std::vector<double> sky_irradiance;

    LightField() = default;
    LightField(int level_count, int sun_count, int moment_degree)
        : levels(level_count),
          suns(sun_count),
          degree(moment_degree),
          moments(static_cast<std::size_t>(level_count) * level_size()),
          sky_irradiance(static_cast<std::size_t>(sun_count) * kChannelSlots) {}

    std::size_t sun_size() const {
        return static_cast<std::size_t>(moment_count(degree)) * kChannelSlots;
    }
    std::size_t level_size() const { return static_cast<std::size_t>(suns) * sun_size(); }
    const double* at(int level, int sun) const {
        return moments.data() + static_cast<std::size_t>(level) * level_size() +
               static_cast<std::size_t>(sun) * sun_size();
    }
    double* at(int level, int sun) {
        return moments.data() + static_cast<std::size_t>(level) * level_size() +
               static_cast<std::size_t>(sun) * sun_size();
    }
};

}  // namespace skybake
