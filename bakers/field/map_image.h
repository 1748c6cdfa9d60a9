// A picture of one channel that lies over a cloud's ground plan.
#pragma once

#include <string>
#include <vector>

namespace skybake {

// Row-major, the picture's first row first. Values are in [0, 1] and linear.
struct MapImage {
    int width = 0;
    int height = 0;
    std::vector<float> values;
    std::string content_hash;  // xxh3_hex of width, height and values
};

}  // namespace skybake
