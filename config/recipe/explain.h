// This header makes what `skybake explain` prints about keys, tables and diagnostic codes. The
// texts come from the tables that define these.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

// Explains a diagnostic code ("E0102"), a preset ("earth"), by its own comment, a key
// ("atmosphere.layers.mie.g", "layers.*.g", "g") or a table ("atmosphere.layers.mie",
// "bake.transmittance"). The front of a key's path may be left out; if several things fit, all are
// explained. Returns none if nothing fits.
std::optional<std::string> explain(std::string_view what);

// Lists every key with its one line of documentation, table by table.
std::string explain_all_keys();

// Lists everything that explain knows, for suggestions: paths, bare keys and codes.
std::vector<std::string> explained_names();

}  // namespace skybake::config
