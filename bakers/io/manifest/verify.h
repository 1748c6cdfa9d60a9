// Verifies that the files of a bake are what its manifest says.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct VerifyFailure {
    std::string file;     // relative to the folder
    std::string check;    // "file", "bytes", "xxh3", "size", "metadata", "finite", "probe", ...
    std::string message;  // what was found and what was wanted
};

struct VerifyReport {
    int files = 0;
    int checks = 0;  // passed or failed
    std::vector<VerifyFailure> failures;
};

// A further check of an asset, for facts that only its baker knows (from physical coordinates to
// uv). Its failures are reported for the asset's first file.
struct AssetCheck {
    std::string name;
    // Returns one message per failure and increases `checks` by the number of checks made.
    std::function<std::vector<std::string>(const ManifestAsset& asset, int& checks)> run;
};

// A further check of a whole folder, for facts that concern several assets. Returns the failures and
// increases `checks` by the number of checks made.
using FolderCheck = std::function<std::vector<VerifyFailure>(
    const Manifest& manifest, const std::filesystem::path& folder, int& checks)>;

// Reads every file that a manifest lists and makes every check that is possible without baking:
// presence, byte count, hash of the file, size, channels, pixel type, each attribute against the
// manifest, hash of the texels, finiteness, each probe (within its tolerance), and whether each
// wrong lookup that the probes are said to catch shows at several of them. For volumes it also
// checks the layout and the extremes of the values. Everything that cannot be measured is covered
// by the manifest's hashes, so no change of the manifest goes unnoticed.
//
// `path` is the manifest or its folder. Volumes are read as streams. `further` checks are made for
// each asset, `of_folder` checks for all assets together. `progress` hears of the share of all bytes
// after each file; once it is cancelled, the rest is left out, and the report must not be used.
// E0300 if there is no manifest, E0304 if it is damaged.
Outcome<VerifyReport> verify_bake(const std::filesystem::path& path,
                                  std::span<const AssetCheck> further = {},
                                  std::span<const FolderCheck> of_folder = {},
                                  Progress* progress = nullptr);

}  // namespace skybake
