// Ready-made files into another folder.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/math/progress.h"
#include "bakers/workspace/asset_source.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Stages a copy of each of the asset's files, and says what became of it; the last is `interrupted`
// where progress.cancelled(). E0300, E0304 where a file cannot be read or does not hold the bytes
// that its entry says: then nothing of the asset is staged. E0301 where a copy cannot be written.
config::Outcome<std::vector<WriteResult>> stage_copies(const ReadyAsset& asset,
                                                       const std::filesystem::path& folder,
                                                       AtomicFiles& files,
                                                       const Progress& progress);

}  // namespace skybake
