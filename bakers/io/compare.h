// How far two images are apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/io/exr.h"

namespace skybake {

struct ChannelDifference {
    std::string channel;
    double max_absolute = 0;  // infinite where only one of two values is finite
    double rms = 0;
    double max_relative = 0;  // of the greater of the two magnitudes
    long differing = 0;       // texels, NaN being equal to NaN
    int worst_x = 0;          // texel of max_absolute
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

ImageDifference compare_images(const ExrImage& first, const ExrImage& second);

// Whether the images have one layout and no value differs by more than `tolerance`.
bool equal_within(const ImageDifference& difference, double tolerance);

}  // namespace skybake
