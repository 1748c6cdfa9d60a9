// Pictures for eyes: what every part of a preview is made into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

// 8 bits per channel, R G B interleaved, sRGB; row 0 is at the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    Picture() = default;
    Picture(int width_, int height_)
        : width(width_),
          height(height_),
          rgb(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3) {}
};

// The bytes of a PNG, 8 bits per channel, sRGB, without date or software's name: the same picture
// gives the same bytes. E0300 where the module that makes them is not there; E0500 where it refuses
// the picture (its size contradicts its bytes, or it has no pixels: a mistake of the program).
config::Outcome<std::string> png_bytes(const Picture& picture);

// image  tones or greys that mean themselves
// scene  what an eye would see, to be looked at as large as the page has room for
// plot   lines or false colours on paper, which may be dark as the page is
enum class PictureKind { image, scene, plot };

// A picture with what a page says of it.
struct PreviewPicture {
    std::string name;   // the file's stem, unique in a preview: "transmittance_red"
    std::string title;  // "Transmittance, red"
    // What one sees, with units, exposure and tone curve, in a sentence or two.
    std::string caption;
    Picture picture;
    std::optional<double> exposure = {};  // what radiance was multiplied by, in pictures of light
    PictureKind kind = PictureKind::image;
};

inline PreviewPicture as_plot(PreviewPicture picture) {
    picture.kind = PictureKind::plot;
    return picture;
}

}  // namespace skybake
