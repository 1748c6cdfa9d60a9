// The asset occupancy: the cells of a volume that a runtime may skip, and its empty-space skip
// distances.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/marcher.h"
#include "config/assets/occupancy.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// The volume of which an occupancy grid is made.
struct OccupiedVolume {
    const Baked& volume;  // its level 0 need not have been surveyed
    float threshold = 0;  // a lookup above it is not empty
};

// Returns the index of the channel of a volume with this name; an empty name stands for the first.
std::size_t channel_named(const Baked& volume, const std::string& name);

// Returns the channel of a volume with this name, in memory as it is stored.
occupancy::ChannelSource channel_of(const OccupiedVolume& of, const std::string& name);

// The facts that state the fetches of a mean ray from below, without and with skipping.
inline constexpr const char* fetches_without = "fetches_without";
inline constexpr const char* fetches_with = "fetches_with";

// Skipping that leaves more than this share of the fetches is not worth a texture.
inline constexpr double most_fetches = 0.98;

// Adds these facts to an asset's details. Returns a warning (W0227) where skipping saves next to nothing.
std::optional<Diagnostic> add_skipping_gain(const occupancy::SkippingGain& gain, Baked& volume);

// Fills all of `volume` except its name and parameters. A voxel of it is a cell of `of`, and its
// channels are bake.contents. Returns E0401 and E0402 as for volumes, E0403 if the grid failed its
// own check, and neither value nor diagnostics after an interruption.
Outcome<Baked> bake_occupancy(const OccupiedVolume& of, const OccupancyBake& bake,
                              const BakeOptions& options, Baked volume);

}  // namespace skybake
