#include "bakers/preview/sweep_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/preview/camera_altitude.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/load_sweep.h"
#include "bakers/preview/pictures/telling_picture.h"
#include "bakers/preview/unused_options.h"

namespace skybake {
namespace {

using config::Outcome;
namespace fs = std::filesystem;

// "ground_albedo 0.3, scale_height 8 km"
std::string caption_of(const PreviewSweep& sweep, const SweepVariant& variant) {
    std::string text;
    for (std::size_t i = 0; i < sweep.names.size(); ++i) {
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", sweep.names[i], variant.values[i].text);
    }
    return text;
}

class SweepPreview {
  public:
    SweepPreview(const fs::path& folder, const PreviewSweep& sweep, const PreviewOptions& options)
        : folder_(folder),
          sweep_(sweep),
          options_(options),
          encoder_(options.threads, options.memory) {}

    Outcome<PreviewPage> make() {
        add_columns();
        for (const SweepVariant& variant : sweep_.variants) {
            if (is_cancelled(options_.progress)) return {};
            begin_stage(variant.name);
            add(variant);
            if (!unused_.empty()) return {{}, std::move(unused_)};
        }
        if (is_cancelled(options_.progress)) return {};
        add_sheet();
        auto problems = encoder_.finish();
        if (!problems.empty()) return {{}, std::move(problems)};
        shown_.content =
            fmt::format("{} variants of one recipe{}.", sweep_.variants.size(), without_assets());
        page_.title = fs::absolute(folder_).lexically_normal().filename().string();
        page_.sweep = std::move(shown_);
        return {std::move(page_), std::move(warnings_)};
    }

  private:
    void begin_stage(const std::string& what) {
        if (options_.progress == nullptr) return;
        options_.progress->begin_stage(++stage_, static_cast<int>(sweep_.variants.size()), what);
    }

    // ", 2 failed, 1 missing"; empty where all are done.
    std::string without_assets() const {
        std::map<std::string, int> counts;
        for (const SweepVariant& variant : sweep_.variants) {
            if (variant.status != "done") ++counts[variant.status];
        }
        std::string words;
        for (const auto& [status, count] : counts) words += fmt::format(", {} {}", count, status);
        return words;
    }

    void add_columns() {
        for (const std::string& name : sweep_.names) {
            bool numbers = true;
            for (const SweepVariant& variant : sweep_.variants) {
                for (std::size_t i = 0; i < sweep_.names.size(); ++i) {
                    numbers = numbers && (sweep_.names[i] != name || variant.values[i].number);
                }
            }
            shown_.columns.push_back({name, numbers, false});
        }
        for (const std::string& asset : sweep_.assets) {
            shown_.columns.push_back({asset + " error, max", true, true});
            shown_.columns.push_back({"RMS", true, true});
        }
        shown_.columns.push_back({"Status", false, false});
    }

    void add(const SweepVariant& variant) {
        PageVariant row;
        for (const SweptValue& value : variant.values)
            row.cells.push_back({value.number, value.text});
        for (const std::string& asset : sweep_.assets) {
            const auto error = variant.lookup_errors.find(asset);
            const bool measured = error != variant.lookup_errors.end();
            row.cells.push_back({measured ? std::optional(error->second.max) : std::nullopt, ""});
            row.cells.push_back({measured ? std::optional(error->second.rms) : std::nullopt, ""});
        }
        row.cells.push_back({std::nullopt, variant.status});
        if (variant.status == "done" && pictures_.size() < most_pictured_variants) {
            row.picture = picture_of(variant);
        }
        shown_.variants.push_back(std::move(row));
    }

    std::optional<PagePicture> picture_of(const SweepVariant& variant) {
        const auto assets = load_folder(folder_ / variant.name);
        if (!assets.value) {
            page_.notes.push_back(assets.diagnostics.front().message);
            return std::nullopt;
        }
        for (const config::Diagnostic& warning : assets.diagnostics) {
            page_.notes.push_back(warning.message);
            warnings_.push_back(warning);
        }
        LitPictures lit = lit_pictures_of(*assets.value);
        lit.sweep = true;
        // The exposure that the first picture has got is no option.
        if (pictures_.empty()) unused_ = unused_options(lit, options_);
        if (!unused_.empty()) return std::nullopt;
        if (const auto problem = camera_above_air(*assets.value, options_)) {
            page_.notes.push_back(fmt::format("{}: {}", variant.name, problem->message));
            return std::nullopt;
        }
        auto picture = telling_picture(*assets.value, options_);
        if (!picture) return std::nullopt;
        if (light_.empty()) light_ = picture->light;
        pictures_.push_back(std::move(picture->picture));
        captions_.push_back(caption_of(sweep_, variant));
        const PreviewPicture titled{variant.name, captions_.back(), "", pictures_.back()};
        auto encoded = encoder_.encode(variant.name, [&] { return std::vector{titled}; });
        if (encoded.empty()) return std::nullopt;
        return std::move(encoded.front());
    }

    // As many columns as make the sheet about as wide as it is high, twice over: screens are wide.
    void add_sheet() {
        if (pictures_.empty()) return;
        const double shape = 1.0 * pictures_.front().width / pictures_.front().height;
        const auto count = static_cast<double>(pictures_.size());
        const int columns =
            std::max(1, static_cast<int>(std::lround(std::sqrt(2 * count / shape))));
        PreviewPicture sheet;
        sheet.name = "contact_sheet";
        sheet.kind = PictureKind::scene;
        sheet.title = "All variants";
        sheet.caption = "Each picture is shown with the values that vary.";
        if (!light_.empty()) sheet.caption += fmt::format(" They all have {}.", light_);
        if (pictures_.size() < sweep_.variants.size()) {
            sheet.title =
                fmt::format("{} of {} variants", pictures_.size(), sweep_.variants.size());
        }
        sheet.picture = contact_sheet(pictures_, captions_, columns);
        shown_.pictures = encoder_.encode("sheet", [&] { return std::vector{sheet}; });
    }

    const fs::path& folder_;
    const PreviewSweep& sweep_;
    PreviewOptions options_;
    PictureEncoder encoder_;
    PreviewPage page_;
    PageSweep shown_;
    std::vector<Picture> pictures_;
    std::vector<std::string> captions_;
    std::string light_;  // of the first picture of light, and so of all
    std::vector<config::Diagnostic> warnings_;
    std::vector<config::Diagnostic> unused_;  // options: what ends the preview
    int stage_ = 0;
};

}  // namespace

Outcome<PreviewPage> make_sweep_preview(const fs::path& folder, const PreviewOptions& options) {
    const Outcome<PreviewSweep> sweep = load_sweep(folder);
    if (!sweep.value) return {{}, sweep.diagnostics};
    return SweepPreview(folder, *sweep.value, options).make();
}

}  // namespace skybake
