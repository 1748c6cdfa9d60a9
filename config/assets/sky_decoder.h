// What a [bake.NAME] of the sky takes from the scene and the atmosphere, and what must hold of them
// together.
#pragma once

#include <optional>

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// Names in the list `key` that are none of the atmosphere's layers (E0138). Sections without such a
// key pass.
void check_layer_names(const DecodedSection& bake, std::string_view key, const Table& root,
                       const Atmosphere& atmosphere, Decoder& decoder);

// Fills in the distance of view and the number of `mips`; reports channels that make no picture
// (E0129) and what any volume's files must have (volume_files_decoder.h).
void resolve_aerial_perspective(DecodedSection& bake, const std::optional<Scene>& scene,
                                Decoder& decoder);

}  // namespace skybake::config
