#include "bakers/report/report_files.h"

#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/release.h"
#include "bakers/report/measurement.h"
#include "config/sections/file_formats.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// --- Texts --------------------------------------------------------------------------------------

// A column of CSV and a key of JSON.
struct Column {
    std::string_view name;
    std::function<Json(const ReportRow&)> value;
};

Json size_along(const ReportRow& row, std::size_t axis) {
    return axis < row.size.size() ? Json(row.size[axis]) : Json(1);
}

const std::vector<Column>& columns() {
    static const std::vector<Column> all = {
        {"asset", [](const ReportRow& row) { return Json(row.asset); }},
        {"family", [](const ReportRow& row) { return Json(row.family); }},
        {"variant", [](const ReportRow& row) { return Json(row.variant); }},
        {"baseline", [](const ReportRow& row) { return Json(row.baseline); }},
        {"of_recipe", [](const ReportRow& row) { return Json(row.of_recipe); }},
        {"width", [](const ReportRow& row) { return size_along(row, 0); }},
        {"height", [](const ReportRow& row) { return size_along(row, 1); }},
        {"depth", [](const ReportRow& row) { return size_along(row, 2); }},
        {"pixel_type", [](const ReportRow& row) { return Json(to_string(row.pixel_type)); }},
        {"file_bytes", [](const ReportRow& row) { return Json(row.file_bytes); }},
        {"time_ms", [](const ReportRow& row) { return Json(row.time_ms); }},
        {"write_ms", [](const ReportRow& row) { return Json(row.write_ms); }},
        {"texel_error_max", [](const ReportRow& row) { return Json(row.texel.max); }},
        {"texel_error_rms", [](const ReportRow& row) { return Json(row.texel.rms); }},
        {"lookup_error_max", [](const ReportRow& row) { return Json(row.lookup.max); }},
        {"lookup_error_rms", [](const ReportRow& row) { return Json(row.lookup.rms); }},
        {"on_time_front", [](const ReportRow& row) { return Json(row.on_time_front); }},
        {"on_bytes_front", [](const ReportRow& row) { return Json(row.on_bytes_front); }},
    };
    return all;
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Returns the text of a cell, quoted if necessary.
std::string csv_cell(const Json& value) {
    if (!value.is_string()) return dump(value, -1);
    const auto& text = value.get_ref<const std::string&>();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) {
        if (letter == '"') quoted += '"';
        quoted += letter;
    }
    return quoted + '"';
}

Json to_json(const ReportRow& row) {
    Json entry = Json::object();
    for (const Column& column : columns()) entry[std::string(column.name)] = column.value(row);
    return entry;
}

Json to_json(const AssetReport& asset) {
    return {{"name", asset.name},
            {"kind", asset.kind},
            {"sky", asset.sky ? sky_error_json(*asset.sky) : Json(nullptr)},
            {"reference", asset.reference},
            {"scale", asset.scale},
            {"timing", asset.timing},
            {"repetitions", asset.repetitions},
            {"texel_points", asset.texel_points},
            {"lookup_points", asset.lookup_points},
            {"notes", asset.notes},
            {"rows", mapped<Json>(asset.rows, [](const ReportRow& row) { return to_json(row); })}};
}

constexpr std::size_t kSignLength = 512;  // the signs are within this many bytes

