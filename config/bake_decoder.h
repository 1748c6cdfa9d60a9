// One [bake.NAME]: which asset, and the asset's own fields.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "config/parameters.h"
#include "config/section_decoder.h"

namespace skybake::config {

// None if the asset is unknown, which is reported. `noises` are those of the recipe.
std::optional<Bake> decode_bake(const std::string& name, const Place& place, const Table& table,
                                std::span<const Noise> noises, Decoder& decoder);

}  // namespace skybake::config
