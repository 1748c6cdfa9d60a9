// The probes of a level of a volume.
#pragma once

#include <optional>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/field/choose_probes.h"

namespace skybake {

// Fills probes and catches of a level that has been surveyed. `place` tells the physical place of
// texture coordinates; empty: texture coordinates are all that is known. Places are looked for all
// over the volume, at its seams, at the level's peaks and on the slopes about them. E0407, which
// names `asset`.
std::optional<config::Diagnostic> add_volume_probes(const std::string& asset,
                                                    const ProbePlaces& place,
                                                    config::PixelType type,
                                                    const BakeOptions& options, Level& level);

}  // namespace skybake
