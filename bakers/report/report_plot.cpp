#include "bakers/report/report_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bakers/report/svg_plot.h"

namespace skybake {

namespace {

int family_index(std::vector<std::string>& families, const std::string& family) {
    const auto at = std::find(families.begin(), families.end(), family);
    const auto index = at - families.begin();
    if (at == families.end()) families.push_back(family);
    return static_cast<int>(index);
}

std::string label_of(const ReportRow& row, bool on_front) {
    if (!row.baseline.empty()) return row.baseline + ": " + row.variant;
    if (row.of_recipe) return "this recipe: " + row.variant;
    return on_front ? row.variant : "";
}

std::string tooltip_of(const ReportRow& row) {
    return fmt::format(
        "{}, {}: {:.3g} ms, lookup error {:.2g} RMS, {:.2g} max, texel error {:.2g} RMS",
        row.family, row.variant, row.time_ms, row.lookup.rms, row.lookup.max, row.texel.rms);
}

PlotPoint point_of(const ReportRow& row, int family, double error, bool on_front) {
    PlotPoint point;
    point.x = row.time_ms;
    point.y = error;
    point.family = family;
    point.label = label_of(row, on_front);
    point.tooltip = tooltip_of(row);
    point.emphasised = !row.baseline.empty() || row.of_recipe;
    point.on_front = on_front;
    return point;
}

}  // namespace

std::string report_svg(const AssetReport& asset) {
    Plot plot;
    plot.title = asset.name + ": what accuracy costs";
    plot.subtitles = {fmt::format("error against {} ({} points; {})", asset.reference,
                                  asset.lookup_points, asset.scale),
                      fmt::format("time: {}, median of {}", asset.timing, asset.repetitions)};
    plot.front_name = "Pareto front";
    PlotPanel lookups;
    lookups.title = "Lookups between texels: all variants";
    lookups.x_title = "time (ms)";
    lookups.y_title = "lookup error, RMS";
    PlotPanel texels;
    texels.x_title = lookups.x_title;
    texels.y_title = "texel error, RMS";
    for (const ReportRow& row : asset.rows) {
        const int family = family_index(plot.families, row.family);
        lookups.points.push_back(point_of(row, family, row.lookup.rms, row.on_lookup_front));
        if (row.in_quadrature_sweep) {
            texels.title = fmt::format("Texels: quadratures at {}x{}", row.size[0], row.size[1]);
            texels.points.push_back(point_of(row, family, row.texel.rms, row.on_texel_front));
        }
    }
    plot.panels = {std::move(lookups), std::move(texels)};
    return svg_of(plot);
}

}  // namespace skybake
