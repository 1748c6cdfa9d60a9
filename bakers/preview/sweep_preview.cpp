#include "bakers/preview/sweep_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "bakers/air/medium.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/check_options.h"
#include "bakers/preview/cloud_inputs.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/load_sweep.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/sweep_sheet.h"
#include "bakers/preview/sweep_table.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/sky_view.h"
#include "bakers/render/tone_curve.h"

namespace skybake {

// --- One picture ---------------------------------------------------------------------------------

namespace {

struct Thumbnail {
    Picture picture;
    std::string light;  // exposure, tone curve and sun of a picture of light, else empty
};

constexpr std::array<int, 2> telling_size = {384, 216};

std::array<int, 2> size_of(const PreviewOptions& options) {
    return options.picture_size.value_or(telling_size);
}

ToneCurve curve_of(const PreviewOptions& options) {
    return options.tone_curve.value_or(ToneCurve::film);
}

std::string light_words(const PreviewOptions& options, double exposure,
                        double sun_elevation_degrees) {
    return fmt::format("{}, the {}", tone_text(exposure, curve_of(options)),
                       sun_text(sun_elevation_degrees));
}

std::optional<Thumbnail> sky_picture(const PreviewAssets& assets, PreviewOptions& options) {
    const PreviewAsset* transmittance = assets.of_kind("transmittance");
    const PreviewAsset* scattering = assets.of_kind("multiple_scattering");
    if (!transmittance || !scattering || !assets.recipe) return std::nullopt;
    auto tables = make_sky_tables(*transmittance, scattering);
    if (!tables.value) return std::nullopt;
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.width = size_of(options)[0];
    view.height = size_of(options)[1];
    // A pixel is as many degrees wide as it is high.
    view.azimuth_span_degrees =
        std::min(360.0, (view.highest_degrees - view.lowest_degrees) * view.width / view.height);
    const config::Atmosphere& atmosphere = assets.recipe->parameters.atmosphere;
    // The default altitude may be above the top of a thin shell.
    const double thickness_km =
        (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000;
    view.camera_altitude_km = std::min(options.altitude_m.value_or(200) / 1000, thickness_km);
    view.sun_elevation_degrees =
        options.sun_elevations_deg.empty() ? 10 : options.sun_elevations_deg.front();
    const SkyMedium medium = make_sky_medium(atmosphere);
    tables.value->screen = daylight_screen({medium, *tables.value}, options.threads);
    Image2<float> radiance = render_sky(medium, *tables.value, view, options.threads);
    if (!options.exposure_stops) {  // the one chosen for the first picture is used for all
        const double daylight = daylight_shares({medium, *tables.value},
                                                {{view.sun_elevation_degrees, 0}}, options.threads)
                                    .front();
        options.exposure_stops = std::log2(
            sky_exposure_for(tables.value->screen.shown(radiance), curve_of(options), daylight));
    }
    const double exposure = std::exp2(*options.exposure_stops);
    add_sun(medium, *tables.value, view, options.glare.value_or(Glare::none), radiance);
    return Thumbnail{tone_mapped(tables.value->screen.shown(radiance), exposure, curve_of(options)),
                     light_words(options, exposure, view.sun_elevation_degrees)};
}

// Draws the first channel of the middle plane, with 0 as black and 1 as white.
Picture slice_picture(const PreviewAsset& asset) {
    const VoxelView volume = view_of(asset);
    const Image2<float> plane = slice(volume, 0, 2, volume.size[2] / 2);
    const int scale = std::max(1, telling_size[1] / std::max(plane.width, plane.height));
    Picture picture(plane.width * scale, plane.height * scale);
    std::uint8_t* out = picture.rgb.data();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float value = *plane.texel(x / scale, plane.height - 1 - y / scale);
            const float grey = 255 * std::clamp(value, 0.0f, 1.0f) + 0.5f;
            for (int c = 0; c < 3; ++c) *out++ = static_cast<std::uint8_t>(grey);
        }
    }
    return picture;
}

// Draws a lit cloud as a draft. A draft halves the size, so twice the size is asked for.
std::optional<Thumbnail> cloud_picture(const PreviewAssets& assets, PreviewOptions& options) {
    for (const PreviewAsset& asset : assets.assets) {
        CloudPreviewInput input = cloud_input(assets, asset, options);
        if (input.cloud == nullptr || input.volume == nullptr) continue;
        input.width = 2 * size_of(options)[0];
        input.height = 2 * size_of(options)[1];
        input.draft = true;
        input.suns.resize(1);
        auto pictures = cloud_pictures(input, options.threads);
        if (pictures.empty()) continue;
        Thumbnail slices{std::move(pictures.front().picture), ""};
        if (const std::optional<double> exposure = pictures.front().exposure) {
            if (!options.exposure_stops) options.exposure_stops = std::log2(*exposure);
            slices.light = light_words(options, *exposure, input.suns.front().elevation_degrees);
        }
        return slices;
    }
    return std::nullopt;
}

// Returns a lit cloud if there is one, else a panorama of the sky, else a slice, else a table, or
// nothing. Without options.exposure_stops, the exposure is chosen for this picture and stored
// there, so that the next pictures have the same.
std::optional<Thumbnail> telling_picture(const PreviewAssets& assets, PreviewOptions& options) {
    if (auto cloud = cloud_picture(assets, options)) return cloud;
    if (auto sky = sky_picture(assets, options)) return sky;
    for (const PreviewAsset& asset : assets.assets) {
        if (!asset.voxels.empty()) return Thumbnail{slice_picture(asset), ""};
    }
    for (const PreviewAsset& asset : assets.assets) {
        auto pictures = asset_pictures(asset);
        if (!pictures.empty()) return Thumbnail{std::move(pictures.front().picture), ""};
    }
    return std::nullopt;
}

// --- All variants --------------------------------------------------------------------------------

namespace fs = std::filesystem;

class SweepPreview {
  public:
    SweepPreview(const fs::path& folder, const fs::path& page_folder, const PreviewSweep& sweep,
                 const PreviewOptions& options)
        : folder_(folder),
          seen_from_page_(folder_from(page_folder, folder)),
          sweep_(sweep),
          table_(sweep),
          options_(options),
          encoder_(options.threads, options.memory) {}

