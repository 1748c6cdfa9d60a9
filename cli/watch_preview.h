// skybake preview --watch
#pragma once

#include "cli/command.h"
#include "cli/preview_request.h"

namespace skybake::cli {

class Console;

// Makes a draft of the recipe's pictures and then the pictures at full quality, and again whenever
// the recipe, an include or a map changes, until interrupted; a change ends what is being made.
// While the recipe has mistakes its diagnostics are shown and the last good pictures stay. Returns
// early where the recipe is missing at the start or the folder cannot be written to.
ExitCode watch_preview(const Invocation& invocation, const PreviewRequest& request,
                       Console& console);

}  // namespace skybake::cli
