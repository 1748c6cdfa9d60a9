// Text as bitmaps, for pictures.
#pragma once

#include <optional>
#include <string_view>

#include "bakers/io/formats/png/image_codec.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A line of text; drawn once and kept, for pages repeat their labels. Where text cannot be drawn it
// is blank, and text_problem says why. For any number of threads.
const TextBitmap& label(std::string_view text, int em_pixels, FontWeight weight);

// Why pictures have no text, or nothing: E0300 without the font DejaVu Sans, or without the module
// that draws it. To be asked before pictures are made.
std::optional<config::Diagnostic> text_problem();

}  // namespace skybake
