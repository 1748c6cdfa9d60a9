// This header divides a [bake.NAME] that asks for more than one asset into its parts: the packets of
// wavelengths that a texture has too few channels for, or the frames of a sequence.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/assets/asset_kind.h"

namespace skybake::config {

// This is a bake whose keys have been read, but which has not yet taken values from other bakes.
struct OpenBake {
    std::string name;
    const AssetKind* kind = nullptr;
    DecodedSection section;
};

// Replaces bakes by their parts where they have any. Packets are called NAME_1, NAME_2 ... and frames
// NAME_0001, NAME_0002 ... An asset that is made from a sequence is divided like it, unless it takes
// all frames. Reports packets that the recipe does not have (E0147) and sections that have the name
// of a part (E0147, E0174). `entries` are all sections.
std::vector<OpenBake> divided_into_parts(std::vector<OpenBake> open, const Parameters& recipe,
                                         std::span<const Entry* const> entries, Decoder& decoder);

}  // namespace skybake::config
