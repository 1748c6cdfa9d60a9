#include "bakers/preview/make_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "bakers/preview/check_options.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/live/live_scene.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/scene_pictures.h"
#include "bakers/preview/pictures/sky_pictures.h"
#include "config/assets/asset_kind.h"

namespace skybake {
namespace {

// Returns a key of everything that the pictures of a single asset depend on.
std::string key_of(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    return fmt::format("{}\n{}\n{}\n{}\n", entry.name, entry.kind, entry.content_hash,
                       entry.parameters);
}

std::string atmosphere_key(const Recipe& recipe) {
    return config::parameters_toml(recipe,
                                   config::reads_of_light(recipe.parameters, config::Roles::all()));
}

// Returns what the recipe says on pictures.
std::string preview_key(const Recipe& recipe) {
    const std::array<std::string, 2> patterns = {"preview.*", "preview.camera.*"};
    return config::parameters_toml(recipe, patterns);
}

class Preview {
  public:
    Preview(const PreviewAssets& assets, const PreviewOptions& options)
        : assets_(assets), options_(options), encoder_(options.threads, options.memory) {}

    Outcome<PreviewPage> make() {
        page_.title = assets_.title;
        page_.notes = assets_.notes;
        if (!options_.note.empty()) page_.notes.push_back(options_.note);
        if (!add_all()) {
            encoder_.give_up();
            return {};
        }
        auto problems = encoder_.finish();
        if (!problems.empty()) return {{}, std::move(problems)};
        return {std::move(page_), {}};
    }

  private:
    // Makes all pictures, those of lit clouds first. Returns false if the user interrupts.
    bool add_all() {
        for (const PreviewAsset& asset : assets_.assets) {
            page_.assets.push_back(without_pictures(asset));
        }
        add_scene();
        if (!add_assets(true)) return false;
        if (options_.early_page && lit_pictures_of(assets_).clouds) options_.early_page(page_);
        add_sky();
        return add_assets(false);
    }

    // Makes the pictures of the cloud volumes, or of all other assets.
    bool add_assets(bool volumes) {
        for (std::size_t i = 0; i < assets_.assets.size(); ++i) {
            if (is_cancelled(options_.progress)) return false;
            const PreviewAsset& asset = assets_.assets[i];
            if ((cloud_input(assets_, asset, options_).volume != nullptr) != volumes) continue;
            begin_stage(asset.entry.name);
            page_.assets[i].pictures = pictures_of(asset);
        }
        if (volumes)
            std::ranges::move(std::move(sequences_).scenes(), std::back_inserter(page_.scenes));
        return !is_cancelled(options_.progress);
    }

    void begin_stage(const std::string& what) {
        if (options_.progress == nullptr) return;
        const int count = picture_stages(assets_.assets.size(), lit_pictures_of(assets_), options_);
        options_.progress->begin_stage(options_.stages_before + ++stage_,
                                       options_.stages_before + count, what + ", pictures");
    }

    SkyPreviewOptions sky_options() const {
        SkyPreviewOptions sky = options_.draft ? draft_sky_preview() : SkyPreviewOptions{};
        if (!options_.sun_elevations_deg.empty()) {
            sky.sun_elevations_degrees = options_.sun_elevations_deg;
        }
        sky.exposure_stops = options_.exposure_stops;
        sky.tone_curve = options_.tone_curve.value_or(ToneCurve::film);
        sky.glare = options_.glare.value_or(Glare::none);
        if (options_.altitude_m) sky.camera_altitude_km = *options_.altitude_m / 1000;
        sky.progress = options_.progress;
        sky.intermediates = options_.intermediates;
        return sky;
    }

    // Adds the pictures of all clouds in one sky. They need a sky, and the recipe for what the volumes
    // are.
    void add_scene() {
        if (!has_scene(lit_pictures_of(assets_), options_)) return;
        const std::vector<CloudPreviewInput> layers = scene_input(assets_, options_);
        begin_stage("one sky");
        std::string key = "scene\n";
        for (const CloudPreviewInput& layer : layers) key += cloud_key(layer);
        page_.scenes.push_back(
            {"One sky",
             "The picture shows all clouds of the recipe at their altitudes, in its atmosphere.",
             encoder_.encode(key, [&] { return scene_pictures(layers, options_.threads); }), true});
    }

    // Adds the pictures of the sky. They need both tables, and the recipe for how the layers
    // scatter, which neither table says.
    void add_sky() {
        const PreviewAsset* transmittance = assets_.of_kind("transmittance");
        const PreviewAsset* scattering = assets_.of_kind("multiple_scattering");
        if ((transmittance == nullptr && scattering == nullptr) || !assets_.recipe) return;
        if (transmittance == nullptr || scattering == nullptr) {
            // A sky view or an environment has pictures of its own.
            if (assets_.of_kind("sky_view") || assets_.of_kind("environment")) return;
            page_.notes.emplace_back(
                "there is no sky: it needs both a transmittance and a multiple_scattering table");
            return;
        }
        begin_stage("sky");
        const std::string key = "sky\n" + preview_key(*assets_.recipe) + key_of(*transmittance) +
                                key_of(*scattering) + atmosphere_key(*assets_.recipe);
        auto pictures = encoder_.encode(key, [&] {
            return sky_pictures(assets_.recipe->parameters.atmosphere, *transmittance, *scattering,
                                sky_options(), options_.threads);
        });
        page_.scenes.push_back(
            {"Sky",
             "The pictures show the sky as a runtime renders it: it marches rays, and takes "
             "sunlight and light scattered more than once from the baked tables.",
             std::move(pictures)});
    }

