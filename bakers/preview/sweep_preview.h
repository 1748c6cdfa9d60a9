// The page of a sweep: one picture of each variant beside the others.
#pragma once

#include <filesystem>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The most variants that get a picture; the table has all of them.
inline constexpr std::size_t most_pictured_variants = 144;

// A contact sheet with the varied values as captions, and the table of all variants. Diagnostics of
// load_sweep and png_bytes; a variant whose folder cannot be read has no picture, and a note says
// why. Warnings of
// load_folder. No value and no diagnostics: the user has interrupted.
config::Outcome<PreviewPage> make_sweep_preview(const std::filesystem::path& folder,
                                                const PreviewOptions& options);

}  // namespace skybake
