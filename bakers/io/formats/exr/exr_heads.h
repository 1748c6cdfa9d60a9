// Reads the heads of OpenEXR files of any kind: parts, tiles, deep samples, windows, subsampled
// channels, any codec. Pixels are not read.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/attribute_pieces.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct ExrChannelHead {
    std::string name;
    std::string type;               // "half", "float", "uint"
    std::array<int, 2> sampling{};  // a value for so many columns and rows
};

struct ExrPartHead {
    std::string name;                     // of a file with several parts
    std::string kind;                     // "scan lines", "tiles of 32 x 32", "deep scan lines"
    std::string compression;              // "piz"
    std::array<int, 4> data_window{};     // first column and row, last column and row
    std::array<int, 4> display_window{};  // the same
    std::vector<ExrChannelHead> channels;
    Attributes attributes;  // texts, by name

    std::array<std::int64_t, 2> size() const {
        return {std::int64_t{data_window[2]} - data_window[0] + 1,
                std::int64_t{data_window[3]} - data_window[1] + 1};
    }
};

// Returns the parts of a file, at least one. E0300 if it cannot be read, E0304 if its header is
// damaged.
config::Outcome<std::vector<ExrPartHead>> read_exr_heads(const std::filesystem::path& path);

// Returns "its channel `BY` is subsampled (2 x 2)" of the first such channel, or "".
std::string subsampled_channel(const std::vector<ExrPartHead>& parts);

}  // namespace skybake
