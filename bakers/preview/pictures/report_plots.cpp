#include "bakers/preview/pictures/report_plots.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bakers/io/files/read_file.h"
#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "bakers/report/report_plot.h"

namespace skybake {

void find_plots(const std::filesystem::path& folder, PreviewAssets& assets) {
    constexpr std::uintmax_t largest_plot = std::uintmax_t{4} << 20;
    for (const PreviewAsset& asset : assets.assets) {
        const std::string name = asset.entry.name + ".svg";
        for (const std::filesystem::path& place : {folder / name, folder / "report" / name}) {
            const config::Outcome<std::string> text = read_file(place, largest_plot);
            if (!text.value || !is_report_text(name, *text.value)) continue;
            assets.plots[asset.entry.name] = *text.value;
            break;
        }
    }
}

std::vector<config::Diagnostic> measure_plots(PreviewAssets& assets, int threads,
                                              Progress* progress) {
    if (!assets.recipe) return {};
    for (const PreviewAsset& asset : assets.assets) {
        const std::vector<config::Bake>& bakes = assets.recipe->parameters.bakes;
        const auto bake = std::find_if(
            bakes.begin(), bakes.end(),
            [&](const config::Bake& candidate) { return candidate.name == asset.entry.name; });
        if (bake == bakes.end()) continue;
        auto report = report_asset(*assets.recipe, *bake, {threads, true, progress});
        if (!report.value) return std::move(report.diagnostics);
        if (!report.value->rows.empty())
            assets.plots[bake->name] = report_svg(report_figure(*report.value));
    }
    return {};
}

}  // namespace skybake
