// Shared by the tests of columns: the Earth with its presets of layers, and random atmospheres.
#pragma once

#include <rapidcheck.h>

#include <string>
#include <vector>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "config/assets/optical_depth.h"
#include "config/sections/file_formats.h"
#include "config/sections/layer.h"
#include "tests/light/sky_media.h"

namespace skybake::test {

inline const std::vector<std::string>& earth_kinds() {
    static const std::vector<std::string> names = {"rayleigh", "dust", "fog", "rain"};
    return names;
}

inline config::Atmosphere earth_with_presets() {
    return recipe_of(
               "preset = 'earth_hillaire'\n"
               "[atmosphere.layers.dust]\npreset = 'dust'\n"
               "[atmosphere.layers.fog]\npreset = 'fog'\n"
               "[atmosphere.layers.rain]\npreset = 'rain'\n"
               "[atmosphere.layers.snow]\npreset = 'snow'\n")
        .parameters.atmosphere;
}

inline config::OpticalDepthBake bake_of(config::OpticalDepthTable table, std::array<int, 3> size,
                                        std::vector<std::string> kinds = earth_kinds()) {
    config::OpticalDepthBake bake;
    bake.table = table;
    bake.size = size;
    bake.kinds = std::move(kinds);
    bake.pixel_type = config::PixelType::float32;
    bake.formats = {config::FileFormat::bin};
    bake.compression = config::Compression::none;
    bake.shells = 32;
    bake.max_altitude = {35e3};
    return bake;
}

inline ColumnErrors errors_of(const config::Atmosphere& atmosphere,
                              const config::OpticalDepthBake& bake, int points) {
    const auto kinds = make_column_kinds(atmosphere, bake.kinds);
    const ColumnTable table(bake, column_geometry(kinds));
    Level level;
    level.size = bake.size;
    level.repeats = {false, false, false};
    level.voxels = column_voxels(atmosphere, bake).voxels;
    level.statistics.resize(kinds.size());
    return measure_columns(kinds, 3, table, bake.table == config::OpticalDepthTable::to_top, level,
                           bake.pixel_type, points);
}

// One to four layers: exponential, slab or tent.
inline config::Atmosphere random_shells() {
    return random_planet(4, [](double thickness, config::Layer& layer) {
        layer.profile = static_cast<config::Profile>(*rc::gen::inRange(0, 3));
        layer.scale_height = {thickness * log_uniform(1e-3, 1)};
        layer.half_width = {thickness * uniform(0.01, 0.4)};
        layer.bottom_altitude = {thickness * uniform(0, 0.5)};
        layer.top_altitude = {layer.bottom_altitude.meters + thickness * uniform(0.01, 0.5)};
        layer.scattering.assign(3, {1 / thickness});
        layer.extinction.assign(3, {1 / thickness});
    });
}

inline std::vector<std::string> names_of(const config::Atmosphere& atmosphere) {
    std::vector<std::string> names;
    for (const config::Layer& layer : atmosphere.layers) names.push_back(layer.name);
    return names;
}

// The three tables of paths.
inline std::vector<config::OpticalDepthBake> path_bakes(std::array<int, 3> top,
                                                        std::array<int, 3> between,
                                                        const std::vector<std::string>& kinds) {
    std::vector<config::OpticalDepthBake> bakes = {
        bake_of(config::OpticalDepthTable::to_top, top, kinds),
        bake_of(config::OpticalDepthTable::between, between, kinds),
        bake_of(config::OpticalDepthTable::between, between, kinds)};
    bakes[2].coordinates = config::BetweenCoordinates::distance;
    return bakes;
}

}  // namespace skybake::test
