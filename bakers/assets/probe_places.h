// How a runtime finds what a probe names: from physical coordinates to those of a texture.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/baked_table.h"
#include "bakers/field/make_probe.h"
#include "bakers/field/wrong_lookups.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// What a file says of its texels.
struct StoredTexels {
    std::string mapping;
    std::vector<int> size;
};

// Of a table. The names of its coordinates are in its mapping.
struct TablePlaces {
    std::size_t coordinates = 2;  // of a probe
    std::function<std::array<double, 2>(const Probe& probe)> uv;
};

// Of a volume: the names of the coordinates, and what a runtime makes of the values, in this order.
struct VolumePlaces {
    std::vector<std::string> names;
    std::function<std::vector<ProbeLookup>(const Place& at, int level)> lookups;
};

using AssetPlaces = std::variant<TablePlaces, VolumePlaces>;

using VolumeUvw = std::array<double, 3>;

// A volume that is looked up once, in all levels alike.
inline VolumePlaces single_lookup(std::vector<std::string> names,
                                  std::function<VolumeUvw(const Place& at)> uvw) {
    return {std::move(names), [uvw = std::move(uvw)](const Place& at, int) {
                return std::vector<ProbeLookup>{{uvw(at)}};
            }};
}

inline Shell shell_of(const config::Atmosphere& atmosphere) {
    return {atmosphere.ground_radius.kilometers(),
            (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000};
}

}  // namespace skybake
