#include "bakers/preview/page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/release.h"
#include "bakers/preview/page_text.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

// Describes a picture for the scripts. The image itself is in the HTML; scripts find it by the file
// name.
Json to_json(const PagePicture& picture) {
    return {{"name", picture.name},
            {"file", picture.name + ".png"},
            {"title", picture.title},
            {"caption", picture.caption},
            {"width", picture.picture.width},
            {"height", picture.picture.height},
            {"kind", kind_name(picture.kind)},
            {"sequence", picture.sequence},
            {"group", picture.group},
            {"tab", picture.tab},
            {"titled", picture.titled},
            {"frames_per_second", picture.frames_per_second}};
}

Json to_json(const std::vector<PagePicture>& pictures) {
    return mapped<Json>(pictures, [](const PagePicture& picture) { return to_json(picture); });
}

Json plot_json(const PageAsset& asset) {
    Json json = to_json(report_plot(asset));
    json["file"] = asset.entry.name + "_report.svg";
    return json;
}

Json error_json(const std::optional<Certificate>& error) {
    if (!error) return nullptr;
    return {{"sky", error->sky ? sky_error_json(*error->sky) : Json(nullptr)},
            {"lookup", {{"max", error->lookup.max}, {"rms", error->lookup.rms}}},
            {"texel", {{"max", error->texel.max}, {"rms", error->texel.rms}}},
            {"points", error->lookup_points},
            {"texel_points", error->texel_points},
            {"reference", error->reference},
            {"scale", error->scale},
            {"worst", error->worst},
            {"advice", error->advice}};
}

// Returns names and values as texts, in their order.
Json details_json(const Facts& details) {
    Json json = Json::array();
    for (const auto& [name, value] : details) json.push_back({name, fact_text(value)});
    return json;
}

Json to_json(const ManifestAsset& entry) {
    Json files = Json::array();
    for (const ManifestFile& file : entry.files) {
        files.push_back({{"path", file.path},
                         {"format", file.format},
                         {"pixel_type", to_string(file.pixel_type)},
                         {"bytes", file.bytes},
                         {"xxh3", file.xxh3}});
    }
    Json axes = Json::array();
    for (const AxisMapping& axis : entry.axes) {
        axes.push_back({{"quantity", axis.quantity},
                        {"first", axis.first},
                        {"last", axis.last},
                        {"formula", axis.formula},
                        {"convention", axis.convention}});
    }
    Json statistics = Json::array();
    if (entry.is_volume()) {
        for (const ValueStatistics& channel : entry.levels[0].statistics) {
            statistics.push_back(
                {{"min", channel.min}, {"mean", channel.mean}, {"max", channel.max}});
        }
    }
    Json json = {{"name", entry.name},
                 {"kind", entry.kind},
                 {"content", entry.content},
                 {"size", entry.size},
                 {"channels", entry.channels},
                 {"mapping", entry.mapping},
                 {"axes", std::move(axes)},
                 {"error", error_json(entry.error)},
                 {"bake_s", entry.timing.bake.made()},
                 {"threads", entry.timing.threads},
                 {"files", std::move(files)},
                 {"statistics", std::move(statistics)},
                 {"details", details_json(entry.details)},
                 {"content_hash", entry.content_hash},
                 {"parameters", entry.parameters}};
    if (entry.is_volume()) json["seam_error"] = entry.seam_error;
    return json;
}

Json to_json(const PageAsset& asset) {
    Json json = to_json(asset.entry);
    json["pictures"] = to_json(asset.pictures);
    if (!asset.plot_svg.empty()) json["pictures"].push_back(plot_json(asset));
    return json;
}

Json to_json(const PageScene& scene) {
    return {{"title", scene.title},
            {"content", scene.content},
            {"clouds", scene.clouds},
            {"pictures", to_json(scene.pictures)}};
}

Json to_json(const PageVariant& variant) {
    Json cells = Json::array();
    for (const PageVariant::Cell& cell : variant.cells) {
        Json text = cell.text.empty() ? Json(nullptr) : Json(cell.text);
        Json value = cell.number ? Json(*cell.number) : text;
        cells.push_back({{"value", std::move(value)}, {"text", std::move(text)}});
    }
    Json json = {{"name", variant.name},
                 {"folder", variant.folder},
                 {"cells", std::move(cells)},
                 {"picture", nullptr}};
    if (variant.picture) json["picture"] = to_json(*variant.picture);
    return json;
}

