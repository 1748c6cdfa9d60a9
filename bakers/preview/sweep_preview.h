// The page of a sweep, which shows one thumbnail of each variant side by side.
#pragma once

#include <filesystem>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Makes contact sheets, plots of error against cost, and the table of all variants, with links from
// the page in `page_folder` to their folders. A variant whose folder cannot be read has no
// thumbnail, and a note says why. Diagnostics are those of load_sweep and png_bytes, warnings those
// of load_folder. If the user interrupts, there is neither a value nor a diagnostic.
Outcome<PreviewPage> make_sweep_preview(const std::filesystem::path& folder,
                                        const std::filesystem::path& page_folder,
                                        const PreviewOptions& options);

}  // namespace skybake
