// Compares two images: the values of their channels and their attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/exr_file.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

struct ChannelDifference {
    std::string channel;
    double max_absolute = 0;  // infinite where only one of two values is finite
    double rms = 0;
    double max_relative = 0;     // relative to the greater of the two magnitudes
    std::int64_t differing = 0;  // number of texels; NaN equals NaN
    int worst_x = 0;             // texel of max_absolute
    int worst_y = 0;
};

// A text that differs between two files, or that one of them lacks.
struct AttributeDifference {
    std::string name;
    std::optional<std::string> first;
    std::optional<std::string> second;
};

// Returns the differences between the entries that two files carry (file_entry_json). The names are
// the paths of members, such as "error/lookup/max". Texts that are not entries are compared as a
// whole.
std::vector<AttributeDifference> metadata_differences(const std::string& first,
                                                      const std::string& second);

struct ImageDifference {
    std::string layout;  // why the images cannot be compared (size, channels), or empty
    std::vector<ChannelDifference> channels;      // empty if they cannot be compared
    std::vector<AttributeDifference> attributes;  // pixel type and compression among them
};

// An image for comparison; its rows are read one after the other.
struct ComparedImage {
    RowSource rows;
    std::vector<std::string> channel_names;
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Attributes attributes;
};

// Makes an open EXR file comparable. The result refers to `file`, which must not be moved.
ComparedImage compared(ExrRows& file);

// Reads both images once, row by row. Diagnostics come from the row sources.
config::Outcome<ImageDifference> compare_images(const ComparedImage& first,
                                                const ComparedImage& second);

// Whether the images have the same layout and no value differs by more than `tolerance`.
bool equal_within(const ImageDifference& difference, double tolerance);

}  // namespace skybake
