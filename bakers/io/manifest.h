// manifest.json: what a bake left in a folder, for machines. Its form is manifest_schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/core/baked_table.h"
#include "config/diagnostic.h"
#include "config/recipe.h"

namespace skybake {

inline constexpr std::string_view manifest_name = "manifest.json";

struct ManifestFile {
    std::string path;    // relative to the manifest's folder, never leaving it
    std::string format;  // "exr"
    config::PixelType pixel_type = config::PixelType::float32;
    std::uint64_t bytes = 0;
    std::string xxh3;  // xxh3_hex of the file
};

// Wall times: the one thing in a bake's output that changes from run to run.
struct Timing {
    double bake_s = 0;
    double write_s = 0;
    int threads = 1;
};

// One asset: all that its files say in their metadata, and what only a manifest may say.
struct ManifestAsset {
    std::string name;
    std::string kind;
    std::string content;
    std::vector<ManifestFile> files;
    std::array<int, 2> size{};
    std::vector<std::string> channels;
    config::Compression compression = config::Compression::zip;
    std::string mapping;
    std::array<AxisMapping, 2> axes;  // u, v
    Timing timing;
    std::optional<Certificate> error;  // none where it was not measured
    RangeCounts range;
    std::vector<Probe> probes;
    std::vector<std::pair<std::string, std::string>> details;
    std::string parameters;    // TOML: the parameters that this asset depends on
    std::string content_hash;  // xxh3_hex of the texels as stored
    std::string release;       // the release that baked it
};

struct Manifest {
    std::string tool_name;
    std::string tool_version;
    std::string parameters = "{}";  // JSON text of an object: the resolved parameters of the recipe
    std::vector<double> wavelengths_nm;  // one per channel
    std::vector<ManifestAsset> assets;
};

// An empty manifest of this release for a recipe.
Manifest new_manifest(const config::Recipe& recipe);

// The manifest's text, numbers in their shortest form that reads back equal, a newline at the end.
std::string manifest_json(const Manifest& manifest);

// Reads a manifest's text; `name` stands for it in diagnostics. E0304 with the field's place where
// it is damaged, of another tool or format, or names a file outside of its folder.
config::Outcome<Manifest> parse_manifest(std::string_view text, const std::string& name);

// Reads `folder`/manifest.json. E0300 where there is none, E0304 where it is damaged.
config::Outcome<Manifest> read_manifest(const std::filesystem::path& folder);

// `fresh` with those assets of `previous` that it does not name, in the order of `previous`; for
// bakes of a part of a recipe.
Manifest merge_manifests(const Manifest& previous, Manifest fresh);

// Whether the manifest lists the file (a path relative to its folder), or is that file itself.
bool claims(const Manifest& manifest, const std::filesystem::path& file);

// The JSON Schema that manifest_json's texts satisfy.
std::string_view manifest_schema();

// Resolved values as one JSON object, nested by path: {"atmosphere": {"ground_radius": "6360000
// m"}}.
std::string parameters_json(std::span<const config::ResolvedValue> values);

}  // namespace skybake
