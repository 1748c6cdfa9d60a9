// What every volume goes through once its voxels can be made: levels of detail, statistics, range,
// hash, probes, certificate.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/field/choose_probes.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

// Adds levels that are box means of volume.levels[0], until there are `count`.
void add_mip_levels(int count, const BakeOptions& options, Baked& volume);

struct VolumeFinish {
    std::vector<std::array<double, 2>> histogram_ranges;  // one per channel
    VolumeReference reference;                            // none: no certificate
    std::string reference_name;
    bool expensive = false;  // the reference: then --certify=quick takes fewer points
    VolumeComparison comparison = {};
    // In place of the reference: for volumes that a runtime looks up in another way than between
    // the eight nearest voxels.
    std::function<Certificate(const Baked& volume, const BakeOptions& options)> measure = {};
    // The physical place of texture coordinates of a level, which are moved to the nearest that a
    // runtime asks for.
    std::function<ProbePlace(const std::array<double, 3>& uvw, int level)> probe_place = {};
};

// Surveys all levels, makes their probes, and measures level 0 against the reference unless
// options.certification is off. E0401, E0402: a voxel that the pixel type cannot hold; E0407: no
// probes tell a wrong file. No value and no diagnostics after an interruption.
config::Outcome<Baked> finish_volume(Baked volume, const VolumeFinish& finish,
                                     const BakeOptions& options);

// The probes of a level of a volume.

// Fills probes and catches of a level that has been surveyed. `place` tells the physical place of
// texture coordinates; empty: texture coordinates are all that is known. Places are looked for all
// over the volume, at its seams, at the level's peaks and on the slopes about them. E0407, which
// names `asset`.
[[nodiscard]] std::optional<config::Diagnostic> add_volume_probes(const std::string& asset,
                                                                  const ProbePlaces& place,
                                                                  config::PixelType type,
                                                                  const BakeOptions& options,
                                                                  Level& level);

}  // namespace skybake
