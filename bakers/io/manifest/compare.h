// How far two images are apart.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/exr.h"
#include "bakers/io/formats/exr/exr_rows.h"
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

struct AttributeDifference {
    std::string name;
    std::optional<std::string> first;  // none where the image lacks it
    std::optional<std::string> second;
};

struct ImageDifference {
    std::string layout;  // what makes the images incomparable (size, channels), or empty
    std::vector<ChannelDifference> channels;      // empty where they are incomparable
    std::vector<AttributeDifference> attributes;  // pixel type and compression among them
};

// Where the rows of an image come from: a file, so that images larger than memory can be compared.
struct RowSource {
    int width = 0;
    int height = 0;
    std::vector<std::string> channel_names;
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Attributes attributes;
    int rows_per_piece = 1;
    // Rows first ... first + count - 1, channels interleaved.
    std::function<std::optional<config::Diagnostic>(int first, int count, float* texels)> read;
};

// The file must stay where it is.
RowSource rows_of(ExrRows& file);

// Reads both once, row by row. Diagnostics as of the sources.
config::Outcome<ImageDifference> compare_images(const RowSource& first, const RowSource& second);

// Whether the images have one layout and no value differs by more than `tolerance`.
bool equal_within(const ImageDifference& difference, double tolerance);

}  // namespace skybake
