// Sources of ready-made assets, which need not be baked again, and a function that copies their
// files into another folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// An asset whose files are in a folder, under the names in its entry.
struct ReadyAsset {
    std::filesystem::path folder;
    ManifestAsset entry;
};

class AssetSource {
  public:
    virtual ~AssetSource() = default;
    // Returns the asset with this key, or nothing. Its files are checked again before they are
    // used, so they may be damaged or vanish at any time. The call may wait for another thread that
    // is making the asset.
    virtual std::optional<ReadyAsset> find(const std::string& key) = 0;
    // Stages the files of a result of `find`, as stage_copies does.
    virtual Outcome<std::vector<WriteResult>> stage(const ReadyAsset& asset,
                                                    const std::filesystem::path& folder,
                                                    AtomicFiles& files, const Progress& progress);
    // Says that the result of `find` cannot be read or does not match its entry.
    virtual void reject(const ReadyAsset& /*asset*/) {}
    // Offers an asset that has just been baked. Its files are complete and have their names.
    virtual void offer(const ReadyAsset& asset) = 0;
};

// Returns the asset with this key of a baked folder's manifest, unless that was changed since.
std::optional<ReadyAsset> asset_in_folder(const std::filesystem::path& folder,
                                          const std::string& key);

// The assets of folders that were baked into, which are looked through in this order.
class BakedFolders : public AssetSource {
  public:
    explicit BakedFolders(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)) {}

    std::optional<ReadyAsset> find(const std::string& key) override;
    void offer(const ReadyAsset& /*asset*/) override {}

  private:
    std::vector<std::filesystem::path> folders_;
};

// Stages each file of an asset, whose bytes `write` brings into the temporary, and returns the
// results. The last result is `interrupted` if progress.cancelled(). After an error of `write`,
// nothing of the asset is staged.
using AssetFileWriter =
    std::function<Outcome<bool>(const ManifestFile& file, const std::filesystem::path& temporary)>;
Outcome<std::vector<WriteResult>> stage_each(const ManifestAsset& entry,
                                             const std::filesystem::path& folder,
                                             AtomicFiles& files, const Progress& progress,
                                             const AssetFileWriter& write);

// Does so with a copy of each file. E0300 or E0304 if a file cannot be read or does not hold the
// bytes that its entry says. E0301 if a copy cannot be written.
Outcome<std::vector<WriteResult>> stage_copies(const ReadyAsset& asset,
                                               const std::filesystem::path& folder,
                                               AtomicFiles& files, const Progress& progress);

}  // namespace skybake
