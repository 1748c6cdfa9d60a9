#include "bakers/preview/page.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/release.h"
#include "bakers/preview/page_text.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

std::string_view kind_name(PictureKind kind) {
    switch (kind) {
        case PictureKind::scene:
            return "scene";
        case PictureKind::plot:
            return "plot";
        case PictureKind::image:
            break;
    }
    return "image";
}

// Describes a picture for the scripts. The image itself is in the HTML; scripts find it by the file
// name.
Json to_json(const PagePicture& picture) {
    return {{"name", picture.name},
            {"file", picture.name + ".png"},
            {"title", picture.title},
            {"caption", picture.caption},
            {"width", picture.width},
            {"height", picture.height},
            {"kind", kind_name(picture.kind)},
            {"sequence", picture.sequence},
            {"group", picture.group},
            {"tab", picture.tab},
            {"titled", picture.titled}};
}

Json to_json(const std::vector<PagePicture>& pictures) {
    Json json = Json::array();
    for (const PagePicture& picture : pictures) json.push_back(to_json(picture));
    return json;
}

// Returns the width or height that a drawing of `report` states.
int svg_extent(std::string_view svg, std::string_view attribute) {
    const std::size_t at = svg.find(fmt::format(" {}=\"", attribute), svg.find("<svg"));
    if (at == std::string_view::npos) return 0;
    int value = 0;
    for (const char c : svg.substr(at + attribute.size() + 3)) {
        if (c < '0' || c > '9' || value > 100000) break;
        value = 10 * value + (c - '0');
    }
    return value;
}

PagePicture report_plot(const PageAsset& asset) {
    return {asset.entry.name + "_report",
            "Speed against error",
            "The plot shows what accuracy costs: the time of the bake against its error, for many "
            "variants.",
            svg_extent(asset.plot_svg, "width"),
            svg_extent(asset.plot_svg, "height"),
            "",
            PictureKind::plot};
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
                 {"bake_s", entry.timing.bake_s},
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
    Json json = {{"cells", std::move(cells)}, {"picture", nullptr}};
    if (variant.picture) json["picture"] = to_json(*variant.picture);
    return json;
}

Json to_json(const PageSweep& sweep) {
    Json columns = Json::array();
    for (const PageSweep::Column& column : sweep.columns) {
        columns.push_back(
            {{"title", column.title}, {"number", column.is_number}, {"error", column.is_error}});
    }
    Json rows = Json::array();
    for (const PageVariant& variant : sweep.variants) rows.push_back(to_json(variant));
    return {{"content", sweep.content},
            {"pictures", to_json(sweep.pictures)},
            {"columns", std::move(columns)},
            {"rows", std::move(rows)}};
}

template <class T>
Json array_of(const std::vector<T>& elements) {
    Json json = Json::array();
    for (const T& element : elements) json.push_back(to_json(element));
    return json;
}

std::string script_text(const Json& json) {
    return safe_in_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json retired_json(const std::vector<std::string>& names) {
    Json json = Json::array();
    for (const std::string& name : names) json.push_back({{"file", name}});
    return json;
}

std::string page_data(const PreviewPage& page) {
    return script_text({{"generator", generator()},
                        {"title", page.title},
                        {"notes", page.notes},
                        {"sweep", page.sweep ? to_json(*page.sweep) : Json(nullptr)},
                        {"scenes", array_of(page.scenes)},
                        {"assets", array_of(page.assets)},
                        {"retired", retired_json(page.retired)}});
}

std::string figure_html(const PagePicture& picture, const std::string& file,
                        const std::string& source) {
    return fmt::format(
        "<figure><img class=\"{}\" data-file=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" "
        "src=\"{}\"><figcaption><b>{}</b> {}</figcaption></figure>\n",
        kind_name(picture.kind), html_text(file),
        html_text(picture.caption.empty() ? picture.title : picture.caption), picture.width,
        picture.height, source, html_text(picture.title), html_text(picture.caption));
}

std::string figures_html(const std::vector<PagePicture>& pictures) {
    std::string html;
    for (const PagePicture& picture : pictures) {
        const std::string file = picture.name + ".png";
        html += figure_html(
            picture, file,
            picture.sequence.empty() ? "data:image/png;base64," + base64(picture.png) : file);
    }
    return html;
}

}  // namespace

std::string pictures_html(const PreviewPage& page) {
    std::string html;
    if (page.sweep) {
        html += figures_html(page.sweep->pictures);
        for (const PageVariant& variant : page.sweep->variants) {
            if (variant.picture) html += figures_html({*variant.picture});
        }
    }
    for (const PageScene& scene : page.scenes) html += figures_html(scene.pictures);
    for (const PageAsset& asset : page.assets) {
        html += figures_html(asset.pictures);
        if (asset.plot_svg.empty()) continue;
        html += figure_html(report_plot(asset), asset.entry.name + "_report.svg",
                            "data:image/svg+xml;base64," + base64(asset.plot_svg));
    }
    return html;
}

std::string watch_element(int revision) {
    if (revision == 0) return "";
    return "<script>\n" + filled(page_watch_script(), {{"revision", std::to_string(revision)}}) +
           "</script>\n";
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::string_view group = bytes.substr(at, 3);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            bits = bits << 8 | (i < group.size() ? static_cast<std::uint8_t>(group[i]) : 0U);
        }
        // A group of n bytes makes n + 1 digits; the rest is padding.
        for (std::size_t i = 0; i < 4; ++i) {
            text += i <= group.size() ? digits[bits >> (18 - 6 * i) & 63] : '=';
        }
    }
    return text;
}

std::string page_html(const PreviewPage& page) {
    return filled(page_html_template(), {{"generator", html_text(generator())},
                                         {"title", html_text(page.title)},
                                         {"style", std::string(page_style())},
                                         {"data", page_data(page)},
                                         {"pictures", pictures_html(page)},
                                         {"script", std::string(page_script())},
                                         {"watch", watch_element(page.watch_revision)}});
}

std::string page_state_text(const PageState& state) {
    Json diagnostics = Json::array();
    for (const config::Diagnostic& diagnostic : state.diagnostics) {
        const bool error = diagnostic.severity == config::Severity::error;
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
