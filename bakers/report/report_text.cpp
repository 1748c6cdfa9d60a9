#include "bakers/report/report_files.h"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/release.h"

namespace skybake {

namespace {

using Json = nlohmann::ordered_json;

// A column of CSV and a key of JSON. One list has the columns of all assets, another those of
// volumes only, whose cells are empty in the rows of tables.
struct Column {
    std::string_view name;
    std::function<Json(const ReportRow&)> value;
};

const std::vector<Column>& columns() {
    static const std::vector<Column> all = {
        {"asset", [](const ReportRow& row) { return Json(row.asset); }},
        {"family", [](const ReportRow& row) { return Json(row.family); }},
        {"variant", [](const ReportRow& row) { return Json(row.variant); }},
        {"baseline", [](const ReportRow& row) { return Json(row.baseline); }},
        {"of_recipe", [](const ReportRow& row) { return Json(row.of_recipe); }},
        {"width", [](const ReportRow& row) { return Json(row.size[0]); }},
        {"height", [](const ReportRow& row) { return Json(row.size[1]); }},
        {"pixel_type", [](const ReportRow& row) { return Json(to_string(row.pixel_type)); }},
        {"file_bytes", [](const ReportRow& row) { return Json(row.file_bytes); }},
        {"time_ms", [](const ReportRow& row) { return Json(row.time_ms); }},
        {"texel_error_max", [](const ReportRow& row) { return Json(row.texel.max); }},
        {"texel_error_rms", [](const ReportRow& row) { return Json(row.texel.rms); }},
        {"lookup_error_max", [](const ReportRow& row) { return Json(row.lookup.max); }},
        {"lookup_error_rms", [](const ReportRow& row) { return Json(row.lookup.rms); }},
        {"on_lookup_front", [](const ReportRow& row) { return Json(row.on_lookup_front); }},
        {"in_quadrature_sweep", [](const ReportRow& row) { return Json(row.in_quadrature_sweep); }},
        {"on_texel_front", [](const ReportRow& row) { return Json(row.on_texel_front); }},
    };
    return all;
}

const std::vector<Column>& volume_columns() {
    static const std::vector<Column> all = {
        {"depth", [](const ReportRow& row) { return Json(row.size[2]); }},
        {"format", [](const ReportRow& row) { return Json(to_string(row.volume_file->format)); }},
        {"compression", [](const ReportRow& row) { return Json(row.volume_file->compression); }},
        {"write_ms", [](const ReportRow& row) { return Json(row.volume_file->write_ms); }},
        {"on_bytes_front",
         [](const ReportRow& row) { return Json(row.volume_file->on_bytes_front); }},
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
    if (!row.volume_file) return entry;
    for (const Column& column : volume_columns()) {
        entry[std::string(column.name)] = column.value(row);
    }
    return entry;
}

Json statistics_json(const VolumeFacts& volume) {
    Json list = Json::array();
    for (std::size_t c = 0; c < volume.channels.size(); ++c) {
        const ValueStatistics& channel = volume.statistics[c];
        list.push_back({{"channel", volume.channels[c]},
                        {"min", channel.min},
                        {"max", channel.max},
                        {"mean", channel.mean}});
    }
    return list;
}

Json to_json(const SkippingFacts& skipping) {
    Json rows = Json::array();
    for (const SkippingRow& row : skipping.rows) {
        rows.push_back({{"structure", row.structure},
                        {"occupied_share", row.occupied_share},
                        {"samples", row.samples},
                        {"lost_samples", row.lost_samples},
                        {"fetches_up", row.fetches[0]},
                        {"fetches_within", row.fetches[1]},
                        {"fetches_down", row.fetches[2]},
                        {"changed_rays", row.changed_rays},
                        {"structure_bytes", row.structure_bytes},
                        {"time_ms", row.time_ms}});
    }
    return {{"size", skipping.size},
            {"cell", skipping.cell},
            {"rays", skipping.rays},
            {"smallest_safe_share", skipping.smallest_safe_share},
            {"rows", std::move(rows)}};
}

Json to_json(const AssetReport& asset) {
    Json rows = Json::array();
    for (const ReportRow& row : asset.rows) rows.push_back(to_json(row));
    Json json = {{"name", asset.name},
                 {"kind", asset.kind},
                 {"sky", asset.sky ? sky_error_json(*asset.sky) : Json(nullptr)},
                 {"reference", asset.reference},
                 {"scale", asset.scale},
                 {"timing", asset.timing},
                 {"repetitions", asset.repetitions},
                 {"texel_points", asset.texel_points},
                 {"lookup_points", asset.lookup_points},
                 {"notes", asset.notes}};
    if (asset.volume) {
        json["write_repetitions"] = asset.volume->write_repetitions;
        json["statistics"] = statistics_json(*asset.volume);
        json["seam_error"] = asset.volume->seam_error;
    }
    if (asset.skipping) json["skipping"] = to_json(*asset.skipping);
    json["rows"] = std::move(rows);
    return json;
}

}  // namespace

std::string report_csv(const std::vector<AssetReport>& assets) {
    std::string text;
    for (const auto* list : {&columns(), &volume_columns()}) {
        for (const Column& column : *list) {
            text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
        }
    }
    text += '\n';
    for (const AssetReport& asset : assets) {
        for (const ReportRow& row : asset.rows) {
            std::string line;
            for (const Column& column : columns()) {
                if (&column != &columns().front()) line += ',';
                line += csv_cell(column.value(row));
            }
            for (const Column& column : volume_columns()) {
                line += ',';
                if (row.volume_file) line += csv_cell(column.value(row));
            }
            text += line + '\n';
        }
    }
    return text;
}

std::string report_json(const std::vector<AssetReport>& assets) {
    Json list = Json::array();
    for (const AssetReport& asset : assets) list.push_back(to_json(asset));
    const Json report = {{"report", {{"tool", tool_name()}, {"version", release()}, {"format", 1}}},
                         {"assets", std::move(list)}};
    return dump(report, 2) + "\n";
}

}  // namespace skybake
