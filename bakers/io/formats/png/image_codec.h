// The interface of the module skybake_images, which reads pictures and writes PNG files by
// OpenImageIO. Linking OpenImageIO would load 260 libraries and cost half a second at every start
// of the program, so the module is loaded on first use (map_image.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace skybake {

// A picture of at least one pixel, or why there is none.
struct MapPixels {
    std::string problem;                     // "it is a deep image"; empty: none
    int width = 0;                           // 1 to largest_map_edge
    int height = 0;                          // the same
    std::vector<std::string> channel_names;  // in the file's order
    std::vector<float> values;  // of the requested channels, row-major; empty: no such channel
};

// The bytes of a picture's file, or why there are none.
struct EncodedPicture {
    std::string problem;  // empty: none
    std::string bytes;
};

// The module's functions, none of which throws.
struct ImageCodec {
    // Reads the channel of that name, or the first channel if the name is empty, and those behind it
    // up to `count`, interleaved; a count of 0 reads only the header. Integers are divided by their largest value;
    // nothing else is changed.
    MapPixels (*read)(const std::filesystem::path& path, const std::string& channel, int count);

    // Makes a PNG with 8 bits per channel, sRGB, from interleaved R G B with row 0 at the top. It
    // contains no date and no software's name, so the same picture gives the same bytes.
    EncodedPicture (*encode_png)(int width, int height, std::span<const std::uint8_t> rgb);

    // Makes a Radiance picture in the same way from texels that RGBE holds (bakers/field/pixel_type.h), none of
    // which it rounds.
    EncodedPicture (*encode_hdr)(int width, int height, std::span<const float> rgb);
};

// The name of the function that the module exports, which returns its ImageCodec.
inline constexpr const char* image_codec_symbol = "skybake_image_codec";

// The module's implementations.
EncodedPicture encode_png(int width, int height, std::span<const std::uint8_t> rgb);
EncodedPicture encode_hdr(int width, int height, std::span<const float> rgb);

}  // namespace skybake
