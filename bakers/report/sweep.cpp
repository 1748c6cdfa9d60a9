#include "bakers/report/sweep.h"

#include <algorithm>
#include <cmath>

namespace skybake {

namespace {

long texel_count(std::array<int, 2> size) { return static_cast<long>(size[0]) * size[1]; }

}  // namespace

std::vector<std::array<int, 2>> sizes_around(std::array<int, 2> size,
                                             const std::vector<std::array<double, 2>>& factors,
                                             long max_texels) {
    const auto scaled = [](int count, double factor) {
        return std::max(std::min(count, 2), static_cast<int>(std::lround(count * factor)));
    };
    std::vector<std::array<int, 2>> sizes;
    for (const auto& [along_u, along_v] : factors) {
        const std::array<int, 2> candidate = {scaled(size[0], along_u), scaled(size[1], along_v)};
        if (texel_count(candidate) > max_texels) continue;
        if (std::find(sizes.begin(), sizes.end(), candidate) == sizes.end()) {
            sizes.push_back(candidate);
        }
    }
    return sizes;
}

std::array<int, 2> size_within(std::array<int, 2> size, long max_texels) {
    while (texel_count(size) > max_texels) {
        for (int& count : size) count = std::max(std::min(count, 2), count / 2);
    }
    return size;
}

std::string size_text(std::array<int, 2> size) {
    return std::to_string(size[0]) + "x" + std::to_string(size[1]);
}

}  // namespace skybake
