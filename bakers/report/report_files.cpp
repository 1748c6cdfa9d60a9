#include "bakers/report/report_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/truth/sky_truth_store.h"
#include "config/sections/file_formats.h"

namespace skybake {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSignLength = 512;  // the signs are within this many bytes

std::string beginning_of(const fs::path& path) {
    std::string text(kSignLength, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

}  // namespace

std::vector<ReportFile> report_files(const std::vector<AssetReport>& assets) {
    std::vector<ReportFile> files = {{"report.csv", report_csv(assets)},
                                     {"report.json", report_json(assets)}};
    for (const AssetReport& asset : assets) {
        // Without rows there is nothing to plot.
        if (!asset.rows.empty())
            files.push_back({asset.name + ".svg", report_svg(report_figure(asset))});
    }
    return files;
}

std::vector<std::string> report_file_names(const std::vector<std::string>& assets) {
    std::vector<std::string> names = {"report.csv", "report.json"};
    for (const std::string& asset : assets) names.push_back(asset + ".svg");
    return names;
}

bool is_report_text(std::string_view name, std::string_view text) {
    if (name.ends_with(".csv")) {
        return text.starts_with("asset,family,variant,baseline,") ||
               text.starts_with("method,family,variant,baseline,") ||
               text.starts_with("way,family,variant,baseline,") || is_stored_sky_truth(text);
    }
    if (name.ends_with(".json"))
        return text.starts_with("{\n  \"report\": {\n    \"tool\": \"skybake\"");
    return text.find(fmt::format("<!-- {} -->", report_plot_sign)) < kSignLength;
}

std::vector<config::Diagnostic> foreign_report_files(const fs::path& folder,
                                                     const std::vector<std::string>& names) {
    std::vector<config::Diagnostic> diagnostics;
    for (const std::string& name : names) {
        const fs::path path = folder / name;
        std::error_code error;
        if (!fs::is_regular_file(path, error) || is_report_text(name, beginning_of(path))) continue;
        config::Diagnostic diagnostic = file_error(
            "E0303", path.string(),
            fmt::format("`{}` already exists and is not a report of skybake", path.string()));
        diagnostic.label = "overwrite it with --force, or choose another folder with -o";
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

namespace {

// --- An asset -----------------------------------------------------------------------------------

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

ChartPoint point_of(const ReportRow& row, int family, double cost, double error, bool on_front) {
    ChartPoint point;
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

// Returns the word for what the variants of one size differ in.
const char* compared_of(const AssetReport& asset) {
    if (asset.kind == "bruneton") return "methods";
    return asset.volume ? "octaves" : "quadratures";
}

}  // namespace

Figure report_figure(const AssetReport& asset) {
    Figure plot;
    plot.title = asset.name + ": what accuracy costs";
    plot.subtitles = {fmt::format("error against {} ({} points; {})", asset.reference,
                                  asset.lookup_points, asset.scale),
                      fmt::format("time: {}, median of {}", asset.timing, asset.repetitions)};
    plot.front_name = "Pareto front";
    std::vector<ChartPoint> lookups, texels, bytes;
    std::string texels_title;
    for (const ReportRow& row : asset.rows) {
        const int family = family_index(plot.families, row.family);
        ChartPoint lookup = point_of(row, family, row.time_ms, row.lookup.rms, row.on_lookup_front);
        // Files of the same voxels are at the same place, so only the one named by its size keeps
        // its label.
        if (is_named_by_its_file(row) && !lookup.emphasised) lookup.label.clear();
        lookups.push_back(std::move(lookup));
        if (row.in_quadrature_sweep) {
            texels_title = fmt::format("Texels: {} at {}", compared_of(asset), size_text(row.size));
            texels.push_back(point_of(row, family, row.time_ms, row.texel.rms, row.on_texel_front));
        }
        if (row.volume_file) {
            bytes.push_back(point_of(row, family, static_cast<double>(row.file_bytes) / 1024,
                                     row.lookup.rms, row.volume_file->on_bytes_front));
        }
    }
    const std::string time = "time (ms)", lookup_error = "lookup error, RMS";
    plot.charts.push_back(scatter_chart(std::move(lookups), "Lookups between texels: all variants",
                                        time, lookup_error));
    if (!texels.empty()) {
        plot.charts.push_back(
            scatter_chart(std::move(texels), texels_title, time, "texel error, RMS"));
    }
    if (!bytes.empty()) {
        plot.charts.push_back(scatter_chart(std::move(bytes), "Lookups between texels: bytes",
                                            "file (KiB)", lookup_error));
    }
    return plot;
}

// --- The sky ------------------------------------------------------------------------------------

namespace {

ChartPoint point_of(const SkyErrorRow& row, int family, double error) {
    ChartPoint point;
    point.x = row.time_ms;
    point.y = error;
    point.family = family;
    point.label = row.method.baseline.empty() ? row.method.name : row.method.baseline;
    point.tooltip = fmt::format("{}, {}: {:.3g} ms, error {:.2g} median, {:.2g} p90, {:.2g} max",
                                row.method.family, row.method.name, row.time_ms, row.error.median,
                                row.error.p90, row.error.max);
    point.emphasised = !row.method.baseline.empty();
    point.on_front = row.on_front;
    return point;
}

}  // namespace

Figure sky_truth_figure(const SkyErrorReport& report) {
    Figure plot;
    plot.title = "The sky's error by its multiple scattering";
    plot.subtitles = {
        fmt::format("relative error of sky radiance in {} directions against path tracing, whose "
                    "standard error is {:.2g} median, {:.2g} p90",
                    report.directions, report.truth_error.median, report.truth_error.p90),
        fmt::format("time: processor time of all that comes before the first view ray, one "
                    "thread, median of {}",
                    report.repetitions)};
    plot.front_name = "Pareto front";
    std::vector<ChartPoint> median, p90;
    for (const SkyErrorRow& row : report.rows) {
        if (!row.method.takes_time()) {  // a logarithmic axis cannot show a time of 0
            plot.subtitles.push_back(fmt::format("{}: {:.2g} median, {:.2g} p90", row.method.family,
                                                 row.error.median, row.error.p90));
            continue;
        }
        const int family = family_index(plot.families, row.method.family);
        median.push_back(point_of(row, family, row.error.median));
        p90.push_back(point_of(row, family, row.error.p90));
        p90.back().on_front = false;  // the front is that of medians
    }
    plot.charts = {
        scatter_chart(std::move(median), "Median", "time (ms)", "relative error, median"),
        scatter_chart(std::move(p90), "9 of 10 are within", "time (ms)",
                      "relative error, 90th percentile")};
    return plot;
}

std::string report_svg(const Figure& figure) {
    return svg_of(drawing_of(figure), report_plot_sign);
}

}  // namespace skybake
