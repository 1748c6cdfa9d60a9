#include "bakers/plan/cloud_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/light/sky_ray.h"
#include "bakers/plan/cloud_truth.h"
#include "bakers/plan/found_cloud.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plan/sheet_pictures.h"
#include "bakers/plot/chart.h"

namespace skybake {

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 36;
constexpr double kPathsOfPixel = 48;
constexpr std::size_t kMostSuns = 2;
constexpr double kTangent = 0.6;  // of half the angle of view across
constexpr double kPitch_deg = 28;

// The camera looks along +y.
std::vector<CloudView> pixels_of(const config::Cloud& cloud, const CloudRange& range,
                                 std::size_t sun) {
    const bool looks_up = range.lowest_altitude_m < range.base_m + range.height_m / 2;
    const double height_m = looks_up
                                ? std::min(range.lowest_altitude_m, range.base_m)
                                : std::max(range.highest_altitude_m, range.base_m + range.height_m);
    const double to_layer_m =
        looks_up ? range.base_m - height_m : height_m - range.base_m - range.height_m;
    const glm::dvec3 ahead = cloud_light::towards(
        (looks_up ? kPitch_deg : -kPitch_deg) / kDegreesPerRadian, std::numbers::pi / 2);
    const glm::dvec3 right = {1, 0, 0};
    const glm::dvec3 up = glm::cross(right, ahead);
    std::vector<CloudView> views;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            CloudView view;
            view.sun = sun;
            view.look = glm::normalize(ahead + right * (kTangent * (2 * (x + 0.5) / kWidth - 1)) +
                                       up * (kTangent * (kHeight - 2 * (y + 0.5)) / kWidth));
            const double way_m = to_layer_m / std::fabs(view.look.z);
            view.place = {0.5 + view.look.x * way_m / cloud.extent[0].meters,
                          view.look.y * way_m / cloud.extent[1].meters, looks_up ? 0.0 : 1.0};
            views.push_back(view);
        }
    }
    return views;
}

template <class Values>
LightPicture picture_of(const Values& value_at) {
    LightPicture picture{kWidth, kHeight, {}};
    for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
        picture.pixels.emplace_back(glm::dvec3(value_at(i)));
    }
    return picture;
}

}  // namespace

config::Outcome<std::string> cloud_sheet(const config::Cloud& cloud,
                                         const cloud_light::CloudLayer& layer,
                                         const CloudRange& range,
                                         const std::vector<BakedWay<CloudWay>>& clouds,
                                         const BakeOptions& options) {
    SheetBlock block;
    block.title = "The cloud in sunlight";
    block.rows.emplace_back("paths of light");
    for (const BakedWay<CloudWay>& shown : clouds) block.rows.push_back(full_name(*shown.way));
    const std::size_t suns = std::min(range.suns_deg.size(), kMostSuns);
    block.pictures.resize(block.rows.size() * 2 * suns);
    for (std::size_t s = 0; s < suns; ++s) {
        block.columns.push_back(fmt::format("sun at {:.3g} degrees", range.suns_deg[s]));
        block.columns.push_back(
            fmt::format("-{0:.0f} to +{0:.0f} % of white", 100 * kShownDifference));
        CloudTruth truth(layer, range, pixels_of(cloud, range, s), options);
        truth.trace(kPathsOfPixel * kWidth * kHeight);
        if (options.cancelled()) return {};
        const LightPicture traced =
            picture_of([&](std::size_t i) { return truth.light()[i].sum(); });
        const double exposure = exposure_of(traced);
        block.pictures[2 * s] = shown_picture(traced, exposure);
        CloudOfWay found(cloud, truth, options);
        for (std::size_t c = 0; c < clouds.size(); ++c) {
            const FoundCloud one = found.find(*clouds[c].way, clouds[c].assets);
            const LightPicture picture = picture_of([&](std::size_t i) { return one.radiance[i]; });
            const std::size_t at = (c + 1) * 2 * suns + 2 * s;
            block.pictures[at] = shown_picture(picture, exposure);
            block.pictures[at + 1] = exposed_difference(picture, traced, exposure);
        }
    }
    return png_bytes(contact_sheet({block}));
}

}  // namespace skybake
