// The asset occupancy: which cells of a volume a runtime may skip, and how far.
#pragma once

#include <cstddef>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/assets/occupancy.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// What an occupancy grid is of.
struct OccupiedVolume {
    const Baked& volume;  // its level 0 need not have been surveyed
    float threshold = 0;  // a lookup above it is something
};

// Which channel of a volume has this name; the first for an empty one.
std::size_t channel_named(const Baked& volume, const std::string& name);

// Fills everything of `volume` but its name and parameters: a voxel of it is a cell of `of`, its
// channels are bake.contents. E0401, E0402 as of volumes; E0403: the grid failed its own check. No
// value and no diagnostics after an interruption.
config::Outcome<Baked> bake_occupancy(const OccupiedVolume& of, const config::OccupancyBake& bake,
                                      const BakeOptions& options, Baked volume);

}  // namespace skybake
