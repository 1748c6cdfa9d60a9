// Brings a folder up to date with a recipe: makes what is stale, leaves the rest alone.
//
// One process at a time works in a folder; others wait for it, and then find its work done. All
// assets are made, and all files on the disk, before the first gets its name, and the manifest gets
// its name first: whenever a process is killed, the folder holds whole files, old and new, and the
// next bake sees by their hashes which are not the manifest's.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/math/bake_options.h"
#include "bakers/workspace/folder_plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Whoever watches a bake. Calls come from the thread that called bake_folder.
class BakeObserver {
  public:
    virtual ~BakeObserver() = default;
    // True once the user has interrupted.
    virtual bool cancelled() const = 0;
    // Another process is at work in the folder; called once.
    virtual void waits() = 0;
    virtual void planned(const FolderPlan& plan) = 0;
    // A step of an asset (or of "manifest") begins; it ends with the object. Never null.
    virtual std::unique_ptr<Progress> begin(std::string_view asset) = 0;
};

enum class AssetState {
    up_to_date,  // its files were left alone
    copied,      // from one of the sources
    baked,
};

struct FinishedAsset {
    AssetState state = AssetState::baked;
    ManifestAsset entry;
    std::vector<WriteResult> files;  // in the order of entry.files
    // Wall time that choosing a size, certifying and probing took besides entry.timing.bake_s; 0
    // where this run has not baked the asset.
    double certify_s = 0;
};

struct BakedFolder {
    std::vector<FinishedAsset> assets;  // in the order of FolderBake::bakes
    WriteResult manifest = WriteResult::unchanged;
    std::vector<RetiredFile> retired;  // of earlier recipes, and kept
    std::vector<RetiredFile> pruned;   // of earlier recipes, and removed
};

// Diagnostics of plan_folder, of bakers (E0401 to E0405, E0407) and of writing (E0301), after which
// the folder is as it was, but where a rename failed: then files that have their names keep them.
// E0301: a file could not be removed, all others are as they should be. W0303: an entry that a bake
// of a part leaves is of other values. Warnings may accompany a value. No value and no errors after
// an interruption.
config::Outcome<BakedFolder> bake_folder(const FolderBake& bake, BakeObserver& observer);

}  // namespace skybake
