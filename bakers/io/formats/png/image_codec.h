// The seam between pictures and the libraries that know them: what the module on its far side does.
// Linking OpenImageIO loads 260 libraries and costs half a second at every start of the program, so
// it is loaded on first use (image_module.h), and FreeType with it.
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

enum class FontWeight { regular, bold };

// A line of text as how much of each pixel it covers: 0 nothing, 255 all. Its origin, the left end
// of the baseline, is `baseline` rows below the top of row 0 and `left` columns right of the left
// edge of column 0. Of blank text, 0 x 0, with its advance.
struct TextBitmap {
    std::string problem;  // empty: none
    int width = 0;
    int height = 0;
    int baseline = 0;
    int left = 0;
    double advance = 0;  // from the origin to where text that follows begins
    std::vector<std::uint8_t> coverage;
};

// The module's functions. None throws.
struct ImageCodec {
    // The channel of that name, or the first where it is empty. Integers are over their largest
    // value, nothing else is changed.
    MapPixels (*read)(const std::filesystem::path& path, const std::string& channel);

    // A PNG of 8 bits a channel, sRGB, of interleaved R G B; row 0 at the top. No date, no
    // software's name: the same picture gives the same bytes.
    EncodedPicture (*encode_png)(int width, int height, std::span<const std::uint8_t> rgb);

    // A line of UTF-8 in DejaVu Sans, `em_pixels` high from 1 to 256. Bytes that are not UTF-8
    // show as U+FFFD, control characters as spaces.
    TextBitmap (*draw_text)(std::string_view text, int em_pixels, FontWeight weight);
};

// What the module exports, under this name.
using ImageCodecFunction = const ImageCodec* (*)();
inline constexpr const char* image_codec_symbol = "skybake_image_codec";

}  // namespace skybake
