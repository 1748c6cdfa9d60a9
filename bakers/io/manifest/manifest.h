// manifest.json: what a bake left in a folder, for machines. Its form is manifest_schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/formats/format.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

inline constexpr std::string_view manifest_name = "manifest.json";

struct ManifestFile {
    std::string path;    // relative to the manifest's folder, never leaving it
    std::string format;  // "exr", "vdb", "bin", "png", "dds"; "json" of a companion
    config::PixelType pixel_type = config::PixelType::float32;
    std::uint64_t bytes = 0;
    std::string xxh3;                      // xxh3_hex of the file
    int level = 0;                         // of detail; 0 is the asset itself
    int levels = 1;                        // how many the file holds, from `level` on
    std::string compression = {};          // "none", "zip", "blosc", ...
    std::optional<SheetGrid> layout = {};  // images: where the slices lie
    std::vector<std::string> grids = {};   // vdb: the grid of each channel
};

// A file besides the recipe that an asset is made from.
struct ManifestInput {
    std::string file;  // as the recipe names it
    std::string xxh3;  // xxh3_hex of its bytes
};

// Wall times: the one thing in a bake's output that changes from run to run.
struct Timing {
    double bake_s = 0;
    double write_s = 0;
    int threads = 1;
};

// One level of detail. A table has one slice.
struct ManifestLevel {
    std::array<int, 3> size{};
    std::string content_hash;                 // xxh3_hex of the voxels as stored
    std::vector<ValueStatistics> statistics;  // one per channel
    std::vector<Probe> probes;
    std::vector<std::string> catches = {};  // wrong lookups that the probes tell
};

// One asset: all that its files say in their metadata, and what only a manifest may say.
struct ManifestAsset {
    std::string name;
    std::string kind;
    std::string content;
    std::vector<ManifestFile> files;
    std::vector<int> size;  // texels along u, v; voxels along u, v, w; of level 0
    std::vector<std::string> channels;
    std::string mapping;
    std::vector<AxisMapping> axes;  // u, v; u, v, w
    Timing timing;
    std::optional<Certificate> error;  // none where it was not measured
    RangeCounts range;
    std::vector<ManifestLevel> levels;  // level 0 first
    Conventions conventions;
    Facts details;
    std::string parameters;    // TOML: the parameters that this asset depends on
    std::string content_hash;  // of level 0
    std::string release;       // the release that baked it

    // What it was made of (bakers/workspace/folder_plan.h). Empty in manifests of releases
    // that did not bake incrementally.
    std::string key;
    std::string certification;  // "quick", "full", "off"
    std::vector<ManifestInput> inputs;

    double seam_error = 0;  // of volumes: between voxel 0 and voxel `size`, over all axes

    bool is_volume() const { return axes.size() == 3; }
};

// Texels of the level that a file holds, or of its first: along u, v; along u, v, w of a volume.
std::vector<int> size_of(const ManifestAsset& asset, const ManifestFile& file);

// A file that an earlier bake left in the folder and the recipe no longer asks for: skybake wrote
// it, so a later bake may write it again.
struct RetiredFile {
    std::string path;
    std::string xxh3;
};

struct Manifest {
    std::string tool_name;
    std::string tool_version;
    std::string parameters = "{}";  // JSON text of an object: the resolved parameters of the recipe
    std::vector<ManifestAsset> assets;
    std::vector<RetiredFile> retired;

    // What a reader found that is not as it was written, one sentence for each place: nobody but
    // `verify` tells it, and nothing of such a manifest is taken for a bake.
    std::vector<std::string> alterations;
};

// An empty manifest of this release for a recipe.
Manifest new_manifest(const config::Recipe& recipe);

// The manifest's text, numbers in their shortest form that reads back equal, a newline at the end.
std::string manifest_json(const Manifest& manifest);

// An asset's entry as a file of it carries it: without times and hashes of files, with that file
// alone among its files and with its levels alone. Compact JSON.
std::string file_entry_json(const ManifestAsset& asset, const ManifestFile& file);

// The entry that a file carries, in which the file's level is the asset's level 0. E0304 where the
// text is none.
config::Outcome<ManifestAsset> parse_file_entry(std::string_view text, const std::string& name);

// Reads a manifest's text; `name` stands for it in diagnostics. E0304 with the field's place where
// it is damaged, of another tool or format, or names a file outside of its folder. Where it can be
// read and has been changed since it was written, `alterations` say so: each asset has a hash of
// its entry, and the manifest one of the rest (manifest.h).
config::Outcome<Manifest> parse_manifest(std::string_view text, const std::string& name);

// The files that a manifest of an earlier format claims, as retired ones, and nothing else. None
// where the text is no manifest of this tool's, or none of an earlier format.
std::optional<Manifest> parse_earlier_claims(std::string_view text);

// Reads a manifest. E0300 where there is none, E0304 where it is damaged.
config::Outcome<Manifest> read_manifest_file(const std::filesystem::path& file);

// The same of `folder`/manifest.json.
config::Outcome<Manifest> read_manifest(const std::filesystem::path& folder);

// parse_earlier_claims of `folder`/manifest.json; none where it cannot be read.
std::optional<Manifest> read_earlier_claims(const std::filesystem::path& folder);

// Where the manifest is that a user means by a folder or by the manifest itself, and the folder
// that its paths are relative to.
struct ManifestPlace {
    std::filesystem::path folder;
    std::filesystem::path file;
};
ManifestPlace manifest_place(const std::filesystem::path& path);

// `fresh` with those assets of `previous` that it does not name, in the order of `previous`; for
// bakes of a part of a recipe.
Manifest merge_manifests(const Manifest& previous, Manifest fresh);

// The files that `previous` lists, as its assets' or as retired ones, and `fresh` does not.
std::vector<RetiredFile> files_no_longer_made(const Manifest& previous, const Manifest& fresh);

// What a manifest claims, as retired files, and nothing else.
Manifest claims_of(const Manifest& manifest);

// Whether the manifest lists the file (a path relative to its folder), or is that file itself.
bool claims(const Manifest& manifest, const std::filesystem::path& file);

// The JSON Schema that manifest_json's texts satisfy.
std::string manifest_schema();

// The text of a JSON Schema with the names of all formats in place of "@formats@", and those of
// images in place of "@image_formats@": "exr", "vdb", ...
std::string with_formats(std::string_view schema);

// Resolved values as one JSON object, nested by path: {"atmosphere": {"ground_radius": "6360000
// m"}}.
std::string parameters_json(std::span<const config::ResolvedValue> values);

// What the writer and the reader of manifests agree on.

// The version of the manifest's form. A reader refuses another one. What changed from one to the
// next stands in the description of manifest_schema.json.
inline constexpr int manifest_format = 3;

// By what a manifest tells that it has been changed since it was written.
//
// Each asset's entry has a `hash` of all else in it, and the manifest has one of all else in it, in
// which entries are represented by their hashes: so a change is told once, at its place. Hashes are
// xxh3_hex of compact JSON text in the order of the file, so that spaces and line breaks do not
// matter and all else does: wall times too.

// Of an asset's entry, with or without a `hash`.
std::string entry_hash(const nlohmann::ordered_json& entry);

// Of a whole manifest, with or without a `hash`, whose entries have theirs.
std::string manifest_hash(const nlohmann::ordered_json& manifest);

// One sentence for each hash that is not that of its content. The manifest has been read: every
// entry has its hash.
std::vector<std::string> manifest_alterations(const nlohmann::ordered_json& manifest);

}  // namespace skybake
