// What a [bake.NAME] of asset cloud_volume takes from its cloud, and what must hold of the two
// together.
#pragma once

#include <span>

#include "config/fields/section_decoder.h"
#include "config/parameters.h"

namespace skybake::config {

// Fills in `size` from the cloud's extent and `voxel_size`, `extent` where the two make no whole
// number of voxels (W0210), and the number of `mips`. Reports a cloud that is not there (E0132), a
// size that is not given (E0105) or out of range (E0110), what any volume's files must have
// (volume_files_decoder.h), octaves that are nothing at that size (W0208) or too fine for it
// (W0203), towers narrower than a voxel (W0204), and voxels that are not cubes (W0211).
void resolve_cloud_volume(DecodedSection& bake, std::span<const Cloud> clouds,
                          std::span<const Noise> noises, Decoder& decoder);

}  // namespace skybake::config
