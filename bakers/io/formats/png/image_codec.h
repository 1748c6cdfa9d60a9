// The seam between pictures and the libraries that know them: what the module on its far side does.
// Linking OpenImageIO loads 260 libraries and costs half a second at every start of the program, so
// it is loaded on first use (map_image.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skybake {

// A picture of at least one pixel, or why there is none.
struct MapPixels {
    std::string problem;                     // "it is a deep image"; empty: none
    int width = 0;                           // 1 to largest_map_edge
    int height = 0;                          // the same
    std::vector<std::string> channel_names;  // in the file's order
    std::vector<float> values;  // of the channel asked for, row-major; empty: there is no such
};

// A picture's file, or why there is none.
struct EncodedPicture {
    std::string problem;  // empty: none
    std::string bytes;
};

// The module's functions. None throws.
struct ImageCodec {
    // The channel of that name, or the first where it is empty. Integers are over their largest
    // value, nothing else is changed.
    MapPixels (*read)(const std::filesystem::path& path, const std::string& channel);

    // A PNG of 8 bits a channel, sRGB, of interleaved R G B; row 0 at the top. No date, no
    // software's name: the same picture gives the same bytes.
    EncodedPicture (*encode_png)(int width, int height, std::span<const std::uint8_t> rgb);
};

// What the module exports, under this name.
using ImageCodecFunction = const ImageCodec* (*)();
inline constexpr const char* image_codec_symbol = "skybake_image_codec";

// Makes PNG files by OpenImageIO; a part of the module skybake_images.

// As ImageCodec::encode_png.
EncodedPicture encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace skybake
