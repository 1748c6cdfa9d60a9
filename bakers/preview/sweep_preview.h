// The page of a sweep, which shows one thumbnail of each variant side by side.
#pragma once

#include <filesystem>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The most variants that get a thumbnail. The table lists all variants.
inline constexpr std::size_t most_pictured_variants = 144;

// Makes a contact sheet with the varied values as captions, and the table of all variants. A
// variant whose folder cannot be read has no thumbnail, and a note says why. Diagnostics are those
// of load_sweep and png_bytes, warnings those of load_folder. If the user interrupts, there is
// neither a value nor a diagnostic.
config::Outcome<PreviewPage> make_sweep_preview(const std::filesystem::path& folder,
                                                const PreviewOptions& options);

}  // namespace skybake
