#include "bakers/plan/cloud_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plan/sheet_pictures.h"
#include "bakers/plot/chart.h"

namespace skybake {

const cloud_light::CloudLayer& CloudOfWay::layer_of(const BakedAsset& asset) {
    const auto known = layers_.find(&asset);
    if (known != layers_.end()) return known->second;
    BakeOptions quiet = options_;
    quiet.progress = nullptr;
    return layers_.emplace(&asset, cloud_light::make_layer(asset.baked, 0, cloud_, quiet))
        .first->second;
}

const StoredTexture& CloudOfWay::texture_of(const BakedAsset& asset) {
    return textures_.try_emplace(&asset, asset.baked).first->second;
}

CloudTextures CloudOfWay::textures(const CloudWay& way,
                                   const std::vector<const BakedAsset*>& assets, std::size_t sun) {
    CloudTextures textures;
    textures.layer = &layer_of(*assets[0]);
    if (way.lighting == CloudLighting::march) return textures;
    std::size_t next = way.first;
    std::size_t end = assets.size();
    if (way.lighting == CloudLighting::radiance)
        textures.small_angles = &texture_of(*assets[next++]);
    if (way.lighting != CloudLighting::harmonics) {
        next += sun * way.per_sun;
        end = next + way.per_sun;
        textures.depth = &texture_of(*assets[next++]);
    }
    while (next < end) textures.parts.push_back(&texture_of(*assets[next++]));
    return textures;
}

const std::vector<MarchedRay>& CloudOfWay::marched(const CloudWay& way,
                                                   const std::vector<const BakedAsset*>& assets) {
    const auto [known, is_new] = marched_.try_emplace(way.drawing);
    if (!is_new) return known->second;
    std::vector<CloudTextures> of_suns;
    const std::vector<CloudView>& views = truth_.views();
    for (const CloudView& view : views) {
        while (of_suns.size() <= view.sun) {
            of_suns.push_back(textures(way, assets, way.per_sun > 0 ? of_suns.size() : 0));
        }
    }
    std::vector<MarchedRay>& rays = known->second;
    rays.resize(views.size());
    parallel_for(static_cast<int>(views.size()), options_.threads, [&](int i) {
        const CloudView& view = views[static_cast<std::size_t>(i)];
        rays[static_cast<std::size_t>(i)] =
            march_cloud(way, of_suns[view.sun], view.place, view.look, truth_.sun(view));
    });
    return rays;
}

FoundCloud CloudOfWay::find(const CloudWay& way, const std::vector<const BakedAsset*>& assets) {
    const std::vector<MarchedRay>& rays = marched(way, assets);
    const cloud_light::CloudLayer& layer = layer_of(*assets[0]);
    const CloudFetches fetches(layer, stride_m(way, layer),
                               way.cell > 0 ? &assets[1]->baked : nullptr, way.cell);
    FoundCloud found;
    found.radiance.resize(rays.size());
    std::vector<occupancy::MarchFetches> of_views(rays.size());
    parallel_for(static_cast<int>(rays.size()), options_.threads, [&](int n) {
        const auto i = static_cast<std::size_t>(n);
        const CloudView& view = truth_.views()[i];
        found.radiance[i] = rays[i].radiance;
        of_views[i] = fetches.along(view.place, view.look, rays[i].length_m);
    });
    const double share = 1 / static_cast<double>(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        found.densities += share * of_views[i].densities;
        found.cells += share * of_views[i].structure;
        found.lit += share * rays[i].lit;
    }
    return found;
}

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 36;
constexpr double kPathsOfPixel = 48;
constexpr std::size_t kMostSuns = 2;
constexpr double kTangent = 0.6;  // of half the angle of view across
constexpr double kPitch_deg = 28;

// The camera looks along +y.
std::vector<CloudView> pixels_of(const Cloud& cloud, const CloudRange& range, std::size_t sun) {
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
Image2<float> picture_of(const Values& value_at) {
    Image2<float> picture(kWidth, kHeight, 3);
    for (std::size_t i = 0; i < picture.texels.size(); ++i) {
        picture.texels[i] = static_cast<float>(value_at(i / 3));
    }
    return picture;
}

}  // namespace

Outcome<std::string> cloud_sheet(const Cloud& cloud, const cloud_light::CloudLayer& layer,
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
        const Image2<float> traced =
            picture_of([&](std::size_t i) { return truth.light()[i].sum(); });
        const double exposure = exposure_of(traced);
        block.pictures[2 * s] = shown_picture(traced, exposure);
        CloudOfWay found(cloud, truth, options);
        for (std::size_t c = 0; c < clouds.size(); ++c) {
            const FoundCloud one = found.find(*clouds[c].way, clouds[c].assets);
            const Image2<float> picture =
                picture_of([&](std::size_t i) { return one.radiance[i]; });
            const std::size_t at = (c + 1) * 2 * suns + 2 * s;
            block.pictures[at] = shown_picture(picture, exposure);
            block.pictures[at + 1] = exposed_difference(picture, traced, exposure);
        }
    }
    return png_bytes(contact_sheet({block}));
}

}  // namespace skybake
