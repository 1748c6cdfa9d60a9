// How much a cloud that moves changes from a frame to the next, measured at voxels of boxes that are spread evenly.
#pragma once

#include <optional>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Both are of the voxels that hold cloud in one of the frames, of their first channel.
struct FrameChange {
    double flips = 0;  // the share of them that holds cloud in one frame only
    double rms = 0;    // of the difference of their values
};

// The most flips per frame that do not look like flicker. Clouds of a film change by a few hundredths.
inline constexpr double kMostFlips = 0.1;

// Returns nothing after an interruption. `inputs` are those of the frame, whose coverage the next one keeps.
std::optional<FrameChange> change_to_next_frame(const Parameters& parameters,
                                                const CloudVolumeBake& bake,
                                                const CloudInputs& inputs,
                                                const BakeOptions& options);

}  // namespace skybake
