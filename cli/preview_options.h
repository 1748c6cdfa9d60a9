// The options of `preview` and what they say.
#pragma once

#include <optional>
#include <vector>

#include "bakers/preview/make_preview.h"
#include "cli/command.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// Their declarations.
std::vector<Option> preview_options();

// Suns, exposure, camera and size. Adds E0001 for what is no number, has no unit or is out of
// range.
PreviewOptions read_preview_options(const Invocation& invocation,
                                    std::vector<config::Diagnostic>& problems);

// --draft, if it was given. Adds E0001.
std::optional<int> read_draft_edge(const Invocation& invocation,
                                   std::vector<config::Diagnostic>& problems);

}  // namespace skybake::cli
