#include "bakers/report/report_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bakers/plot/svg_plot.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

namespace {

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

PlotPoint point_of(const ReportRow& row, int family, double cost, double error, bool on_front) {
    PlotPoint point;
    point.x = cost;
    point.y = error;
    point.family = family;
    point.label = label_of(row, on_front);
    point.tooltip = tooltip_of(row);
    point.emphasised = !row.baseline.empty() || row.of_recipe;
    point.on_front = on_front;
    return point;
}

bool is_named_by_its_file(const ReportRow& row) {
    return row.volume_file && row.volume_file->format != config::FileFormat::bin;
}

// What the rows of a sweep of one size differ in.
const char* compared_of(const AssetReport& asset) {
    if (asset.kind == "bruneton") return "methods";
    return asset.volume ? "octaves" : "quadratures";
}

PlotPanel empty_panel(std::string title, std::string x_title, std::string y_title) {
    return {std::move(title), std::move(x_title), std::move(y_title), {}};
}

}  // namespace

std::string report_svg(const AssetReport& asset) {
    Plot plot;
    plot.title = asset.name + ": what accuracy costs";
    plot.subtitles = {fmt::format("error against {} ({} points; {})", asset.reference,
                                  asset.lookup_points, asset.scale),
                      fmt::format("time: {}, median of {}", asset.timing, asset.repetitions)};
    plot.front_name = "Pareto front";
    PlotPanel lookups =
        empty_panel("Lookups between texels: all variants", "time (ms)", "lookup error, RMS");
    PlotPanel texels = empty_panel("", "time (ms)", "texel error, RMS");
    PlotPanel bytes =
        empty_panel("Lookups between texels: bytes", "file (KiB)", "lookup error, RMS");
    for (const ReportRow& row : asset.rows) {
        const int family = family_index(plot.families, row.family);
        PlotPoint lookup = point_of(row, family, row.time_ms, row.lookup.rms, row.on_lookup_front);
        // Files of the same voxels stand in one place, where those named by their size speak for
        // all.
        if (is_named_by_its_file(row) && !lookup.emphasised) lookup.label.clear();
        lookups.points.push_back(std::move(lookup));
        if (row.in_quadrature_sweep) {
            texels.title = fmt::format("Texels: {} at {}", compared_of(asset), size_text(row.size));
            texels.points.push_back(
                point_of(row, family, row.time_ms, row.texel.rms, row.on_texel_front));
        }
        if (row.volume_file) {
            bytes.points.push_back(point_of(row, family, static_cast<double>(row.file_bytes) / 1024,
                                            row.lookup.rms, row.volume_file->on_bytes_front));
        }
    }
    plot.panels = {std::move(lookups), std::move(texels)};
    if (asset.volume) plot.panels.push_back(std::move(bytes));
    return svg_of(plot);
}

}  // namespace skybake
