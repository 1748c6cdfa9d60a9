#include "bakers/preview/make_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "bakers/preview/check_options.h"
#include "bakers/preview/complete_options.h"
#include "bakers/preview/live/live_scene.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/sky_pictures.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"

namespace skybake {
namespace {

using config::Outcome;

// Returns a key of everything that the pictures of a single asset depend on.
std::string key_of(const PreviewAsset& asset) {
    const ManifestAsset& entry = asset.entry;
    return fmt::format("{}\n{}\n{}\n{}\n", entry.name, entry.kind, entry.content_hash,
                       entry.parameters);
}

std::string atmosphere_key(const config::Recipe& recipe) {
    return config::parameters_toml(recipe,
                                   config::reads_of_air(recipe.parameters, config::Roles::all()));
}

// Returns what the recipe says on pictures.
std::string preview_key(const config::Recipe& recipe) {
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
        sky.tone_curve = options_.tone_curve.value_or(ToneCurve::exponential);
        sky.glare = options_.glare.value_or(Glare::eye);
        if (options_.altitude_m) sky.camera_altitude_km = *options_.altitude_m / 1000;
        sky.progress = options_.progress;
        sky.intermediates = options_.intermediates;
        return sky;
    }

    // Adds the pictures of the sky. They need both tables, and the recipe for how the layers
    // scatter, which neither table says.
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
        const std::string key = "sky\n" + preview_key(*assets_.recipe) + key_of(*transmittance) +
                                key_of(*scattering) + atmosphere_key(*assets_.recipe);
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
        std::string key =
            "cloud\n" + preview_key(*assets_.recipe) + atmosphere_key(*assets_.recipe);
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

std::vector<Need> needs_of_pictures(const config::Recipe& recipe) {
    const auto has = [&recipe](std::string_view kind) {
        return std::any_of(
            recipe.parameters.bakes.begin(), recipe.parameters.bakes.end(),
            [kind](const config::Bake& bake) { return config::kind_of(bake).facts.name == kind; });
    };
    if (!has("transmittance") || !has("multiple_scattering")) return {};
    return needs_of_sky_pictures(recipe.parameters.atmosphere);
}

namespace {

// Makes the page that renders the assets. Its pictures are those of a draft, for browsers that
// cannot; a draft has none, because it is to be there at once.
Outcome<PreviewPage> make_live_preview(const PreviewAssets& assets, const PreviewOptions& options) {
    auto scene = live_scene(assets, options);
    if (!scene.value) return {{}, std::move(scene.diagnostics)};
    Outcome<PreviewPage> page{PreviewPage(), {}};
    if (!options.draft) {
        PreviewOptions stills = options;
        stills.draft = true;
        stills.memory = nullptr;
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

Outcome<PreviewPage> make_preview(const PreviewAssets& assets, const PreviewOptions& options) {
    auto unused = unused_options(lit_pictures_of(assets), options);
    if (!unused.empty()) return {{}, std::move(unused)};
    const auto complete =
        completed(options, assets.recipe ? &*assets.recipe : nullptr, lit_pictures_of(assets));
    if (!complete.value) return {{}, complete.diagnostics};
    if (options.live) return make_live_preview(assets, *complete.value);
    if (auto problem = camera_above_air(assets, *complete.value))
        return {{}, {std::move(*problem)}};
    return Preview(assets, *complete.value).make();
}

namespace {

using config::CloudVolumeBake;
using config::OccupancyBake;

template <class Section>
const Section* section_named(const config::Parameters& parameters, const std::string& name) {
    for (const config::Bake& bake : parameters.bakes) {
        if (bake.name == name) return bake.find<Section>();
    }
    return nullptr;
}

const config::Cloud* cloud_of(const config::Parameters& parameters, const CloudVolumeBake* bake) {
    const auto cloud =
        std::find_if(parameters.clouds.begin(), parameters.clouds.end(),
                     [&](const config::Cloud& one) { return bake && one.name == bake->cloud; });
    return cloud == parameters.clouds.end() ? nullptr : &*cloud;
}

void add_occupancy(const PreviewAssets& assets, CloudPreviewInput& input) {
    const config::Parameters& parameters = assets.recipe->parameters;
    for (const PreviewAsset& asset : assets.assets) {
        const auto* bake = section_named<OccupancyBake>(parameters, asset.entry.name);
        if (bake == nullptr || bake->of != input.volume->entry.name || asset.voxels.empty())
            continue;
        input.occupancy = &asset;
        input.occupancy_bake = bake;
        return;
    }
}

void add_sky(const PreviewAssets& assets, CloudPreviewInput& input) {
    input.transmittance = assets.of_kind("transmittance");
    input.multiple_scattering = assets.of_kind("multiple_scattering");
    input.atmosphere = &assets.recipe->parameters.atmosphere;
}

void choose_light(const PreviewOptions& options, CloudPreviewInput& input) {
    const double azimuth = options.sun_azimuth_deg.value_or(input.suns.front().azimuth_degrees);
    std::vector<double> elevations = options.sun_elevations_deg;
    if (elevations.empty()) elevations = {input.suns.front().elevation_degrees};
    input.suns.clear();
    for (const double elevation : elevations) input.suns.push_back({elevation, azimuth});
    input.exposure_stops = options.exposure_stops;
    input.tone_curve = options.tone_curve.value_or(ToneCurve::exponential);
}

// Chooses the camera and the size of pictures. For a draft, the size is at most 768 along its
// longer edge; the draft then has half of it.
void choose_frame(const PreviewOptions& options, CloudPreviewInput& input) {
    constexpr int longest_of_draft = 768;
    if (options.camera) input.camera = *options.camera;
    if (options.picture_size) {
        input.width = (*options.picture_size)[0];
        input.height = (*options.picture_size)[1];
    }
    input.single = options.single || options.turntable > 0;
    input.turntable = options.turntable;
    input.progress = options.progress;
    input.draft = options.draft;
    const int longest = std::max(input.width, input.height);
    if (!options.draft || longest <= longest_of_draft) return;
    input.width = std::max(input.width * longest_of_draft / longest, 1);
    input.height = std::max(input.height * longest_of_draft / longest, 1);
}

}  // namespace

CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options) {
    CloudPreviewInput input;
    if (!assets.recipe || asset.voxels.empty()) return input;
    const config::Parameters& parameters = assets.recipe->parameters;
    const std::string& name = asset.entry.name;
    if (const auto* grid = section_named<OccupancyBake>(parameters, name)) {
        input.volume_bake = section_named<CloudVolumeBake>(parameters, grid->of);
        input.cloud = cloud_of(parameters, input.volume_bake);
        input.occupancy = &asset;
        input.occupancy_bake = grid;
    } else if (const auto* volume = section_named<CloudVolumeBake>(parameters, name)) {
        input.volume_bake = volume;
        input.cloud = cloud_of(parameters, volume);
        input.volume = &asset;
        add_occupancy(assets, input);
        add_sky(assets, input);
    }
    choose_light(options, input);
    choose_frame(options, input);
    return input;
}

}  // namespace skybake
