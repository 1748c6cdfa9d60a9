// Reads the heads of OpenEXR files of any kind: parts, tiles, deep samples, windows, subsampled
// channels, any codec. Pixels are not read.
//
// Splits long texts into several attributes of an EXR file, and joins them again.
//
// The decoder of ffmpeg up to release 5.1 reads at most 255 bytes of an attribute that it does not
// know and takes the rest for the next attribute: all texels are wrong, and no error is reported.
// A text of `longest_attribute` bytes or more is therefore written in pieces, NAME.0, NAME.1 and so
// on. The pieces follow each other without anything between them.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

using Attributes = std::vector<std::pair<std::string, std::string>>;

// The value of every attribute in a file has fewer bytes than this.
inline constexpr std::size_t longest_attribute = 250;

// Splits long texts into pieces and leaves short ones as they are. No UTF-8 character is cut. The
// result is sorted by name, as files store attributes.
Attributes split_attributes(const Attributes& attributes);

// Joins the texts that were split. Pieces that are not complete from NAME.0 on, or that stand
// beside an attribute NAME, keep their own names; so do attributes of other programs. The result is
// sorted by name.
Attributes joined_attributes(const Attributes& attributes);

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
