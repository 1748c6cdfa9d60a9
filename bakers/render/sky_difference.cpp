#include "bakers/render/sky_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/math/relative_error.h"

namespace skybake {

namespace {

std::array<double, 4> largest_values(const Image2<float>& image) {
    std::array<double, 4> largest{};
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        double& value = largest[i % channels];
        value = std::max(value, double{image.texels[i]});
    }
    return largest;
}

}  // namespace

SkyDifference sky_difference(const Image2<float>& picture, const Image2<float>& reference,
                             const SkyView& view) {
    const std::array<double, 4> largest = largest_values(reference);
    SkyDifference difference;
    difference.relative = Image2<float>(picture.width, picture.height, 1);
    ErrorStatistics statistics;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (coverage_at(view, x, y) < 0.5) continue;
            double furthest = 0;
            for (int c = 0; c < picture.channels; ++c) {
                const double error =
                    relative_error(double{picture.texel(x, y)[c]}, double{reference.texel(x, y)[c]},
                                   largest[static_cast<std::size_t>(c)]);
                statistics.add(error);
                if (std::fabs(error) > std::fabs(furthest)) furthest = error;
            }
            *difference.relative.texel(x, y) = static_cast<float>(furthest);
        }
    }
    difference.error = statistics.figures();
    return difference;
}

}  // namespace skybake
