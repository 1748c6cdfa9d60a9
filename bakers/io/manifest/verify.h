// Proves that the files of a bake are what its manifest says.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/manifest/manifest.h"
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

// A further check of an asset, for what only its baker knows (physical coordinates to uv). Its
// failures are laid to the asset's first file.
struct AssetCheck {
    std::string name;
    // One message per failure; `checks` is increased by the number of things looked at.
    std::function<std::vector<std::string>(const ManifestAsset& asset, int& checks)> run;
};

// A further check of a whole folder, for what several assets say together.
struct FolderCheck {
    // Its failures; `checks` is increased by the number of things looked at.
    std::function<std::vector<VerifyFailure>(const Manifest& manifest,
                                             const std::filesystem::path& folder, int& checks)>
        run;
};

// Re-reads every file that a manifest lists and makes every check that can still be made: presence,
// byte count, hash of the file, size, channels, pixel type, each attribute against the manifest,
// hash of the texels, finiteness, each probe (within its tolerance), and that each fault which the
// probes are said to catch shows at several of them; of volumes the layout and the extremes of
// their values too. What it cannot measure is under the manifest's hashes, so that no change of the
// manifest passes. `path` is the manifest or its folder. Volumes are read as streams. `further`
// checks are made of each asset, `of_folder` of all together. E0300 where there is no
// manifest, E0304 where it is damaged.
config::Outcome<VerifyReport> verify_bake(const std::filesystem::path& path,
                                          std::span<const AssetCheck> further = {},
                                          std::span<const FolderCheck> of_folder = {});

}  // namespace skybake
