// The seam between maps and OpenImageIO: what the module on its far side does. Linking OpenImageIO
// loads 260 libraries and costs half a second at every start of the program, so it is loaded on
// first use (map_module.h).
#pragma once

#include <filesystem>
#include <string>
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

// The module's functions.
struct MapCodec {
    // The channel of that name, or the first where it is empty. Integers are over their largest
    // value, nothing else is changed.
    MapPixels (*read)(const std::filesystem::path& path, const std::string& channel);
};

// What the module exports, under this name.
using MapCodecFunction = const MapCodec* (*)();
inline constexpr const char* map_codec_symbol = "skybake_map_codec";

}  // namespace skybake