std::string beginning_of(const fs::path& path) {
    std::string text(kSignLength, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

std::string label_of(const ReportRow& row, bool on_front) {
    if (row.of_recipe) return "this recipe";
    if (!row.baseline.empty()) return row.baseline;
    return on_front ? row.variant : "";
}

Chart chart_of(const AssetReport& asset, const char* title, double (*cost)(const ReportRow&),
               bool ReportRow::*front, std::vector<std::string>& families) {
    std::vector<ChartPoint> points;
    for (const ReportRow& row : asset.rows) {
        ChartPoint point;
        point.x = cost(row);
        point.y = row.lookup.rms;
        point.family = family_index(families, row.family);
        point.on_front = row.*front;
        point.label = label_of(row, point.on_front);
        point.tooltip = fmt::format(
            "{} {}: {:.3g} ms, lookup error {:.2g} RMS, {:.2g} max, texel error {:.2g} RMS",
            row.family, row.variant, row.time_ms, row.lookup.rms, row.lookup.max, row.texel.rms);
        point.emphasised = row.of_recipe || !row.baseline.empty();
        points.push_back(std::move(point));
    }
    return scatter_chart(std::move(points), "", title, "lookup error, RMS");
}

}  // namespace

std::string report_csv(const std::vector<AssetReport>& assets) {
    std::string text;
    for (const Column& column : columns()) {
        text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
    }
    text += '\n';
    for (const AssetReport& asset : assets) {
        for (const ReportRow& row : asset.rows) {
            std::string line;
            for (const Column& column : columns()) {
                if (&column != &columns().front()) line += ',';
                line += csv_cell(column.value(row));
            }
            text += line + '\n';
        }
    }
    return text;
}

std::string report_json(const std::vector<AssetReport>& assets) {
    const auto list = mapped<Json>(assets, [](const AssetReport& asset) { return to_json(asset); });
    const Json report = {{"report", {{"tool", tool_name()}, {"version", release()}, {"format", 2}}},
                         {"assets", list}};
    return dump(report, 2) + "\n";
}

// --- The folder ---------------------------------------------------------------------------------

std::vector<NamedFile> report_files(const std::vector<AssetReport>& assets) {
    std::vector<NamedFile> files = {{"report.csv", report_csv(assets)},
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
               text.starts_with("subject,by,family,variant,baseline,");
    }
    if (name.ends_with(".json")) {
        return text.starts_with("{\n  \"report\": {\n    \"tool\": \"skybake\"") ||
               text.starts_with("{\n  \"plan\": {\n    \"tool\": \"skybake\"");
    }
    return text.find(fmt::format("<!-- {} -->", report_plot_sign)) < kSignLength;
}

std::vector<Diagnostic> foreign_report_files(const fs::path& folder,
                                             const std::vector<std::string>& names) {
    std::vector<Diagnostic> diagnostics;
    const bool has_plan = is_report_text("plan.json", beginning_of(folder / "plan.json"));
    for (const std::string& name : names) {
        const fs::path path = folder / name;
        std::error_code error;
        if (!fs::is_regular_file(path, error) || is_report_text(name, beginning_of(path))) continue;
        // PNG files and pages do not say whether a plan made them: they count as a plan's if its JSON
        // is beside them.
        if (has_plan && (name.ends_with(".png") || name.ends_with(".html"))) continue;
        diagnostics.push_back(file_error(
            "E0303", path.string(),
            fmt::format("`{}` already exists, and is neither a report nor a plan of skybake",
                        path.string()),
            "overwrite it with --force, or choose another folder with -o"));
    }
    return diagnostics;
}

// --- The plot -----------------------------------------------------------------------------------

Figure report_figure(const AssetReport& asset) {
    Figure plot;
    plot.title = asset.name + ": what accuracy costs";
    plot.subtitles = {fmt::format("error against {} ({} points; {})", asset.reference,
                                  asset.lookup_points, asset.scale),
                      fmt::format("time: {}", asset.timing)};
    plot.front_name = "Pareto front";
    plot.charts.push_back(chart_of(
        asset, "time (ms)", [](const ReportRow& row) { return row.time_ms; },
        &ReportRow::on_time_front, plot.families));
    plot.charts.push_back(chart_of(
        asset, "files (KiB)",
        [](const ReportRow& row) { return static_cast<double>(row.file_bytes) / 1024; },
        &ReportRow::on_bytes_front, plot.families));
    return plot;
}

std::string report_svg(const Figure& figure) {
    return svg_of(drawing_of(figure), report_plot_sign);
}

}  // namespace skybake
