// Brings a folder up to date as bake_folder does, one frame of a sequence after the other: each
// frame has its name as soon as it is complete. So a sequence that is interrupted goes on where it
// stopped, and a program may show the frames that are there.
#pragma once

#include "bakers/workspace/bake_folder.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Whether any asset is, or is made from, a frame of a sequence.
bool has_frames(const FolderBake& bake);

// Bakes the frames in order and then all other assets together. Returns what bake_folder would
// return, and its errors. After an interruption or an error the frames that were complete stay, and
// the manifest lists them. The observer is told the plan of the whole once.
config::Outcome<BakedFolder> bake_frames_and_folder(const FolderBake& bake, BakeObserver& observer);

}  // namespace skybake
