// Brings a folder up to date with a recipe: makes stale assets and leaves the others alone.
//
// Only one process at a time works in a folder. Others wait and then find its work done. All assets
// are made and all files are on the disk before the first file gets its name, and the manifest gets
// its name last. So whenever a process is killed, the folder holds only whole files, old or new,
// and the next bake sees by the hashes which of them do not match the manifest, and by a journal
// (bakers/io/manifest/journal.h) which of them are new.
//
// With frame_by_frame each frame of a sequence has its name as soon as it is complete. So a sequence
// that is interrupted goes on where it stopped, and a program may show the frames that are there.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/math/bake_options.h"
#include "bakers/workspace/folder_plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Observes a bake. All calls come from the thread that called bake_folder.
class BakeObserver {
  public:
    virtual ~BakeObserver() = default;
    // Returns true once the user has interrupted.
    virtual bool cancelled() const = 0;
    // Says that another process works in the folder. It is called once.
    virtual void waits() = 0;
    virtual void planned(const FolderPlan& plan) = 0;
    // Says that a step of an asset (or of "manifest") begins. The step ends when the returned
    // object is destroyed. It is never null.
    virtual std::unique_ptr<Progress> begin(std::string_view asset) = 0;
};

enum class AssetState {
    up_to_date,  // its files did not change
    copied,      // from one of the sources
    baked,
};

struct FinishedAsset {
    AssetState state = AssetState::baked;
    ManifestAsset entry;
    std::vector<WriteResult> files;  // in the order of entry.files
};

struct BakedFolder {
    std::vector<FinishedAsset>
        assets;  // in the order of FolderBake::bakes, without those that failed
    WriteResult manifest = WriteResult::unchanged;
    std::vector<RetiredFile> retired;  // from earlier recipes, and kept
    std::vector<RetiredFile> pruned;   // from earlier recipes, and removed
};

// Bakes into the folder. An asset that its baker refuses (E0401 to E0405, E0407), or whose picture
// changes meanwhile (E0300), is left out, and what the folder held of it before stays. Its errors
// accompany the value; there is no value if no asset could be made. After errors of plan_folder or of
// writing (E0301) the folder is unchanged, except that after a failed rename the files already renamed
// keep their names, and that complete frames stay and are in the manifest. E0301 can also mean that a
// file could not be removed; then everything else is as it should be. W0303: after a bake of a part,
// an entry that was not baked has other values than the recipe. Warnings may accompany a value. After
// an interruption there is neither a value nor an error.
Outcome<BakedFolder> bake_folder(const FolderBake& bake, BakeObserver& observer);

// Loads the modules that an asset's files need. Returns E0301 if one is missing or cannot be loaded.
std::optional<Diagnostic> missing_module(const Bake& bake, const std::filesystem::path& folder);

// Whether anything is baked frame by frame.
bool has_frames(const FolderBake& bake);

}  // namespace skybake
