// The asset flipbook: the frames of a sequence as layers of a texture, or as cells of a sheet.
//
// Layer k is frame k + 1 of the sequence, or a slice of it. A lookup between two layers blends two
// frames. The certificate says how far that is from the frames that a sequence of twice as many would
// have between them.
#pragma once

#include "bakers/math/bake_options.h"
#include "config/assets/flipbook.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Fills all of `volume` except its name and parameters. Returns what the baker of the frames reports,
// E0401 or E0402 for a texel that the pixel type cannot hold, and neither value nor diagnostics after an
// interruption.
config::Outcome<Baked> bake_flipbook(const config::Parameters& parameters,
                                     const config::FlipbookBake& bake, const BakeOptions& options,
                                     Baked volume);

}  // namespace skybake
