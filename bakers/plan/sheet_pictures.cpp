#include "bakers/plan/sheet_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "bakers/plan/plan.h"

namespace skybake {
namespace {

constexpr int kEnlarged = 3;

double luminance(const glm::dvec3& color) {
    return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

std::uint8_t on_screen(double light) {
    const double shown = 1 - std::exp(-std::max(light, 0.0));
    const double coded =
        shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(coded, 0.0, 1.0)));
}

// Draws pixels enlarged. `color_at` returns the colour of one.
template <class ColorAt>
Picture enlarged(const LightPicture& light, const ColorAt& color_at) {
    Picture picture(light.width * kEnlarged, light.height * kEnlarged);
    std::uint8_t* to = picture.rgb.data();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int pixel = y / kEnlarged * light.width + x / kEnlarged;
            const auto color = color_at(static_cast<std::size_t>(pixel));
            to = std::copy(color.begin(), color.end(), to);
        }
    }
    return picture;
}

Colour difference_colour(double off) {
    return diverging_colour(std::clamp(0.5 + 0.5 * off / kShownDifference, 0.0, 1.0));
}

}  // namespace

double exposure_of(const LightPicture& truth) {
    std::vector<double> values;
    for (const glm::dvec3& color : truth.pixels) values.push_back(luminance(color));
    std::ranges::sort(values);
    const double bright = values[values.size() * 9 / 10];
    return bright > 0 ? 1.5 / bright : 1;
}

Picture shown_picture(const LightPicture& light, double exposure) {
    return enlarged(light, [&](std::size_t i) {
        const glm::dvec3 color = exposure * light.pixels[i];
        return Colour{on_screen(color.x), on_screen(color.y), on_screen(color.z)};
    });
}

Picture difference_picture(const LightPicture& light, const LightPicture& truth) {
    return enlarged(light, [&](std::size_t i) {
        const double wanted = luminance(truth.pixels[i]);
        return difference_colour(wanted > 0 ? luminance(light.pixels[i]) / wanted - 1 : 0);
    });
}

Picture exposed_difference(const LightPicture& light, const LightPicture& truth, double exposure) {
    return enlarged(light, [&](std::size_t i) {
        return difference_colour(std::exp(-exposure * luminance(truth.pixels[i])) -
                                 std::exp(-exposure * luminance(light.pixels[i])));
    });
}

std::vector<std::size_t> best_of_families(const std::vector<MeasuredWay>& ways) {
    std::vector<std::size_t> sorted = by_error(ways);
    std::set<std::string> seen;
    std::erase_if(sorted, [&](std::size_t i) { return !seen.insert(ways[i].way.family).second; });
    return sorted;
}

}  // namespace skybake
