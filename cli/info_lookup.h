// skybake info --lookup: functions of a shader that read a baked file.
#pragma once

#include <filesystem>
#include <optional>

#include "bakers/io/manifest/manifest.h"
#include "bakers/shading/shading_language.h"
#include "cli/console.h"

namespace skybake::cli {

// An asset, and which of its files.
struct DescribedFile {
    ManifestAsset asset;
    ManifestFile file;
};

// Returns what the manifest.json beside the file says of it, or nothing if there is no such manifest
// or it does not list the file.
std::optional<DescribedFile> described_by_manifest(const std::filesystem::path& path);

// Prints the lookup of the file's asset in that language with the numbers of its bake filled in,
// below a comment that says what a runtime must know of the file. A file that carries no metadata is
// described by the manifest.json beside it. For a folder or its manifest it prints the library of all its
// assets: each function once, numbers of the recipe, and how pictures show light. E0300, and E0304 of a
// file that skybake did not write.
ExitCode show_lookup(const std::filesystem::path& path, ShadingLanguage language, Console& console);

}  // namespace skybake::cli
