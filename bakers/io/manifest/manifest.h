// manifest.json, which tells programs what a bake left in a folder. manifest_schema.json defines
// its form. This header holds its model, its reader and writer, and the hashes that detect changes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/io/formats/format.h"
#include "bakers/math/bake_clock.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/pixel_types.h"

namespace skybake {

inline constexpr std::string_view manifest_name = "manifest.json";

struct ManifestFile {
    std::string path;    // relative to the manifest's folder, never leaving it
    std::string format;  // "exr", "vdb", "bin", "png", "dds"; "json" or "sidecar" for texts
    PixelType pixel_type = PixelType::float32;
    std::uint64_t bytes = 0;
    std::string xxh3;                           // xxh3_hex of the file
    int level = 0;                              // level of detail; 0 is the asset itself
    int levels = 1;                             // how many levels the file holds, from `level` on
    std::string compression = {};               // "none", "zip", "blosc", ...
    std::optional<SheetGrid> layout = {};       // for images: where the slices lie
    std::vector<std::string> grids = {};        // for vdb: the grid of each channel
    TextureParts texture = TextureParts::none;  // for dds and ktx2
};

// An input file of an asset besides the recipe.
struct ManifestInput {
    std::string file;  // as the recipe names it
    std::string xxh3;  // xxh3_hex of its bytes
};

// Wall times, which are the only part of a bake's output that changes from run to run.
struct Timing {
    BakeSeconds bake;
    double write_s = 0;
    int threads = 1;
};

// One level of detail. A table has one slice.
struct ManifestLevel {
    std::array<int, 3> size{};
    std::string content_hash;                 // xxh3_hex of the voxels as stored
    std::vector<ValueStatistics> statistics;  // one per channel
    std::vector<Probe> probes;
    std::vector<std::string> catches = {};  // wrong lookups that the probes detect
};

// One asset: everything that its files say in their metadata, and what only a manifest says.
struct ManifestAsset {
    std::string name;
    std::string kind;
    std::string content;
    std::vector<ManifestFile> files;
    std::vector<int> size;  // of level 0: texels along u, v or voxels along u, v, w
    std::vector<std::string> channels;
    std::string mapping;
    std::vector<AxisMapping> axes;  // u, v; u, v, w
    Timing timing;
    std::optional<Certificate> error;  // none if it was not measured
    RangeCounts range;
    std::vector<ManifestLevel> levels;  // level 0 first
    Conventions conventions;
    Facts details;
    std::optional<LookupCost> lookup_cost;  // none of releases that did not count it
    std::string parameters;                 // TOML: the parameters that this asset depends on
    std::string content_hash;               // of level 0
    std::string release;                    // the release that baked it

    // The inputs of the asset (bakers/workspace/folder_plan.h). These are empty in manifests
    // of releases that did not bake incrementally.
    std::string key;
    std::string certification;  // "quick", "full", "off"
    std::vector<ManifestInput> inputs;
    std::vector<config::Diagnostic> warnings;  // of its bake, without places

    double seam_error = 0;  // of volumes: largest difference of voxels 0 and `size`

    bool is_volume() const { return axes.size() == 3; }
};

// Returns the size of the level that a file holds, or of its first level: texels along u, v, or
// voxels along u, v, w of a volume.
std::vector<int> size_of(const ManifestAsset& asset, const ManifestFile& file);

// A file that an earlier bake left in the folder and that the recipe no longer asks for. Because
// skybake wrote it, a later bake may overwrite it.
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

    // The places that a reader found changed since the manifest was written, one sentence each.
    // Only `verify` reports them; a bake does not reuse anything from such a manifest.
    std::vector<std::string> alterations;
};

// Returns an empty manifest of this release for a recipe.
Manifest new_manifest(const Recipe& recipe);

// Returns a warning as an asset's entry holds it.
nlohmann::ordered_json warning_json(const config::Diagnostic& warning);

// Returns error.sky of an asset's entry.
nlohmann::ordered_json sky_error_json(const SkyError& error);

// Returns the manifest's text. Numbers have the shortest form that reads back equal, and the text
// ends with a newline.
std::string manifest_json(const Manifest& manifest);

// Returns an asset's entry, as compact JSON, in the form that one of its files carries: without
// times and hashes of files, and with that file and its levels alone.
std::string file_entry_json(const ManifestAsset& asset, const ManifestFile& file);

// Parses the entry that a file carries. The file's level becomes the asset's level 0. E0304 if the
// text is not an entry.
Outcome<ManifestAsset> parse_file_entry(std::string_view text, const std::string& name);

// Parses a manifest's text; diagnostics call it `name`. E0304, with the field's place, if it is
// damaged, is of another tool or format, or names a file outside of its folder. If it can be read
// but has been changed since it was written, `alterations` say so.
Outcome<Manifest> parse_manifest(std::string_view text, const std::string& name);

// Returns the files that a manifest of an earlier format claims, as retired files, and nothing
// else. Returns nothing if the text is not a manifest of this tool or not of an earlier format.
std::optional<Manifest> parse_earlier_claims(std::string_view text);

// Reads a manifest. E0300 if there is none, E0304 if it is damaged.
Outcome<Manifest> read_manifest_file(const std::filesystem::path& file);

// Reads `folder`/manifest.json.
Outcome<Manifest> read_manifest(const std::filesystem::path& folder);

// Applies parse_earlier_claims to `folder`/manifest.json. Returns nothing if it cannot be read.
std::optional<Manifest> read_earlier_claims(const std::filesystem::path& folder);

// The place of a manifest: its file, and the folder that its paths are relative to. A user names
// either the folder or the manifest.
struct ManifestPlace {
    std::filesystem::path folder;
    std::filesystem::path file;
};
ManifestPlace manifest_place(const std::filesystem::path& path);

// Adds to `fresh` the assets of `previous` that it does not name, in the order of `previous`. A
// bake of a part of a recipe needs this.
Manifest merge_manifests(const Manifest& previous, Manifest fresh);

// Returns the files that `previous` lists, as files of assets or as retired files, and `fresh` does
// not.
std::vector<RetiredFile> files_no_longer_made(const Manifest& previous, const Manifest& fresh);

// Returns a manifest that lists everything that `manifest` claims as retired files, and nothing
// else.
Manifest claims_of(const Manifest& manifest);

// Returns resolved values as one JSON object, nested by path: {"atmosphere": {"ground_radius":
// "6360000 m"}}.
std::string parameters_json(std::span<const config::ResolvedValue> values);

// The version of the manifest's form. A reader refuses other versions. The description in
// manifest_schema.json says what changed from version to version.
inline constexpr int manifest_format = 3;

// Hashes that show whether a manifest has been changed since it was written.
//
// Each asset's entry has a `hash` of everything else in it. The manifest has a `hash` of everything
// else in it, with entries represented by their hashes, so a change is reported once, at its place.
// A hash is xxh3_hex of compact JSON text in the order of the file, so spaces and line breaks do
// not matter but everything else does, including wall times.

// The hash of an asset's entry, which may or may not have a `hash`.
std::string entry_hash(const nlohmann::ordered_json& entry);

// The hash of a whole manifest, which may or may not have a `hash`. Its entries must have theirs.
std::string manifest_hash(const nlohmann::ordered_json& manifest);

// Returns one sentence for each hash that does not match its content. The manifest has been parsed,
// so every entry has a hash.
std::vector<std::string> manifest_alterations(const nlohmann::ordered_json& manifest);

}  // namespace skybake
