// A preview's files, from memory to its folder.
#pragma once

#include <string>
#include <vector>

#include "bakers/preview/page.h"
#include "cli/exit_code.h"
#include "cli/preview_request.h"

namespace skybake::cli {

class Console;

// Whether the folder may be written to, as far as one sees before the pictures are made: reported
// where not. E0302, E0303.
ExitCode check_output(const PreviewRequest& request, Console& console);

// Writes all files at once, and says which in `paths`, the page last. Pictures of earlier previews
// that are not made any more stay where they are. E0301, E0302, E0303.
ExitCode write_preview(PreviewPage page, const PreviewRequest& request, Console& console,
                       std::vector<std::string>& paths);

}  // namespace skybake::cli
