// What is said of an asset: its entry in the manifest, which its files carry too, and the lines
// that people read of it.
//
// All are pure functions of the parameters, without times, users, hosts or paths, so that equal
// input gives equal bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Everything that a manifest says of an asset except its files and timing.
ManifestAsset describe(const Baked& baked);

// The entry that a file carries (file_entry_json), named as the file; nothing is known of its time,
// its key and its hash. E0300; E0304 where it carries none.
config::Outcome<ManifestAsset> entry_of_file(const std::filesystem::path& path);

// What an entry says of a file, for people: names and texts, the last of which have several lines.
using FactLines = std::vector<std::pair<std::string, std::string>>;
FactLines entry_lines(const ManifestAsset& asset, const ManifestFile& file);

// The units of an asset in one line.
std::string units_line(const Conventions& conventions);

// The error figures in one line: "texel max 1e-7 rms 2e-8 (1024 points); lookup max ..."
std::string error_line(const std::optional<Certificate>& certificate);

// One axis in one line: quantity, range, convention, formula.
std::string axis_line(const AxisMapping& axis);

// The recipe that a folder was baked from, as its manifest recorded it.

// Parses manifest.parameters again. All values are there, resolved, so that the outcome's
// parameters equal those of the bake; but a bake of a part (`--only`) recorded the recipe of that
// day alone, and maps are looked for in `folder`, where includes are not. `name` stands for the
// manifest in diagnostics. E0304: the recorded values are none that this release would record.
config::Outcome<config::Recipe> recorded_recipe(const Manifest& manifest, const std::string& name,
                                                const std::filesystem::path& folder);

}  // namespace skybake
