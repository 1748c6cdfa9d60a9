// Draws text by FreeType; a part of the module skybake_images. OpenImageIO draws text by FreeType,
// too, but of what is not ASCII it shows other letters (2.4.7), and every letter on whole pixels.
#pragma once

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// As ImageCodec::draw_text.
TextBitmap draw_text(std::string_view text, int em_pixels, FontWeight weight);

}  // namespace skybake