Json to_json(const PageTable& table) {
    Json columns = Json::array();
    for (const PageTable::Column& column : table.columns) {
        columns.push_back({{"title", column.title}, {"shown", column.shown}});
    }
    const auto rows =
        mapped<Json>(table.variants, [](const PageVariant& variant) { return to_json(variant); });
    return {{"title", table.title},
            {"content", table.content},
            {"pictures", to_json(table.pictures)},
            {"columns", std::move(columns)},
            {"rows", rows}};
}

template <class T>
Json array_of(const std::vector<T>& elements) {
    return mapped<Json>(elements, [](const T& element) { return to_json(element); });
}

std::string script_text(const Json& json) {
    return safe_in_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// Lists the files beside the page that are not its pictures, so that a later preview knows them.
Json other_files_json(const PreviewPage& page) {
    Json json = Json::array();
    for (const std::string& name : page.retired) json.push_back({{"file", name}});
    if (page.watch_revision > 0) json.push_back({{"file", swap_name_of(page)}});
    return json;
}

std::string page_data(const PreviewPage& page) {
    return script_text({{"generator", generator()},
                        {"title", page.title},
                        {"notes", page.notes},
                        {"tables", array_of(page.tables)},
                        {"scenes", array_of(page.scenes)},
                        {"assets", array_of(page.assets)},
                        {"others", other_files_json(page)}});
}

// The scripts are one function, so that their names are their own.
std::string page_script() {
    std::string script = "(() => {\n";
    for (const char* name :
         {"page_elements.js", "page_tables.js", "page_tabs.js", "page_pictures.js",
          "page_enlarged.js", "page_sections.js", "page.js"}) {
        script += embedded_text(name);
    }
    return script + "})();\n";
}

}  // namespace

std::string watch_element(int revision) {
    if (revision == 0) return "";
    return "<script>\n" +
           filled(embedded_text("page_watch.js"), {{"revision", std::to_string(revision)}}) +
           "</script>\n";
}

std::string page_html(const PreviewPage& page) {
    return filled(embedded_text("page.html"), {{"head", head_html(page, "page.css")},
                                               {"title", html_text(page.title)},
                                               {"data", page_data(page)},
                                               {"pictures", pictures_html(page)},
                                               {"script", page_script()},
                                               {"watch", watch_element(page.watch_revision)}});
}

std::string other_files(const PreviewPage& page) { return script_text(other_files_json(page)); }

const char* swap_name_of(const PreviewPage& page) {
    return page.live_scene.empty() ? "preview_page.js" : "live_scene.js";
}

std::string page_swap_text(const PreviewPage& page) {
    if (!page.live_scene.empty()) {
        return fmt::format("skybakeScene({}, {});\n", page.watch_revision, page.live_scene);
    }
    return fmt::format("skybakePage({}, {}, {});\n", page.watch_revision, page_data(page),
                       script_text(Json(pictures_html(page))));
}

std::string page_state_text(const PageState& state) {
    Json diagnostics = Json::array();
    for (const Diagnostic& diagnostic : state.diagnostics) {
        const bool error = diagnostic.severity == Severity::error;
        diagnostics.push_back({{"severity", error ? "error" : "warning"},
                               {"code", diagnostic.code},
                               {"message", diagnostic.message},
                               {"file", diagnostic.where.source},
                               {"line", diagnostic.where.line},
                               {"column", diagnostic.where.column},
                               {"length", diagnostic.where.length},
                               {"text", diagnostic.where.line_text},
                               {"label", diagnostic.label}});
    }
    return fmt::format("skybakePreview({});\n",
                       script_text({{"revision", state.revision},
                                    {"seconds", state.seconds},
                                    {"quality", state.full ? "full" : "draft"},
                                    {"ended", state.ended},
                                    {"diagnostics", std::move(diagnostics)}}));
}

std::optional<std::vector<std::string>> files_of_page(std::string_view html) {
    const std::string sign =
        fmt::format("<meta name=\"generator\" content=\"{} ", html_text(tool_name()));
    if (html.substr(0, 1024).find(sign) == std::string_view::npos) return std::nullopt;
    // Quotes within JSON strings are escaped, so this text occurs only at keys. The names are made
    // by file_stem, so they contain no escaped characters.
    constexpr std::string_view key = "\"file\":\"";
    std::vector<std::string> names;
    for (std::size_t at = html.find(key); at != std::string_view::npos; at = html.find(key, at)) {
        at += key.size();
        names.emplace_back(html.substr(at, html.find('"', at) - at));
    }
    return names;
}

}  // namespace skybake
