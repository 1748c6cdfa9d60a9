// This header fills in the keys of a bake that its target decides.
#pragma once

#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// Gives the keys of files that the section leaves out the values that its target loads. The target
// is that of the section or, if it names none, that of the recipe. Reports an asset or light that the
// target does not load, and given values that it does not load (E0160).
void resolve_target(DecodedSection& bake, std::string_view asset, const Parameters& recipe,
                    Decoder& decoder);

}  // namespace skybake::config
