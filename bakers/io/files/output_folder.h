// The folder that a bake writes into: may it, and what is there already?
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct OutputFolder {
    std::filesystem::path path;
    std::optional<Manifest> previous;  // the manifest of an earlier bake

    // Why nothing is known of what the folder holds but which files are skybake's: a clause that
    // says what is wrong with its manifest. Empty: all is known.
    std::string reason = {};
};

// Looks, and changes nothing: call it before a long bake. `files` are the names that will be
// written, relative to the folder, manifest.json among them. E0302: the folder cannot be written
// to, or cannot be made. E0303: a file is there that no manifest of skybake's claims; one
// diagnostic for each; `force` lets them pass. Where nothing is `to_be_written` after all, a
// folder may be one for reading alone.
config::Outcome<OutputFolder> inspect_output_folder(const std::filesystem::path& folder,
                                                    std::span<const std::string> files, bool force,
                                                    bool to_be_written = true);

// Makes the folder where it is missing, and those above it; the folders made, the deepest first.
// E0302.
config::Outcome<std::vector<std::filesystem::path>> create_output_folder(
    const std::filesystem::path& folder);

// Takes back what create_output_folder made, as far as nothing is in there.
void remove_empty_folders(std::span<const std::filesystem::path> folders);

}  // namespace skybake
