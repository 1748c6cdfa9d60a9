#include "bakers/plan/sky_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/plan/found_sky.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plan/sky_truth.h"
#include "bakers/plot/chart.h"

namespace skybake {

namespace {

// Half a picture, from the sun to the point opposite to it; the other half is its mirror image.
constexpr int kHalfWidth = 32;
constexpr int kHeight = 24;
constexpr int kEnlarged = 3;
constexpr double kPaths = 1 << 19;
constexpr std::size_t kMostSuns = 3;
constexpr double kShownDifference = 0.2;

// A picture in linear sRGB, row 0 at the top, from the sun on.
using HalfSky = std::vector<glm::dvec3>;

std::vector<double> suns_of(const SceneRange& range) {
    std::vector<double> suns = range.suns_deg;
    if (suns.size() > kMostSuns) suns.resize(kMostSuns);
    if (!suns.empty()) return suns;
    for (const double share : {0.7, 0.25, 0.05}) {
        suns.push_back(range.lowest_sun_deg +
                       share * (range.highest_sun_deg - range.lowest_sun_deg));
    }
    return suns;
}

std::vector<SkySample> views_of(const Shell& shell, double altitude_km,
                                const std::vector<double>& suns_deg) {
    const double above_deg = SkyViewCamera(shell, altitude_km).range_above() * kDegreesPerRadian;
    std::vector<SkySample> views;
    for (const double sun_deg : suns_deg) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kHalfWidth; ++x) {
                views.push_back(sky_sample(shell, altitude_km, sun_deg,
                                           above_deg * (kHeight - y - 0.5) / kHeight,
                                           180 * (x + 0.5) / kHalfWidth));
            }
        }
    }
    return views;
}

// Makes colours for the screen of what is compared: colours, or light of wavelengths.
class Screen {
  public:
    Screen(const config::Parameters& parameters, bool has_colors)
        : weights_(has_colors || parameters.wavelengths.size() < 3
                       ? std::vector<glm::dvec3>{}
                       : linear_color_weights(parameters.wavelengths, config::Color())),
          is_grey_(!has_colors && weights_.empty()) {}

    std::vector<glm::dvec3> colors(const std::vector<Spectrum>& light) const {
        std::vector<glm::dvec3> colors;
        for (const Spectrum& one : light) {
            glm::dvec3 color(one[0], one[1], one[2]);
            if (is_grey_) color = glm::dvec3(one[0]);
            if (!weights_.empty()) color = glm::dvec3(0);
            for (std::size_t c = 0; c < weights_.size(); ++c) color += one[c] * weights_[c];
            colors.push_back(color);
        }
        return colors;
    }

  private:
    std::vector<glm::dvec3> weights_;
    bool is_grey_;
};

HalfSky sky_under(const std::vector<glm::dvec3>& colors, std::size_t sun) {
    constexpr std::ptrdiff_t kPixels = kHalfWidth * kHeight;
    const auto first = colors.begin() + kPixels * static_cast<std::ptrdiff_t>(sun);
    return {first, first + kPixels};
}

double luminance(const glm::dvec3& color) {
    return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

// The exposure that makes the brightest tenth of the sky nearly white.
double exposure_of(const HalfSky& truth) {
    std::vector<double> values;
    for (const glm::dvec3& color : truth) values.push_back(luminance(color));
    std::sort(values.begin(), values.end());
    const double bright = values[values.size() * 9 / 10];
    return bright > 0 ? 1.5 / bright : 1;
}

std::uint8_t on_screen(double light) {
    const double shown = 1 - std::exp(-std::max(light, 0.0));
    const double coded =
        shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(coded, 0.0, 1.0)));
}

