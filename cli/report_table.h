// What `skybake report` shows people: a table for each asset.
#pragma once

#include <string>
#include <vector>

#include "bakers/report/report.h"

namespace skybake::cli {

std::string report_table(const std::vector<AssetReport>& assets);

}  // namespace skybake::cli
