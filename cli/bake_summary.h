// What a bake says to people: the plan before, the table after.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/io/write_table.h"
#include "config/parameters.h"

namespace skybake::cli {

// One row an asset: size, estimated time, memory and disk.
std::string plan_text(std::span<const config::Bake> bakes);

// One row an asset: size, file, times, errors; then totals.
std::string summary_text(const std::vector<EncodedTable>& tables, double seconds);

}  // namespace skybake::cli
