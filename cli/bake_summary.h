// What a bake says to people: the plan before, the table after.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/io/manifest.h"
#include "config/parameters.h"

namespace skybake::cli {

// One row an asset: size, files, estimated time and disk.
std::string plan_text(const config::Parameters& parameters, std::span<const config::Bake> bakes);

// One row a file, the first of an asset with its size, times and errors; then totals.
std::string summary_text(const std::vector<ManifestAsset>& assets, double seconds);

// "256x64", "128x128x128".
std::string extent_text(std::span<const int> size);

}  // namespace skybake::cli
