#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>

#include "bakers/plot/chart.h"
#include "bakers/render/screen_color.h"
#include "bakers/render/tone_curve.h"
#include "config/assets/aerial_perspective.h"
#include "config/assets/environment.h"
#include "config/assets/irradiance.h"
#include "config/assets/sky_view.h"
#include "config/recipe/asset_parameters.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

constexpr int view_width = 512;
constexpr int slice_width = 240;
constexpr int shown_slices = 4;

template <class Asset>
std::optional<Asset> bake_of(const ManifestAsset& entry) {
    return config::recorded_bake<Asset>(entry.parameters, entry.name);
}

// Returns a picture of an asset's texels as linear sRGB.
Image2<float> shown(const PreviewAsset& asset, const Image2<float>& light) {
    return ScreenColor(asset.entry.conventions, light.channels).shown(light);
}

// Returns the angle above the horizon at a place between the first and the last row
// (sky_view_mapping.h).
double angle_above_horizon(const AxisMapping& axis, double y) {
    const double centred = 2 * y - 1;
    return (centred < 0 ? axis.first : axis.last) * centred * centred;
}

// --- Volumes ------------------------------------------------------------------------------------

// Draws shares in [0, 1] as a screen shows light, with the sRGB curve.
Picture as_shares(const Image2<float>& shares) {
    Picture picture(shares.width, shares.height);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const std::size_t texel = i / 3 * static_cast<std::size_t>(shares.channels);
        const double value =
            std::clamp(double{shares.texels[texel + (shares.channels == 3 ? i % 3 : 0)]}, 0.0, 1.0);
        const double encoded =
            value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
        picture.rgb[i] = static_cast<std::uint8_t>(255 * encoded + 0.5);
    }
    return picture;
}

class AerialPictures {
  public:
    AerialPictures(const PreviewAsset& asset, const config::AerialPerspectiveBake& bake)
        : asset_(asset), bake_(bake) {
        const int slices = asset.entry.size[2];
        for (int i = 1; i <= shown_slices; ++i) {
            const int z = std::max(slices * i / shown_slices - 1, 0);
            if (slices_.empty() || z != slices_.back()) slices_.push_back(z);
        }
    }

    std::vector<PreviewPicture> make() const {
        const auto channels = static_cast<int>(asset_.entry.channels.size());
        std::vector<PreviewPicture> pictures;
        if (bake_.content == config::AerialContent::transmittance) {
            pictures.push_back(transmittance(0, channels));
            return pictures;
        }
        const bool both = bake_.content == config::AerialContent::in_scatter_and_transmittance;
        pictures.push_back(light(both ? channels - 1 : channels));
        if (both) pictures.push_back(transmittance(channels - 1, 1));
        return pictures;
    }

  private:
    double distance_km(int z) const {
        const double w = (z + 0.5) / asset_.entry.size[2];
        const bool squared = bake_.slices == config::SliceSpacing::squared;
        return asset_.entry.axes[2].last * (squared ? w * w : w);
    }

    Picture sheet(const std::vector<Picture>& pictures) const {
        std::vector<std::string> captions;
        for (const int z : slices_) {
            const bool from_air = bake_.slices_begin == config::SlicesBegin::air;
            captions.push_back(fmt::format("slice {}: {}{:.3g} km", z, from_air ? "at most " : "",
                                           distance_km(z)));
        }
        return contact_sheet(pictures, captions, 2);
    }

    PreviewPicture light(int channels) const {
        const auto slice = [&](int z) { return shown(asset_, slice_of(asset_, z, 0, channels)); };
        const double exposure = exposure_for(slice(slices_.back()));
        auto pictures = mapped<Picture>(slices_, [&](const int z) {
            return tone_mapped(fitted(slice(z), slice_width, 2 * slice_width), exposure);
        });
        return {
            asset_.entry.name + "_light", asset_.entry.name + ": light added by the air",
            fmt::format("The slices show the camera's picture, upright; {}.", tone_text(exposure)),
            sheet(pictures), exposure};
    }

    PreviewPicture transmittance(int first, int count) const {
        const auto pictures = mapped<Picture>(slices_, [&](const int z) {
            return as_shares(
                fitted(slice_of(asset_, z, first, count), slice_width, 2 * slice_width));
        });
        return {asset_.entry.name + "_transmittance", asset_.entry.name + ": transmittance",
                "The slices show the camera's picture, upright; white is 1, black is 0.",
                sheet(pictures)};
    }

    const PreviewAsset& asset_;
    const config::AerialPerspectiveBake& bake_;
    std::vector<int> slices_;
};

using EnvironmentMapping = config::EnvironmentMapping;

// Returns the axes of an environment's texels. Those of a cube and of an octahedron are no angles.
std::array<ChartAxis, 2> environment_axes(EnvironmentMapping mapping) {
    if (mapping != EnvironmentMapping::longitude_latitude) {
        return {linear_axis("u", 0, 1), linear_axis("1 − v", 0, 1)};
    }
    return {ChartAxis{"azimuth from straight ahead (deg)", [](double t) { return 360 * t - 180; },
                      AxisTicks::angles},
            ChartAxis{"elevation (deg)", [](double t) { return 180 * t - 90; }, AxisTicks::angles}};
}

