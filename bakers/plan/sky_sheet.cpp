#include "bakers/plan/sky_sheet.h"

#include <fmt/format.h>

#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plan/sheet_pictures.h"
#include "bakers/plot/chart.h"
#include "bakers/render/sky_view.h"
#include "config/assets/bruneton.h"

namespace skybake {
namespace {

AssetPlaces places_of(const Parameters& parameters, const BakedAsset& asset) {
    return baker_of(*asset.bake).places(parameters, *asset.bake, stored_texels(asset.baked));
}

}  // namespace

std::vector<Spectrum> SkyOfWay::find(const SkyWay& way,
                                     const std::vector<const BakedAsset*>& assets,
                                     double& fetches) const {
    switch (way.how) {
        case config::SkyBy::march:
            return march(way, assets, fetches);
        case config::SkyBy::fetch:
            fetches = 2;  // of the two sub-images next to the angle to the sun
            return fetch(*assets.front());
        case config::SkyBy::picture:
            fetches = 1;
            return look_up(*assets.front());
    }
    return {};
}

std::vector<Spectrum> SkyOfWay::march(const SkyWay& way,
                                      const std::vector<const BakedAsset*>& assets,
                                      double& fetches) const {
    std::vector<PreviewAsset> stored;
    for (const BakedAsset* asset : assets) {
        stored.push_back({describe(asset->baked), asset->baked.image(), {}});
    }
    const bool is_single = stored.size() == 1;
    const auto tables = make_sky_tables(stored[0], is_single ? nullptr : &stored[1]);
    fetches = way.steps * (is_single ? 1.0 : 1.0 + moment_count(tables.value->degree));
    // The views show the air alone.
    SkyMedium over_black_ground = truth_.medium();
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    const Shell shell = shell_of(over_black_ground.air);
    std::vector<SkyRay> rays;
    for (const SkySample& view : truth_.views()) {
        rays.push_back(camera_ray(shell, view.altitude_km, view.sun, view.direction).in_air);
    }
    return truth_.as_compared(
        march_sky(over_black_ground, *tables.value, rays, way.steps, threads_));
}

std::vector<Spectrum> SkyOfWay::fetch(const BakedAsset& asset) const {
    const auto& bake = asset.bake->as<BrunetonBake>();
    return sky_of_scattering({truth_.air()}, bake, places_of(parameters_, asset), truth_.views())(
        asset.baked, threads_);
}

// The picture of the view's sun has no parallax, so that cameras at other altitudes see
// it where the same share of their sky is.
std::vector<Spectrum> SkyOfWay::look_up(const BakedAsset& asset) const {
    std::vector<Place> at;
    for (const SkySample& view : truth_.views()) {
        at.push_back({{"azimuth_deg", view.azimuth_deg},
                      {"above_horizon_deg", view.above_horizon_deg},
                      {"sun_elevation_deg", view.sun_elevation_deg}});
    }
    const auto places = [&](const StoredTexels&) { return places_of(parameters_, asset); };
    return light_looked_up(places, std::move(at))(asset.baked, threads_);
}

namespace {

// Half a picture, from the sun to the point opposite to it; the other half is its mirror image.
constexpr int kHalfWidth = 32;
constexpr int kHeight = 24;
constexpr double kPaths = 1 << 19;
constexpr std::size_t kMostSuns = 3;

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
    Screen(const Parameters& parameters, bool has_colors)
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

// Returns the picture of the sky under one of the suns, both halves of it.
LightPicture sky_under(const std::vector<glm::dvec3>& colors, std::size_t sun) {
    LightPicture sky{2 * kHalfWidth, kHeight, {}};
    const std::size_t first = sun * static_cast<std::size_t>(kHalfWidth * kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < sky.width; ++x) {
            const int half = x < kHalfWidth ? kHalfWidth - 1 - x : x - kHalfWidth;
            sky.pixels.push_back(colors[first + static_cast<std::size_t>(y * kHalfWidth + half)]);
        }
    }
    return sky;
}

}  // namespace

Outcome<std::string> sky_sheet(const Parameters& parameters, const SceneRange& range,
                               const std::vector<BakedWay<SkyWay>>& skies,
                               const std::vector<glm::dvec3>& weights, const BakeOptions& options) {
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
        const LightPicture sky = sky_under(traced, s);
        block.pictures.push_back(shown_picture(sky, exposure_of(sky)));
        block.pictures.emplace_back();
    }
    const SkyOfWay found(parameters, truth, options.threads);
    for (const BakedWay<SkyWay>& sky : skies) {
        double fetches = 0;
        const auto colors = screen.colors(found.find(*sky.way, sky.assets, fetches));
        block.rows.push_back(full_name(*sky.way));
        for (std::size_t s = 0; s < suns.size(); ++s) {
            const LightPicture wanted = sky_under(traced, s);
            const LightPicture one = sky_under(colors, s);
            block.pictures.push_back(shown_picture(one, exposure_of(wanted)));
            block.pictures.push_back(difference_picture(one, wanted));
        }
    }
    return png_bytes(contact_sheet({block}));
}

}  // namespace skybake
