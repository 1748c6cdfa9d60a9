// Shared by the tests of clouds: recipes of one cloud, and a spelling that tells bakes of it apart.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "tests/config/noises.h"

namespace skybake::config::testing {

// The cloud `c` of the noise `n` with these keys, and noises `n`, of one channel, and `d`, of three.
inline std::string cloud_recipe(const std::string& keys) {
    return "[clouds.c]\nnoise = 'n'\nextent = ['1 km', '2 km', '500 m']\n" + keys +
           "\n[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 2\n"
           "[noise.d]\npreset = 'nubis_detail'\n";
}

inline Cloud cloud_of(const std::string& keys, const std::vector<std::string>& settings = {}) {
    const Recipe recipe = valid(cloud_recipe(keys), settings);
    return recipe.parameters.clouds.size() == 1 ? recipe.parameters.clouds[0] : Cloud{};
}

// Returns the cloud without the places of its maps in the text of its recipe.
inline Cloud without_places(Cloud cloud) {
    for (CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
        map->file_place = map->channel_place = {};
    }
    return cloud;
}

inline std::string to_string(const CloudVolumeBake& bake) {
    return fmt::format("{} {} ", bake.cloud, bake.size) +
           (bake.extent[0].meters > 0 ? fmt::format("{} {} {} m ", bake.extent[0].meters,
                                                    bake.extent[1].meters, bake.extent[2].meters)
                                      : "") +
           to_string(static_cast<const AssetFiles&>(bake));
}

inline std::string to_string(const OccupancyBake& bake) {
    std::string text = fmt::format("{} {} {} {} {} ", bake.of, bake.channel, bake.cell,
                                   static_cast<int>(bake.filter), static_cast<int>(bake.rule));
    for (const OccupancyContent content : bake.contents)
        text += fmt::format("{} ", static_cast<int>(content));
    return text + to_string(static_cast<const AssetFiles&>(bake));
}

}  // namespace skybake::config::testing
