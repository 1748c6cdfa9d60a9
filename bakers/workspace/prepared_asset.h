// From a baked asset to files that wait for their names.
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "bakers/assets/registry.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/formats/write_table.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A volume whose files are made while they are written.
struct DescribedVolume {
    BakedVolume volume;
    ManifestAsset asset;
};

// An asset whose bake has succeeded; nothing of it has touched the disk.
using PreparedAsset = std::variant<EncodedTable, DescribedVolume>;

// Its entry in the manifest: complete once it is staged.
const ManifestAsset& entry_of(const PreparedAsset& asset);
ManifestAsset& entry_of(PreparedAsset& asset);

// Encodes a table, describes a volume. E0401, E0402 as encode_table.
config::Outcome<PreparedAsset> prepare(BakedAsset baked, int threads);

// Stages all files of the asset, and says what became of each in the order of entry_of().files; the
// last is `interrupted` where progress.cancelled(). E0301.
config::Outcome<std::vector<WriteResult>> stage(PreparedAsset& asset,
                                                const std::filesystem::path& folder,
                                                AtomicFiles& files, int threads,
                                                Progress& progress);

}  // namespace skybake
