// PNG files of pictures.
#pragma once

#include <string>

#include "bakers/plot/picture.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The bytes of a PNG, 8 bits a channel, sRGB, without date or software's name: the same picture
// gives the same bytes. E0300 where the module that makes them is not there; E0500 where it refuses
// the picture (its size contradicts its bytes, or it has no pixels: a mistake of the program).
config::Outcome<std::string> png_bytes(const Picture& picture);

}  // namespace skybake
