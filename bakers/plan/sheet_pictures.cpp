#include "bakers/plan/sheet_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "bakers/plan/plan.h"
#include "bakers/plot/false_colours.h"
#include "bakers/render/tone_curve.h"

namespace skybake {
namespace {

constexpr int kEnlarged = 3;

Image2<float> enlarged(const Image2<float>& image) {
    const int edge = kEnlarged * std::max(image.width, image.height);
    return fitted(image, edge, 2 * edge);
}

// Draws how far luminances are off; `off` takes that of the light and that of the truth.
template <class Off>
Picture differences(const Image2<float>& light, const Image2<float>& truth, const Off& off) {
    Image2<float> field(light.width, light.height, 1);
    for (int y = 0; y < field.height; ++y) {
        for (int x = 0; x < field.width; ++x) {
            *field.texel(x, field.height - 1 - y) = static_cast<float>(
                off(luminance(light.texel(x, y), 3), luminance(truth.texel(x, y), 3)));
        }
    }
    return in_false_colours(enlarged(field),
                            {-kShownDifference, kShownDifference, false, true, ""});
}

}  // namespace

double exposure_of(const Image2<float>& truth) {
    return exposure_by({0.9, 1 - std::exp(-1.5)}, truth, ToneCurve::exponential);
}

Picture shown_picture(const Image2<float>& light, double exposure) {
    return tone_mapped(enlarged(light), exposure, ToneCurve::exponential);
}

Picture difference_picture(const Image2<float>& light, const Image2<float>& truth) {
    return differences(light, truth, [](double found, double wanted) {
        return wanted > 0 ? found / wanted - 1 : 0;
    });
}

Picture exposed_difference(const Image2<float>& light, const Image2<float>& truth,
                           double exposure) {
    return differences(light, truth, [exposure](double found, double wanted) {
        return std::exp(-exposure * wanted) - std::exp(-exposure * found);
    });
}

std::vector<std::size_t> best_of_families(const std::vector<MeasuredWay>& ways) {
    std::vector<std::size_t> sorted = by_error(ways);
    std::set<std::string> seen;
    std::erase_if(sorted, [&](std::size_t i) { return !seen.insert(ways[i].way.family).second; });
    return sorted;
}

}  // namespace skybake
