// From a baked table to its file and its entry in the manifest.
#pragma once

#include <filesystem>
#include <string>

#include "bakers/field/baked_table.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A table as the bytes of its file, ready to be written; nothing has touched the disk.
struct EncodedTable {
    std::string bytes;
    ManifestAsset asset;  // complete but for timing.bake_s and timing.threads
};

// E0401, E0402 as encode_exr. asset.timing.write_s holds the time of the encoding.
config::Outcome<EncodedTable> encode_table(const BakedTable& table);

// Stages NAME.exr for the folder; adds the time it took to asset.timing.write_s. E0301.
config::Outcome<WriteResult> stage_table(EncodedTable& table, const std::filesystem::path& folder,
                                         AtomicFiles& files, const Progress* progress = nullptr);

}  // namespace skybake
