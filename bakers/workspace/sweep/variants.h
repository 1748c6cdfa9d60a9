// The variants of a sweep: their names, their results, and why one failed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sweep/sweep.h"

namespace skybake {

// Returns a name that distinguishes each path from the others: its last name, with as many of the
// names before it as necessary. "clouds.c.threshold" becomes "threshold"; beside
// "clouds.d.threshold" it becomes "c.threshold".
std::vector<std::string> distinguishing_names(const std::vector<std::string>& paths);

// The names of the variants of one sweep, and of their folders: "0007_threshold=0.35_seed=2". Their
// numbers make them unique. They consist of letters, digits and `+-.,=_` and have at most 100
// characters, so that every file system, shell and URL accepts them.
class VariantNames {
  public:
    explicit VariantNames(const config::Sweep& sweep);

    std::string name(int index) const;

  private:
    const config::Sweep& sweep_;
    std::vector<std::string> keys_;
    int digits_ = 4;
};

// error.json says why a variant could not be made. It stays in the variant's folder until the
// variant is made.
inline constexpr std::string_view failure_name = "error.json";

// Returns the text of error.json: the errors among the diagnostics.
std::string failure_json(const std::vector<Diagnostic>& diagnostics);

// Returns the errors in a folder's error.json, or none if it is missing or damaged.
[[nodiscard]] std::vector<Diagnostic> read_failure(const std::filesystem::path& folder);

// Writes the errors into the variant's folder and makes the folder if it is missing. E0301, E0302.
[[nodiscard]] std::vector<Diagnostic> write_failure(const std::filesystem::path& folder,
                                                    const std::vector<Diagnostic>& diagnostics);

// Removes error.json if it exists.
void remove_failure(const std::filesystem::path& folder);

// One asset of a variant. Nothing but `timing` changes from run to run, and only timing.csv has that.
struct VariantAsset {
    std::string name;
    std::string kind;
    std::string key;  // see AssetIdentity
    std::vector<int> size;
    std::optional<SkyError> sky_error;  // none if it was not measured, or is too noisy to tell
    std::optional<ErrorFigures> lookup_error;  // none if it was not measured
    std::optional<ErrorFigures> texel_error;
    std::uint64_t bytes = 0;      // of all its files
    std::optional<double> cover;  // the share of a cloud volume's columns that hold cloud
    std::string content_hash;
    std::vector<std::string> files;  // relative to the variant's folder
    Timing timing;
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
    std::string name;  // name of its folder
    VariantStatus status = VariantStatus::missing;
    std::vector<VariantAsset> assets;     // if it is done
    std::vector<Diagnostic> diagnostics;  // errors if it failed, else warnings
};

// Returns why a variant failed: "E0402: ...", or nothing if it did not.
std::string first_error(const VariantResult& variant);

}  // namespace skybake
