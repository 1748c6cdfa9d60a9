// Shared by the tests of clouds: recipes of one cloud, and a spelling that tells clouds apart.
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

inline std::string to_string(const HeightProfile& profile) {
    std::string text =
        fmt::format("{} {} {} {}", static_cast<int>(profile.type), profile.bottom_sharpness,
                    profile.top_falloff, profile.cloud_type);
    for (const HeightPoint& point : profile.table)
        text += fmt::format(" {}:{}", point.height, point.value);
    return text;
}

inline std::string to_string(const CloudMap& map) {
    return fmt::format("{} {} {} {} {} {} {} {}", map.file, map.path.string(), map.channel,
                       static_cast<int>(map.wrap), static_cast<int>(map.filter),
                       static_cast<int>(map.color_space), map.factor, map.clamp);
}

inline std::string to_string(const Tower& tower) {
    return fmt::format("{} {} {} {} {} {}", tower.name, tower.center, tower.sigma,
                       tower.rotation.radians, tower.correlation, tower.amplitude);
}

inline std::string to_string(const Convection& air) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", air.cells,
                       air.mixed_layer.meters, air.inversion.meters, air.instability,
                       air.temperature, air.humidity, air.wind, air.wind_above, air.patches,
                       air.patch_width[0].meters, air.patch_width[1].meters, air.warmth, air.seed,
                       air.minutes, air.relief);
}

// Every member, so that equal texts mean equal clouds.
inline std::string to_string(const Cloud& cloud) {
    std::string text = fmt::format(
        "{} {} {} {} {} {} {} | {} {} {} | {} {} {} {} {} {} {} {}", cloud.name, cloud.noise,
        cloud.noise_scale, cloud.detail, cloud.detail_scale, cloud.erosion, cloud.wisp_height,
        cloud.extent[0].meters, cloud.extent[1].meters, cloud.extent[2].meters,
        cloud.base_altitude.meters, cloud.coverage, cloud.threshold, cloud.edge_softness,
        static_cast<int>(cloud.threshold_at), static_cast<int>(cloud.channels),
        cloud.extinction_scale.per_meter, cloud.full_at.value_or(0));
    text += "\n" + to_string(cloud.height_profile) + "\n" + to_string(cloud.coverage_map) + "\n" +
            to_string(cloud.type_map);
    if (cloud.shape == CloudShape::convection) text += "\n" + to_string(cloud.convection);
    for (const Tower& tower : cloud.towers) text += "\n" + to_string(tower);
    return text;
}

inline std::string to_string(const AssetFiles& files) {
    std::string text =
        fmt::format("{} {} {} {} {} {}", static_cast<int>(files.pixel_type),
                    static_cast<int>(files.layout), files.columns, files.mips,
                    static_cast<int>(files.compression), static_cast<int>(files.vdb_compression));
    for (const FileFormat format : files.formats)
        text += fmt::format(" {}", static_cast<int>(format));
    return text;
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
