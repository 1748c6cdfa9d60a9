// Prints the facts of grids, and of EXR images of kinds that skybake does not write, for `info`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/manifest/metadata.h"
#include "cli/command.h"

namespace skybake::cli {

// Lays out facts. A text of several lines stands below its name, any other beside it.
std::string lines_text(const FactLines& lines);

// Lays out attributes; `info` shows skybake's own entry by its facts.
std::string attribute_text(const Attributes& attributes);
nlohmann::ordered_json attributes_json(const Attributes& attributes);

// The grids of an OpenVDB or NanoVDB file, which its name tells apart.
ExitCode show_grids(const std::filesystem::path& path, Console& console);

// The header of an EXR file whose pixels are not read, for this reason.
ExitCode show_exr_heads(const std::filesystem::path& path, const Diagnostic& reason,
                        Console& console);

}  // namespace skybake::cli
