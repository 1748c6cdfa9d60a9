// The codec that the module skybake_images exports, and its writers.
#include "bakers/io/formats/png/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>

#include "bakers/io/formats/png/map_reader.h"

extern "C" const skybake::ImageCodec* skybake_image_codec() {
    static constexpr skybake::ImageCodec codec = {skybake::read_map, skybake::encode_png,
                                                  skybake::encode_hdr};
    return &codec;
}

namespace skybake {
namespace {

// This file does not use fmt, because OpenImageIO's headers turn fmt's exceptions into aborts.

// One of zlib's levels 1 to 9. With level 3, files of rendered skies are a tenth larger than with
// level 6 and take half the time.
constexpr int compression_level = 3;

EncodedPicture encode(const char* format, const OIIO::ImageSpec& picture, const void* rgb) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &sink);
    if (output == nullptr) return {std::string("the library does not write ") + format, ""};
    const bool written = output->open(std::string("picture.") + format, picture) &&
                         output->write_image(picture.format, rgb) && output->close();
    if (!written) return {output->geterror(), ""};
    return {"", std::string(bytes.begin(), bytes.end())};
}

// Encodes interleaved R G B of a picture that has as many values.
template <class T>
EncodedPicture checked(const char* format, const OIIO::ImageSpec& picture, std::span<const T> rgb) {
    constexpr int largest_edge = 1 << 17;  // far beyond any picture, below PNG's 2^31 - 1
    const bool plausible = picture.width > 0 && picture.height > 0 &&
                           picture.width <= largest_edge && picture.height <= largest_edge &&
                           rgb.size() == picture.image_pixels() * std::size_t{3};
    if (!plausible) {
        return {"a picture of " + std::to_string(picture.width) + " x " +
                    std::to_string(picture.height) + " pixels with " +
                    std::to_string(rgb.size_bytes()) + " bytes",
                ""};
    }
    try {
        return encode(format, picture, rgb.data());
    } catch (const std::exception& error) {
        return {error.what(), ""};
    }
}

}  // namespace

EncodedPicture encode_png(int width, int height, std::span<const std::uint8_t> rgb) {
    OIIO::ImageSpec picture(width, height, 3, OIIO::TypeDesc::UINT8);
    picture.attribute("oiio:ColorSpace", "sRGB");
    picture.attribute("png:compressionLevel", compression_level);
    return checked("png", picture, rgb);
}

EncodedPicture encode_hdr(int width, int height, std::span<const float> rgb) {
    return checked("hdr", OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT), rgb);
}

}  // namespace skybake
