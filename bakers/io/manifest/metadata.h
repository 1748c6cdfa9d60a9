// Descriptions of an asset: its entry in the manifest, which its files also carry, the lines that
// people read, and the recipe that its manifest recorded.
//
// The descriptions are pure functions of the parameters. They contain no times, users, hosts or
// paths, so equal input gives equal bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

struct Baked;

// Returns everything that a manifest says about an asset except its files and timing.
ManifestAsset describe(const Baked& baked);

// Returns the entry that a file carries (file_entry_json), under the file's name. Its time, key and
// hash are unknown. E0300 if the file cannot be read, E0304 if it carries no entry.
Outcome<ManifestAsset> entry_of_file(const std::filesystem::path& path);

// An entry's facts about a file, for people: names and texts. The last texts have several lines.
using FactLines = std::vector<std::pair<std::string, std::string>>;
FactLines entry_lines(const ManifestAsset& asset, const ManifestFile& file);

// Returns the units of an asset in one line.
std::string units_line(const Conventions& conventions);

// Returns the recipe that a folder was baked from, by parsing manifest.parameters. It records all
// resolved values, so the resulting parameters equal those of the bake. There are two limits: after
// a bake of a part (`--only`), it is the recipe of that last bake; and maps, unlike includes, are
// looked for in `folder`. Diagnostics call the manifest `name`. E0304 if this release would not
// record such values.
Outcome<Recipe> recorded_recipe(const Manifest& manifest, const std::string& name,
                                const std::filesystem::path& folder);

}  // namespace skybake
