// The codec that the module skybake_images exports, and its writer of PNG files.
#include "bakers/io/formats/png/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>

#include "bakers/io/formats/png/map_reader.h"

extern "C" const skybake::ImageCodec* skybake_image_codec() {
    static constexpr skybake::ImageCodec codec = {skybake::read_map, skybake::encode_png};
    return &codec;
}

namespace skybake {
namespace {

// This file does not use fmt, because OpenImageIO's headers turn fmt's exceptions into aborts.

// One of zlib's levels 1 to 9. With level 3, files of rendered skies are a tenth larger than with
// level 6 and take half the time.
constexpr int compression_level = 3;

EncodedPicture encode(int width, int height, std::span<const std::uint8_t> rgb) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png", &sink);
    if (output == nullptr) return {"the library does not write PNG", ""};
    OIIO::ImageSpec picture(width, height, 3, OIIO::TypeDesc::UINT8);
    picture.attribute("oiio:ColorSpace", "sRGB");
    picture.attribute("png:compressionLevel", compression_level);
    const bool written = output->open("picture.png", picture) &&
                         output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) && output->close();
    if (!written) return {output->geterror(), ""};
    return {"", std::string(bytes.begin(), bytes.end())};
}

}  // namespace

EncodedPicture encode_png(int width, int height, std::span<const std::uint8_t> rgb) {
    constexpr int largest_edge = 1 << 16;  // far beyond any preview, below PNG's 2^31 - 1
    const bool plausible = width > 0 && height > 0 && width <= largest_edge &&
                           height <= largest_edge &&
                           rgb.size() == std::size_t{3} * static_cast<std::size_t>(width) *
                                             static_cast<std::size_t>(height);
    if (!plausible) {
        return {"a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels with " + std::to_string(rgb.size()) + " bytes",
                ""};
    }
    try {
        return encode(width, height, rgb);
    } catch (const std::exception& error) {
        return {error.what(), ""};
    }
}

}  // namespace skybake
