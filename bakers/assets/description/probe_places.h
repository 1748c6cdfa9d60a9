// How a runtime finds what a probe names: from physical coordinates to those of a texture.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/field/wrong_lookups.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// The facts of a file about its texels.
struct StoredTexels {
    std::string mapping;
    std::vector<int> size;
    std::size_t channels = 0;
};

using Uvw = std::array<double, 3>;  // texture coordinates; w of a table is 1/2

// The names of a probe's coordinates, and what a runtime makes of their values.
struct AssetPlaces {
    std::vector<std::string> names;
    std::function<std::vector<ProbeLookup>(const Probe& probe, int level)> lookups;
};

// For an asset that is read with one lookup, the same at every level.
inline AssetPlaces single_lookup(std::vector<std::string> names,
                                 std::function<Uvw(const Place& at)> uvw) {
    return {std::move(names), [uvw = std::move(uvw)](const Probe& probe, int) {
                return std::vector<ProbeLookup>{{uvw(probe.at)}};
            }};
}

// Returns the probe's place at texture coordinates of linear axes.
inline ProbePlace place_on(const std::vector<AxisMapping>& axes, const std::array<double, 3>& uvw) {
    ProbePlace place{{}, {{uvw}}};
    for (std::size_t i = 0; i < 3; ++i) {
        place.at.emplace_back(axes[i].quantity,
                              axes[i].first + uvw[i] * (axes[i].last - axes[i].first));
    }
    return place;
}

inline Shell shell_of(const config::Atmosphere& atmosphere) {
    return {atmosphere.ground_radius.kilometers(),
            (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000};
}

}  // namespace skybake
