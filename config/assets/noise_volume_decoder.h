// What a [bake.NAME] of asset noise_volume takes from its noise, and what must hold of the two
// together.
#pragma once

#include <span>

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// Fills in `size` from the noise and the number of `mips`. Reports a noise that is not there
// (E0130), pixel types that a format has not (E0131), more voxels than can be (E0126), columns and
// levels beyond what the size has (E0110), and octaves that are nothing at that size (W0208) or too
// fine for it (W0203).
void resolve_noise_volume(DecodedSection& bake, std::span<const Noise> noises, Decoder& decoder);

}  // namespace skybake::config
