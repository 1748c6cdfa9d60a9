// Noises, clouds, particles and layers that start from a preset: [noise.NAME] and so on with
// `preset = "..."`.
#pragma once

#include <deque>

#include "config/diagnostics/diagnostic_list.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Lays each such section of the merged recipe over the preset that it names. The presets'
// texts join the sources, which own what places point to. False if one is unknown, which is
// reported (E0115), or is no text, so that keys may be missing for that reason.
bool lay_sections_over_presets(Table& root, std::deque<Source>& sources,
                               DiagnosticList& diagnostics);

}  // namespace skybake::config
