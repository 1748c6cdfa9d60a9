// The sun's axis of a table of multiple scattering: the mapping over the suns of the scene.
#pragma once

#include <optional>

#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/scene_sun_range.h"

namespace skybake {

struct SunColumns {
    config::MultipleScatteringMapping mapping = config::MultipleScatteringMapping::hillaire;
    double first = 0;  // of the mapping's coordinate
    double last = 1;

    double cosine(double x) const { return sun_cos_zenith_at(mapping, first + (last - first) * x); }
    double coordinate(double sun_cos_zenith) const {
        return (sun_coordinate(mapping, sun_cos_zenith) - first) / (last - first);
    }
};

// The whole axis without a scene.
SunColumns sun_columns(config::MultipleScatteringMapping mapping,
                       const std::optional<config::Scene>& scene, const Shell& shell);

}  // namespace skybake
