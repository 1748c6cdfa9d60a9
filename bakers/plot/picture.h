// Pictures for eyes: what every part of a preview is made into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skybake {

// 8 bits a channel, R G B interleaved, sRGB; row 0 is at the top.
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

// image  tones or greys that mean themselves
// scene  what an eye would see, to be looked at as large as the page has room for
// plot   lines or false colours on paper, which may be dark as the page is
enum class PictureKind { image, scene, plot };

// A picture with what a page says of it.
struct PreviewPicture {
    std::string name;   // the file's stem, unique in a preview: "transmittance_red"
    std::string title;  // "Transmittance, red"
    std::string
        caption;  // what one sees, with units, exposure and tone curve, in a sentence or two
    Picture picture;
    std::optional<double> exposure = {};  // what radiance was multiplied by, in pictures of light
    PictureKind kind = PictureKind::image;
};

inline PreviewPicture as_plot(PreviewPicture picture) {
    picture.kind = PictureKind::plot;
    return picture;
}

}  // namespace skybake
