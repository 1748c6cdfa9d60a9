// This header reads [preview]. Its values stand among those of the recipe, so that `show` and
// manifests have them, but no asset reads them.
#pragma once

#include <optional>
#include <span>

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"
#include "config/sections/preview.h"

namespace skybake::config {

// Decodes [preview] and [preview.camera] and appends their values. Returns none if the recipe has no such
// values. It reports a camera below the ground (E0110), and a time or half of a place without the rest
// of the place (E0105).
std::optional<Preview> decode_preview(const Table& root, Decoder& decoder);

// Returns the pictures of light that previews of these bakes have.
PicturesOfLight pictures_of_light(std::span<const Bake> bakes);

}  // namespace skybake::config
