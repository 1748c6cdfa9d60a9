// What `skybake explain` prints: keys, tables and diagnostic codes, from the tables that define
// them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

// Explains a diagnostic code ("E0102"), a key ("atmosphere.layers.mie.g", "layers.*.g", "g") or a
// table ("atmosphere.layers.mie", "bake.transmittance"). A key's path may be cut at the front;
// where several keys fit, all are explained. None if nothing fits.
std::optional<std::string> explain(std::string_view what);

// Every key with its one line of documentation, by table.
std::string explain_all_keys();

// What explain knows, for suggestions: paths, bare keys and codes.
std::vector<std::string> explained_names();

}  // namespace skybake::config