    PageAsset without_pictures(const PreviewAsset& asset) const {
        const auto plot = assets_.plots.find(asset.entry.name);
        return {asset.entry, {}, plot == assets_.plots.end() ? "" : plot->second};
    }

    std::vector<PagePicture> pictures_of(const PreviewAsset& asset) {
        CloudPreviewInput cloud = cloud_input(assets_, asset, options_);
        if (cloud.cloud != nullptr) {
            sequences_.share_exposures(cloud);
            auto pictures = encoder_.encode(
                cloud_key(cloud), [&] { return cloud_pictures(cloud, options_.threads); });
            if (cloud.frame) sequences_.take(*cloud.frame, pictures);
            return pictures;
        }
        return encoder_.encode(key_of(asset), [&] { return asset_pictures(asset); });
    }

    std::string cloud_key(const CloudPreviewInput& input) const {
        std::string key =
            "cloud\n" + preview_key(*assets_.recipe) + atmosphere_key(*assets_.recipe);
        for (const PreviewAsset* asset :
             {input.volume, input.occupancy, input.transmittance, input.multiple_scattering}) {
            key += asset != nullptr ? key_of(*asset) : "none\n";
        }
        if (input.frame) {
            key += fmt::format("frame {} of {}, {} per second, exposures {}\n", input.frame->index,
                               input.frame->count, input.frame->per_second,
                               fmt::join(input.exposures, " "));
        }
        return key;
    }

    const PreviewAssets& assets_;
    const PreviewOptions& options_;
    PictureEncoder encoder_;
    PreviewPage page_;
    SequenceScenes sequences_;
    int stage_ = 0;
};

// Makes the page that renders the assets. Its pictures are those of a draft, for browsers that
// cannot; a draft has none, because it is to be there at once, as is the page itself.
Outcome<PreviewPage> make_live_preview(const PreviewAssets& assets, const PreviewOptions& options) {
    auto scene = live_scene(assets, options);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    Outcome<PreviewPage> page{PreviewPage(), {}};
    page.value->title = assets.title;
    page.value->live_scene = *scene.value;
    if (!options.draft) {
        if (options.early_page) options.early_page(*page.value);
        PreviewOptions stills = options;
        stills.draft = true;
        stills.memory = nullptr;
        stills.early_page = nullptr;
        page = Preview(assets, stills).make();
        if (!page.value) return page;
        for (PageAsset& asset : page.value->assets) {
            std::erase_if(asset.pictures, [](const PagePicture& picture) {
                return picture.kind != PictureKind::scene;
            });
        }
    }
    page.value->title = assets.title;
    page.value->live_scene = std::move(*scene.value);
    return page;
}

}  // namespace

int picture_stages(std::size_t assets, const LitPictures& lit, const PreviewOptions& options) {
    return static_cast<int>(assets) + (lit.sky ? 1 : 0) + (has_scene(lit, options) ? 1 : 0);
}

bool has_scene(const LitPictures& lit, const PreviewOptions& options) {
    return lit.sky && lit.clouds && !lit.sweep && !options.single && options.turntable == 0;
}

std::vector<Need> needs_of_pictures(const Recipe& recipe) {
    const auto has = [&recipe](std::string_view kind) {
        return std::ranges::any_of(recipe.parameters.bakes, [kind](const Bake& bake) {
            return config::kind_of(bake).facts.name == kind;
        });
    };
    if (!has("transmittance") || !has("multiple_scattering")) return {};
    return needs_of_sky_pictures(recipe.parameters.atmosphere);
}

Outcome<PreviewPage> make_preview(const PreviewAssets& assets, const PreviewOptions& options) {
    auto unused = unused_options(lit_pictures_of(assets), options);
    if (!unused.empty()) return {{}, std::move(unused)};
    auto complete =
        completed(options, assets.recipe ? &*assets.recipe : nullptr, lit_pictures_of(assets));
    if (!complete.value) return {{}, complete.diagnostics};
    std::shared_ptr<PictureLight>& light = complete.value->light;
    if (light == nullptr) light = std::make_shared<PictureLight>(options.intermediates);
    if (options.live) return make_live_preview(assets, *complete.value);
    if (auto problem = camera_above_air(assets, *complete.value)) return std::move(*problem);
    Outcome<PreviewPage> page = Preview(assets, *complete.value).make();
    for (Diagnostic& warning : clouds_cut_by_tile(assets, *complete.value)) {
        if (page.value) page.value->notes.push_back(warning.message);
        page.diagnostics.push_back(std::move(warning));
    }
    return page;
}

}  // namespace skybake
