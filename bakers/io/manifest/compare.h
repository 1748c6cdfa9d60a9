// How far two images are apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/exr_file.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct ChannelDifference {
    std::string channel;
    double max_absolute = 0;  // infinite where only one of two values is finite
    double rms = 0;
    double max_relative = 0;     // of the greater of the two magnitudes
    std::int64_t differing = 0;  // texels, NaN being equal to NaN
    int worst_x = 0;             // texel of max_absolute
    int worst_y = 0;
};

// A text that two files have differently, or that one of them lacks.
struct AttributeDifference {
    std::string name;
    std::optional<std::string> first;
    std::optional<std::string> second;
};

// Where two entries that files carry (file_entry_json) differ: names are those of their members,
// "error/lookup/max". Texts that are no entries are compared as they are.
std::vector<AttributeDifference> metadata_differences(const std::string& first,
                                                      const std::string& second);

struct ImageDifference {
    std::string layout;  // what makes the images incomparable (size, channels), or empty
    std::vector<ChannelDifference> channels;      // empty where they are incomparable
    std::vector<AttributeDifference> attributes;  // pixel type and compression among them
};

// An image whose rows are read one after the other.
struct ComparedImage {
    RowSource rows;
    std::vector<std::string> channel_names;
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Attributes attributes;
};

// The file must stay where it is.
ComparedImage compared(ExrRows& file);

// Reads both once, row by row. Diagnostics as of the sources.
config::Outcome<ImageDifference> compare_images(const ComparedImage& first,
                                                const ComparedImage& second);

// Whether the images have one layout and no value differs by more than `tolerance`.
bool equal_within(const ImageDifference& difference, double tolerance);

}  // namespace skybake
