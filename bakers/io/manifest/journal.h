// The journal of a bake, which tells the next one what a killed bake has finished.
//
// manifest.json gets its name last, so whoever sees it sees the files that it lists. Before the first
// of these files gets its name, their entries are in a temporary of manifest.json, the journal: it is the
// manifest itself, or, while frames of a sequence appear one by one, a text of manifests, each of the
// frame that is about to appear. A bake that is killed
// leaves it. The next one believes it of files that hold the bytes that it says, and of no others.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bakers/io/files/temporary_file.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

class BakeJournal {
  public:
    explicit BakeJournal(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Adds entries, which are on the disk when it returns. E0301.
    [[nodiscard]] std::vector<Diagnostic> add(std::span<const ManifestAsset> entries);
    // Removes this journal, as if the bake had not begun.
    void discard();
    // Removes it and those of killed bakes, because manifest.json says it all.
    void end();

  private:
    std::filesystem::path folder_;
    std::optional<TemporaryFile> file_;  // made with the first entries
};

// Adds to `previous`, the manifest of a folder, what journals there say: the entries of assets whose
// files are complete, and other files that are as written as retired ones. Makes a manifest if there is
// none and a journal says anything. Returns whether they say more than `previous`.
bool add_journals(const std::filesystem::path& folder, std::optional<Manifest>& previous);

// Whether a retired file is the one that skybake wrote: a plain file in the folder with the bytes
// that its manifest says. Only such files are pruned.
bool is_as_written(const std::filesystem::path& folder, const RetiredFile& file);

}  // namespace skybake
