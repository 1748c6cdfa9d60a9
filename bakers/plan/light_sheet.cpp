#include "bakers/plan/light_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

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
#include "config/text/mapped.h"

namespace skybake {
namespace {

AssetPlaces places_of(const Parameters& parameters, const BakedAsset& asset) {
    return baker_of(*asset.bake).places(parameters, *asset.bake, stored_texels(asset.baked));
}

// Half a picture, from the sun to the point opposite to it; the other half is its mirror image.
constexpr int kHalfWidth = 32;
constexpr double kPicturePaths = 1 << 19;

// The elevations that a picture shows, in rows of equal height.
struct Band {
    double lowest_deg = -90;
    double highest_deg = 90;
    int rows = 32;
};

Band band_of(config::Draws light, const Shell& shell, double altitude_km) {
    if (light == config::Draws::distance) return {-kMostTilt_deg, kMostTilt_deg, 20};
    if (light == config::Draws::surroundings) return {};
    return {-SkyViewCamera(shell, altitude_km).dip() * kDegreesPerRadian, 90, 24};
}
constexpr std::size_t kMostSunsOfSheet = 3;

std::vector<double> suns_of(const SceneRange& range) {
    std::vector<double> suns = range.suns_deg;
    if (suns.size() > kMostSunsOfSheet) suns.resize(kMostSunsOfSheet);
    if (!suns.empty()) return suns;
    for (const double share : {0.7, 0.25, 0.05}) {
        suns.push_back(range.lowest_sun_deg +
                       share * (range.highest_sun_deg - range.lowest_sun_deg));
    }
    return suns;
}

std::vector<LightView> views_of(const SceneRange& range, const Shell& shell, double altitude_km,
                                const Band& band, const std::vector<double>& suns_deg) {
    std::vector<LightView> views;
    for (const double sun_deg : suns_deg) {
        for (int y = 0; y < band.rows; ++y) {
            const double elevation_deg = band.lowest_deg + (band.highest_deg - band.lowest_deg) *
                                                               (band.rows - y - 0.5) / band.rows;
            for (int x = 0; x < kHalfWidth; ++x) {
                views.push_back(light_view(range, shell, altitude_km, sun_deg, elevation_deg,
                                           180 * (x + 0.5) / kHalfWidth, 1));
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
Image2<float> sky_under(const std::vector<glm::dvec3>& colors, int rows, std::size_t sun) {
    Image2<float> sky(2 * kHalfWidth, rows, 3);
    const std::size_t first = sun * static_cast<std::size_t>(kHalfWidth * rows);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < sky.width; ++x) {
            const int half = x < kHalfWidth ? kHalfWidth - 1 - x : x - kHalfWidth;
            const glm::vec3 color(colors[first + static_cast<std::size_t>(y * kHalfWidth + half)]);
            std::copy_n(glm::value_ptr(color), 3, sky.texel(x, y));
        }
    }
    return sky;
}

}  // namespace

std::vector<Spectrum> LightOfWay::find(const LightWay& way,
                                       const std::vector<const BakedAsset*>& assets) const {
    switch (way.how) {
        case config::SkyBy::march:
            return march(way, assets);
        case config::SkyBy::fetch:
            return fetch(*assets.front());
        case config::SkyBy::picture:
            return look_up(way, assets);
    }
    return {};
}

std::vector<Spectrum> LightOfWay::march(const LightWay& way,
                                        const std::vector<const BakedAsset*>& assets) const {
    auto stored = mapped<PreviewAsset>(assets, [&](const BakedAsset* asset) {
        return PreviewAsset{describe(asset->baked), asset->baked.image(), {}};
    });
    const auto tables = make_sky_tables(stored[0], stored.size() == 1 ? nullptr : &stored[1]);
    // The views show the air alone.
    SkyMedium over_black_ground = truth_.packets().front()->medium();
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    const Shell shell = shell_of(over_black_ground.air);
    const bool has_things = truth_.what() == config::Draws::distance;
    std::vector<SkyRay> rays;
    std::vector<double> reaches_km;
    for (const auto& [sky, distance_km] : truth_.views()) {
        rays.push_back(sky_ray(shell, sky.altitude_km, sky.sun, sky.direction));
        if (has_things) reaches_km.push_back(distance_km);
    }
    return truth_.as_compared(
        march_sky(over_black_ground, *tables.value, rays, way.steps, threads_, reaches_km));
}

std::vector<Spectrum> LightOfWay::fetch(const BakedAsset& asset) const {
    const auto& bake = asset.bake->as<BrunetonBake>();
    const auto skies = mapped<SkySample>(truth_.views(), &LightView::sky);
    return sky_of_scattering(truth_.packets(), bake, places_of(parameters_, asset), skies)(
        asset.baked, threads_);
}

std::vector<Spectrum> LightOfWay::look_up(const LightWay& way,
                                          const std::vector<const BakedAsset*>& assets) const {
    std::vector<std::vector<Place>> at(assets.size());
    std::vector<std::vector<std::size_t>> views(assets.size());
    for (std::size_t i = 0; i < truth_.views().size(); ++i) {
        Reading reading = way.reads(truth_.views()[i]);
        at[reading.asset].push_back(std::move(reading.at));
        views[reading.asset].push_back(i);
    }
    std::vector<Spectrum> light(truth_.views().size());
    for (std::size_t a = 0; a < assets.size(); ++a) {
        const auto places = [&](const StoredTexels&) { return places_of(parameters_, *assets[a]); };
        const auto found = light_looked_up(places, std::move(at[a]))(assets[a]->baked, threads_);
        for (std::size_t i = 0; i < found.size(); ++i) light[views[a][i]] = found[i];
    }
    return light;
}

Outcome<std::string> light_sheet(config::Draws light, const Parameters& parameters,
                                 const SceneRange& range,
                                 const std::vector<BakedWay<LightWay>>& ways,
                                 const std::vector<glm::dvec3>& weights,
                                 const BakeOptions& options) {
    if (light == config::Draws::ground_light) return {std::string(), {}};
    const std::vector<double> suns = suns_of(range);
    const Shell shell = shell_of(parameters.atmosphere);
    const double altitude_km = (range.lowest_altitude_km + range.highest_altitude_km) / 2;
    const Band band = band_of(light, shell, altitude_km);
    SceneTruth truth(light, parameters, views_of(range, shell, altitude_km, band, suns), weights,
                     options);
    truth.trace(kPicturePaths);
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
        const Image2<float> sky = sky_under(traced, band.rows, s);
        block.pictures.push_back(shown_picture(sky, exposure_of(sky)));
        block.pictures.emplace_back();
    }
    const LightOfWay found(parameters, truth, options.threads);
    for (const BakedWay<LightWay>& way : ways) {
        const auto colors = screen.colors(found.find(*way.way, way.assets));
        block.rows.push_back(full_name(*way.way));
        for (std::size_t s = 0; s < suns.size(); ++s) {
            const Image2<float> wanted = sky_under(traced, band.rows, s);
            const Image2<float> one = sky_under(colors, band.rows, s);
            block.pictures.push_back(shown_picture(one, exposure_of(wanted)));
            block.pictures.push_back(difference_picture(one, wanted));
        }
    }
    return png_bytes(contact_sheet({block}));
}

}  // namespace skybake
