#include "bakers/light/sun_columns.h"

namespace skybake {

SunColumns sun_columns(config::MultipleScatteringMapping mapping,
                       const std::optional<config::Scene>& scene, const Shell& shell) {
    SunColumns columns{mapping};
    if (scene) {
        const SunRange range = scene_sun_range(*scene, shell);
        columns.first = sun_coordinate(mapping, range.lowest);
        columns.last = sun_coordinate(mapping, range.highest);
    }
    return columns;
}

}  // namespace skybake
