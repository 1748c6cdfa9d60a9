// This header says how volumes are baked as frames of a loop: each frame is an asset of its own, so
// that frames can be baked apart, and the recipe has an asset for each.
#pragma once

#include <initializer_list>

#include "config/fields/section_decoder.h"
#include "config/sections/files.h"
#include "config/sections/noise.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// These are the keys of an asset that may be one of many frames.
struct VolumeFrames : AssetFiles {
    int frames = 0;  // 0: the asset is no sequence
    int frame = 0;   // counted from 1; 0: the time that the noises have themselves
};

// Returns a recipe's parameters at a frame: the first frame is the time that a noise has, and each
// frame after it a frame later. Frame 0 changes nothing.
Parameters at_frame(const Parameters& parameters, int frame);

// Reports frames of a volume none of whose noises moves (E0174), and warns of frames that are not
// whole loops of a noise (W0219). Null pointers are no noises.
void check_frames(const DecodedSection& bake, std::initializer_list<const Noise*> noises,
                  Decoder& decoder);

}  // namespace skybake::config