    Outcome<PreviewPage> make() {
        shown_.title = "Sweep";
        shown_.columns = table_.columns();
        for (const SweepVariant& variant : sweep_.variants) {
            if (is_cancelled(options_.progress)) return {};
            begin_stage(variant.name);
            add(variant);
            if (!unused_.empty()) return {{}, std::move(unused_)};
        }
        if (is_cancelled(options_.progress)) return {};
        add_pictures();
        auto problems = encoder_.finish();
        if (!problems.empty()) return {{}, std::move(problems)};
        shown_.content =
            fmt::format("{} variants of one recipe{}.", sweep_.variants.size(), without_assets());
        page_.title = fs::absolute(folder_).lexically_normal().filename().string();
        page_.tables.push_back(std::move(shown_));
        return {std::move(page_), std::move(warnings_)};
    }

  private:
    void begin_stage(const std::string& what) {
        if (options_.progress == nullptr) return;
        options_.progress->begin_stage(++stage_, static_cast<int>(sweep_.variants.size()), what);
    }

    // Returns ", 2 failed, 1 missing", or an empty text if all variants are done.
    std::string without_assets() const {
        std::map<std::string, int> counts;
        for (const SweepVariant& variant : sweep_.variants) {
            if (variant.status != "done") ++counts[variant.status];
        }
        std::string words;
        for (const auto& [status, count] : counts) words += fmt::format(", {} {}", count, status);
        return words;
    }

