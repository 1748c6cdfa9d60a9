// The variants of a sweep: their names, what came of each, and why one failed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sweep/sweep.h"

namespace skybake {

// Names of variants' folders: "0007_threshold=0.35_seed=2".

// What tells each path from the others: its last name, with as many of those before as that takes.
// "clouds.c.threshold" is "threshold", next to "clouds.d.threshold" it is "c.threshold".
std::vector<std::string> distinguishing_names(const std::vector<std::string>& paths);

// The names of the variants of one sweep. Unique by their numbers, of letters, digits and
// `+-.,=_` alone and at most 100 long, so that every file system, shell and URL takes them.
class VariantNames {
  public:
    explicit VariantNames(const config::Sweep& sweep);

    std::string name(int index) const;

  private:
    const config::Sweep& sweep_;
    std::vector<std::string> keys_;
    int digits_ = 4;
};

// error.json: why a variant could not be made, in its folder until it can.
inline constexpr std::string_view failure_name = "error.json";

// Its text: the errors among the diagnostics.
std::string failure_json(const std::vector<config::Diagnostic>& diagnostics);

// The errors of a folder's error.json; none if there is none, or it is damaged.
[[nodiscard]] std::vector<config::Diagnostic> read_failure(const std::filesystem::path& folder);

// Writes the errors into the variant's folder, which is made where it is missing. E0301, E0302.
[[nodiscard]] std::vector<config::Diagnostic> write_failure(
    const std::filesystem::path& folder, const std::vector<config::Diagnostic>& diagnostics);

// Takes it away, if it is there.
void remove_failure(const std::filesystem::path& folder);

// What became of a variant, as index files and manifests tell it: nothing that changes from run to
// run.

// One asset of a variant.
struct VariantAsset {
    std::string name;
    std::string kind;
    std::string key;  // see AssetIdentity
    std::vector<int> size;
    std::optional<ErrorFigures> lookup_error;  // none where it was not measured
    std::optional<ErrorFigures> texel_error;
    std::string content_hash;
    std::vector<std::string> files;  // relative to the variant's folder
};

VariantAsset variant_asset(const ManifestAsset& entry);

enum class VariantStatus {
    done,
    failed,   // its diagnostics say why
    missing,  // not made yet
};

std::string_view to_string(VariantStatus status);

struct VariantResult {
    int index = 0;
    std::string name;  // of its folder
    VariantStatus status = VariantStatus::missing;
    std::vector<VariantAsset> assets;             // of one that is done
    std::vector<config::Diagnostic> diagnostics;  // of one that failed; warnings of others
};

}  // namespace skybake
