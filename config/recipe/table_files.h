// Tables of densities from files: `table = "ozone.csv"`, or ["afglus.dat", "o3"] of a file with
// several columns.
//
// The first column has altitudes. Columns stand between commas, semicolons, tabs or blanks. The last
// line above the numbers names the columns with their units, as in
//
//   # z(km)  p(mb)  T(K)  air(cm-3)  o3(cm-3)
//   altitude [km], ozone [/cm3]
//
// Altitudes need a unit of length. Values have none, or one per volume, of which only ratios count.
// Rows rise or fall; lines that begin with # and empty lines do not count.
#pragma once

#include <filesystem>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Replaces the `table` of each layer of the tree that names a file by the file's pairs, which stand
// at the place of the name. Appends the files to `inputs`. Reports E0300 for a file that cannot be
// read, and E0114 for one that holds no such table.
void read_table_files(Table& root, const std::filesystem::path& folder,
                      std::vector<std::filesystem::path>& inputs, DiagnosticList& diagnostics);

}  // namespace skybake::config
