#include "bakers/preview/make_preview.h"

#include <fmt/format.h>

#include <utility>

#include "bakers/preview/check_options.h"
#include "bakers/preview/cloud_input.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/pictures/sky_pictures.h"
#include "config/assets/reads.h"

namespace skybake {
namespace {

using config::Outcome;

// Everything that pictures of an asset alone depend on.
std::string key_of(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    return fmt::format("{}\n{}\n{}\n{}\n", entry.name, entry.kind, entry.content_hash,
                       entry.parameters);
}

std::string atmosphere_key(const config::Recipe& recipe) {
    return config::parameters_toml(recipe,
                                   config::reads_of_air(recipe.parameters, config::Roles::all()));
}

class Preview {
  public:
    Preview(const PreviewAssets& assets, const PreviewOptions& options)
        : assets_(assets), options_(options), encoder_(options.threads, options.memory) {}

    Outcome<PreviewPage> make() {
        page_.title = assets_.title;
        page_.notes = assets_.notes;
        add_sky();
        for (const PreviewAsset& asset : assets_.assets) {
            if (is_cancelled(options_.progress)) return {};
            begin_stage(asset.entry.name);
            add(asset);
        }
        if (is_cancelled(options_.progress)) return {};
        auto problems = encoder_.finish();
        if (!problems.empty()) return {{}, std::move(problems)};
        return {std::move(page_), {}};
    }

  private:
    void begin_stage(const std::string& what) {
        if (options_.progress == nullptr) return;
        const int count = picture_stages(assets_.assets.size(), lit_pictures_of(assets_));
        options_.progress->begin_stage(options_.stages_before + ++stage_,
                                       options_.stages_before + count, what + ", pictures");
    }

    SkyPreviewOptions sky_options() const {
        SkyPreviewOptions sky = options_.draft ? draft_sky_preview() : SkyPreviewOptions{};
        if (!options_.sun_elevations_deg.empty()) {
            sky.sun_elevations_degrees = options_.sun_elevations_deg;
        }
        sky.exposure_stops = options_.exposure_stops;
        if (options_.altitude_m) sky.camera_altitude_km = *options_.altitude_m / 1000;
        sky.progress = options_.progress;
        return sky;
    }

    // The sky takes both tables, and how the layers scatter, which neither table says.
    void add_sky() {
        const PreviewAsset* transmittance = assets_.of_kind("transmittance");
        const PreviewAsset* scattering = assets_.of_kind("multiple_scattering");
        if ((transmittance == nullptr && scattering == nullptr) || !assets_.recipe) return;
        if (transmittance == nullptr || scattering == nullptr) {
            page_.notes.emplace_back(
                "there is no sky: it needs both a transmittance and a multiple_scattering table");
            return;
        }
        begin_stage("sky");
        const std::string key = "sky\n" + key_of(*transmittance) + key_of(*scattering) +
                                atmosphere_key(*assets_.recipe);
        auto pictures = encoder_.encode(key, [&] {
            return sky_pictures(assets_.recipe->parameters.atmosphere, *transmittance, *scattering,
                                sky_options(), options_.threads);
        });
        page_.scenes.push_back(
            {"Sky",
             "The sky as a runtime renders it: it marches rays, and takes sunlight and light "
             "scattered more than once from the baked tables.",
             std::move(pictures)});
    }

    void add(const PreviewAsset& asset) {
        const auto plot = assets_.plots.find(asset.entry.name);
        page_.assets.push_back(
            {asset.entry, pictures_of(asset), plot == assets_.plots.end() ? "" : plot->second});
    }

    std::vector<PagePicture> pictures_of(const PreviewAsset& asset) {
        const CloudPreviewInput cloud = cloud_input(assets_, asset, options_);
        if (cloud.cloud != nullptr) {
            return encoder_.encode(cloud_key(cloud),
                                   [&] { return cloud_pictures(cloud, options_.threads); });
        }
        return encoder_.encode(key_of(asset), [&] { return asset_pictures(asset); });
    }

    std::string cloud_key(const CloudPreviewInput& input) const {
        std::string key = "cloud\n" + atmosphere_key(*assets_.recipe);
        for (const PreviewAsset* asset :
             {input.volume, input.occupancy, input.transmittance, input.multiple_scattering}) {
            key += asset != nullptr ? key_of(*asset) : "none\n";
        }
        return key;
    }

    const PreviewAssets& assets_;
    const PreviewOptions& options_;
    PictureEncoder encoder_;
    PreviewPage page_;
    int stage_ = 0;
};

}  // namespace

int picture_stages(std::size_t assets, const LitPictures& lit) {
    return static_cast<int>(assets) + (lit.sky ? 1 : 0);
}

Outcome<PreviewPage> make_preview(const PreviewAssets& assets, const PreviewOptions& options) {
    auto unused = unused_options(lit_pictures_of(assets), options);
    if (!unused.empty()) return {{}, std::move(unused)};
    if (auto problem = camera_above_air(assets, options)) return {{}, {std::move(*problem)}};
    return Preview(assets, options).make();
}

}  // namespace skybake