// Says where directions are in the file.
std::string_view environment_layout(EnvironmentMapping mapping) {
    if (mapping == EnvironmentMapping::cube) {
        return ", with the faces right, left, up, down, ahead and behind from the top";
    }
    if (mapping != EnvironmentMapping::longitude_latitude) {
        return ", with the zenith in the middle and straight down in the corners";
    }
    return ", with straight ahead in the middle";
}

std::string sun_of_environment(const config::EnvironmentBake& bake) {
    const double degrees = bake.sun_azimuth.radians * 180 / std::numbers::pi;
    const std::string place = degrees == 0
                                  ? "straight ahead"
                                  : fmt::format("{:.4g} degrees to the {}", std::fabs(degrees),
                                                degrees > 0 ? "right" : "left");
    return fmt::format(" The sun is {}; its disc is {}in the file.", place,
                       bake.sun == config::SunInMap::disc ? "" : "not ");
}

}  // namespace

std::vector<PreviewPicture> sky_view_pictures(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    const auto bake = bake_of<config::SkyViewBake>(entry);
    const int rows = bake ? bake->size[1] : 0;
    const bool fits = bake && asset.table.width > 0 && entry.axes.size() == 2 &&
                      asset.table.height == rows * static_cast<int>(bake->sun_elevations.size());
    std::vector<Image2<float>> views;
    for (std::size_t k = 0; fits && k < bake->sun_elevations.size(); ++k) {
        views.push_back(shown(asset, upwards(asset.table, static_cast<int>(k) * rows, rows)));
    }
    // The brightest sky is taken for one by day.
    const auto exposures =
        mapped<double>(views, [](const Image2<float>& view) { return sky_exposure_for(view); });
    std::vector<PreviewPicture> pictures;
    for (std::size_t k = 0; k < views.size(); ++k) {
        const Image2<float>& view = views[k];
        const double exposure =
            exposures[k] * dimming(*std::ranges::min_element(exposures) / exposures[k]);
        const double sun = bake->sun_elevations[k].radians * 180 / std::numbers::pi;
        const std::string title = fmt::format("{}: {}", entry.name, sun_text(sun));
        const ChartAxis azimuth{"azimuth from the sun (deg)", [](double t) { return 180 * t; },
                                AxisTicks::angles};
        const ChartAxis angle{
            "above the horizon (deg)",
            [axis = entry.axes[1]](double t) { return angle_above_horizon(axis, t); },
            AxisTicks::angles};
        pictures.push_back(
            {fmt::format("{}_{}", entry.name, sun_stem(sun)), title,
             fmt::format(
                 "The picture shows the texels of this sun; {}. The sun's disc is not in them.",
                 tone_text(exposure)),
             framed(tone_mapped(fitted(view, view_width, 2 * view_width), exposure), title, azimuth,
                    angle),
             exposure});
    }
    return pictures;
}

std::vector<PreviewPicture> irradiance_pictures(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    const auto bake = bake_of<config::IrradianceBake>(entry);
    if (!bake || asset.table.width <= 0 || asset.table.height <= 0 || entry.axes.size() != 2) {
        return {};
    }
    const Image2<float> view = shown(asset, upwards(asset.table, 0, asset.table.height));
    const double exposure = exposure_for(view);
    const std::string title =
        fmt::format("{}: {} × {} texels", entry.name, asset.table.width, asset.table.height);
    const bool twilight = bake->mapping == config::MultipleScatteringMapping::twilight;
    const ChartAxis sun{"cosine of the sun's zenith angle",
                        [twilight](double t) {
                            const double centred = 2 * t - 1;
                            return twilight ? centred * std::fabs(centred) : centred;
                        },
                        AxisTicks::decimal};
    const ChartAxis altitude{"altitude (km)",
                             [top = entry.axes[1].last](double t) { return t * t * top; },
                             AxisTicks::decimal};
    return {
        {entry.name + "_texels", title,
         fmt::format("The picture shows the file's texels, with its first row at the bottom; {}.",
                     tone_text(exposure)),
         framed(tone_mapped(fitted(view, view_width, 2 * view_width), exposure), title, sun,
                altitude),
         exposure}};
}

std::vector<PreviewPicture> environment_pictures(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    const auto bake = bake_of<config::EnvironmentBake>(entry);
    if (!bake || asset.table.width <= 0 || asset.table.height <= 0) return {};
    const Image2<float> view = shown(asset, asset.table);
    const double exposure = sky_exposure_for(view);
    const std::string title =
        fmt::format("{}: {} × {} texels", entry.name, asset.table.width, asset.table.height);
    const auto [across, up] = environment_axes(bake->mapping);
    return {
        {entry.name + "_texels", title,
         fmt::format("The picture shows the file upright{}; {}.{}",
                     environment_layout(bake->mapping), tone_text(exposure),
                     sun_of_environment(*bake)),
         framed(tone_mapped(fitted(view, view_width, 2 * view_width), exposure), title, across, up),
         exposure}};
}

std::vector<PreviewPicture> aerial_pictures(const PreviewAsset& asset) {
    const auto bake = bake_of<config::AerialPerspectiveBake>(asset.entry);
    if (!bake || !has_all_texels(asset)) return {};
    return AerialPictures(asset, *bake).make();
}

}  // namespace skybake
