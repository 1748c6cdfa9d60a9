// This header declares the asset "flipbook": the frames of a sequence in one file.
#pragma once

#include <array>
#include <string>

#include "config/sections/files.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// How DDS and KTX2 files hold the frames: as the slices of a 3-D texture, or the layers of an array of
// 2-D textures.
enum class FlipbookMapping { frames, layers };

struct FlipbookBake : AssetFiles {
    std::string sequence;  // NAME of a [bake.NAME] with `frames`
    int length = 0;        // frames in the file
    int slice = 0;         // of a volume, counted from 0
    FlipbookMapping mapping = FlipbookMapping::frames;
};

// Returns the first frame of the sequence. A recipe that was read has it.
const Bake& first_frame(const Parameters& parameters, const FlipbookBake& asset);

// Returns the voxels of a frame along x, y and z; a plane has one along z.
std::array<int, 3> frame_size(const Bake& frame);

}  // namespace skybake::config