// Draws both halves, enlarged. `color_at` returns the colour of a pixel of the half.
template <class ColorAt>
Picture mirrored(const ColorAt& color_at) {
    Picture picture(2 * kHalfWidth * kEnlarged, kHeight * kEnlarged);
    std::uint8_t* to = picture.rgb.data();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int column = x / kEnlarged;
            const int half = column < kHalfWidth ? kHalfWidth - 1 - column : column - kHalfWidth;
            const auto color =
                color_at(static_cast<std::size_t>(y / kEnlarged * kHalfWidth + half));
            to = std::copy(color.begin(), color.end(), to);
        }
    }
    return picture;
}

Picture sky_picture(const HalfSky& sky, double exposure) {
    return mirrored([&](std::size_t i) {
        const glm::dvec3 light = exposure * sky[i];
        return Colour{on_screen(light.x), on_screen(light.y), on_screen(light.z)};
    });
}

Picture difference_picture(const HalfSky& sky, const HalfSky& truth) {
    return mirrored([&](std::size_t i) {
        const double wanted = luminance(truth[i]);
        const double off = wanted > 0 ? luminance(sky[i]) / wanted - 1 : 0;
        return diverging_colour(std::clamp(0.5 + 0.5 * off / kShownDifference, 0.0, 1.0));
    });
}

// Returns the way of least error of each family, the best first.
std::vector<const MeasuredWay*> best_of_families(const std::vector<MeasuredWay>& ways) {
    std::vector<const MeasuredWay*> sorted;
    for (const MeasuredWay& way : ways) sorted.push_back(&way);
    std::stable_sort(sorted.begin(), sorted.end(), [](const MeasuredWay* a, const MeasuredWay* b) {
        return a->error.ninth_decile < b->error.ninth_decile;
    });
    std::set<std::string> seen;
    std::erase_if(sorted,
                  [&](const MeasuredWay* way) { return !seen.insert(way->way.family).second; });
    return sorted;
}

}  // namespace

config::Outcome<std::string> sky_sheet(const config::Recipe& recipe, const SceneRange& range,
                                       const std::vector<MeasuredWay>& ways,
                                       const WayAssets& assets,
                                       const std::vector<BakedAsset>& baked,
                                       const std::vector<glm::dvec3>& weights,
                                       const BakeOptions& options) {
    const config::Parameters& parameters = recipe.parameters;
    const std::vector<double> suns = suns_of(range);
    const double altitude_km = (range.lowest_altitude_km + range.highest_altitude_km) / 2;
    SceneTruth truth(parameters.atmosphere,
                     views_of(shell_of(parameters.atmosphere), altitude_km, suns), weights,
                     options);
    truth.trace(kPaths);
    if (options.cancelled()) return {};
    const Screen screen(parameters, !weights.empty());
    const std::vector<glm::dvec3> traced = screen.colors(truth.light());
    SheetBlock block;
    block.title =
        fmt::format("Paths of light, and the best way of each family, from {:.3g} km", altitude_km);
    for (const double sun : suns) {
        block.columns.push_back(fmt::format("sun at {:.3g} degrees", sun));
        block.columns.push_back(fmt::format("-{0:.0f} % to +{0:.0f} %", 100 * kShownDifference));
    }
    block.rows.emplace_back("paths of light");
    for (std::size_t s = 0; s < suns.size(); ++s) {
        const HalfSky sky = sky_under(traced, s);
        block.pictures.push_back(sky_picture(sky, exposure_of(sky)));
        block.pictures.emplace_back();
    }
    const SkyOfWay found(parameters, truth, options.threads);
    for (const MeasuredWay* way : best_of_families(ways)) {
        double fetches = 0;
        const auto colors =
            screen.colors(found.find(way->way, assets.of(way->way, baked), fetches));
        block.rows.push_back(full_name(way->way));
        for (std::size_t s = 0; s < suns.size(); ++s) {
            const HalfSky wanted = sky_under(traced, s);
            const HalfSky sky = sky_under(colors, s);
            block.pictures.push_back(sky_picture(sky, exposure_of(wanted)));
            block.pictures.push_back(difference_picture(sky, wanted));
        }
    }
    return png_bytes(contact_sheet({block}));
}

}  // namespace skybake