    // Returns the path of the sweep's folder as a link from the page.
    static fs::path folder_from(const fs::path& page_folder, const fs::path& folder) {
        std::error_code error;
        const fs::path page = fs::weakly_canonical(fs::absolute(page_folder, error), error);
        return fs::weakly_canonical(fs::absolute(folder, error), error).lexically_relative(page);
    }

    void add(const SweepVariant& variant) {
        std::optional<PagePicture> picture;
        pictures_.emplace_back();
        if (variant.status == "done" && pictured_ < most_pictured_variants) {
            picture = picture_of(variant);
        }
        const auto difference =
            first_ ? rms_difference(pictures_.back(), pictures_[*first_]) : std::nullopt;
        shown_.variants.push_back(table_.row(variant, difference, seen_from_page_));
        shown_.variants.back().picture = std::move(picture);
    }

    std::optional<PagePicture> picture_of(const SweepVariant& variant) {
        const auto assets = load_folder(folder_ / variant.name);
        if (!assets.value) {
            page_.notes.push_back(assets.diagnostics.front().message);
            return std::nullopt;
        }
        for (const Diagnostic& warning : assets.diagnostics) {
            page_.notes.push_back(warning.message);
            warnings_.push_back(warning);
        }
        LitPictures lit = lit_pictures_of(*assets.value);
        lit.sweep = true;
        // Options are checked only before the first picture, because the exposure stored afterwards
        // is not an option of the user.
        if (pictured_ == 0) {
            unused_ = unused_options(lit, options_);
            if (unused_.empty()) complete(*assets.value, lit);
        }
        if (!unused_.empty()) return std::nullopt;
        if (const auto problem = camera_above_air(*assets.value, options_)) {
            page_.notes.push_back(fmt::format("{}: {}", variant.name, problem->message));
            return std::nullopt;
        }
        auto picture = telling_picture(*assets.value, options_);
        if (!picture) return std::nullopt;
        if (light_.empty()) light_ = picture->light;
        if (pictured_++ == 0) first_ = pictures_.size() - 1;
        pictures_.back() = std::move(picture->picture);
        const PreviewPicture titled{variant.name, sweep_.label(variant), "", pictures_.back()};
        auto encoded = encoder_.encode(variant.name, [&] { return std::vector{titled}; });
        if (encoded.empty()) return std::nullopt;
        return std::move(encoded.front());
    }

    // All pictures take what the first variant's recipe says on pictures.
    void complete(const PreviewAssets& assets, const LitPictures& lit) {
        auto complete = completed(options_, assets.recipe ? &*assets.recipe : nullptr, lit);
        if (complete.value) options_ = std::move(*complete.value);
        unused_ = std::move(complete.diagnostics);
    }

    void add_pictures() {
        shown_.pictures = encoder_.encode("sheets", [&] {
            auto pictures = sweep_sheets(sweep_, pictures_, light_);
            for (PreviewPicture& plot : sweep_plots(sweep_)) pictures.push_back(std::move(plot));
            return pictures;
        });
    }

    const fs::path& folder_;
    fs::path seen_from_page_;  // the same folder
    const PreviewSweep& sweep_;
    SweepTable table_;
    PreviewOptions options_;
    PictureEncoder encoder_;
    PreviewPage page_;
    PageTable shown_;
    std::vector<Picture> pictures_;  // of the variants so far; empty: none
    std::size_t pictured_ = 0;
    std::optional<std::size_t> first_;  // the first variant that has a picture
    std::string light_;                 // of the first picture of light, valid for all
    std::vector<Diagnostic> warnings_;
    // Options that no picture uses or that contradict each other end the preview.
    std::vector<Diagnostic> unused_;
    int stage_ = 0;
};

}  // namespace

Outcome<PreviewPage> make_sweep_preview(const fs::path& folder, const fs::path& page_folder,
                                        const PreviewOptions& options) {
    const Outcome<PreviewSweep> sweep = load_sweep(folder);
    if (!sweep.value) return {{}, sweep.diagnostics};
    return SweepPreview(folder, page_folder, *sweep.value, options).make();
}

}  // namespace skybake
