#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/toml_source.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the schema

Json to_json(const ManifestFile& file) {
    Json json = {
        {"path", file.path},   {"format", file.format}, {"pixel_type", to_string(file.pixel_type)},
        {"bytes", file.bytes}, {"xxh3", file.xxh3},     {"level", file.level}};
    if (file.levels > 1) json["levels"] = file.levels;
    json["compression"] = file.compression;
    if (file.layout) {
        json["layout"] = {{"kind", to_string(file.layout->kind)},
                          {"columns", file.layout->columns},
                          {"rows", file.layout->rows}};
        if (file.layout->flipped) json["layout"]["flipped"] = true;
    }
    if (!file.grids.empty()) json["grids"] = file.grids;
    if (file.texture != TextureParts::none) json["texture"] = to_string(file.texture);
    return json;
}

Json to_json(const ManifestInput& input) { return {{"file", input.file}, {"xxh3", input.xxh3}}; }

Json to_json(const RetiredFile& file) { return {{"path", file.path}, {"xxh3", file.xxh3}}; }

// Writes whole numbers without a decimal point, as people write counts.
Json number_json(double number) {
    constexpr double largest_whole = 9007199254740992;  // 2^53; beyond this, doubles skip numbers
    const bool whole = std::trunc(number) == number && std::fabs(number) <= largest_whole;
    if (!whole || (number == 0 && std::signbit(number))) return number;
    return static_cast<std::int64_t>(number);
}

Json to_json(const FactValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* number = std::get_if<double>(&value)) return number_json(*number);
    Json numbers = Json::array();
    for (const double number : std::get<std::vector<double>>(value)) {
        numbers.push_back(number_json(number));
    }
    return numbers;
}

Json to_json(const Facts& facts) {
    Json json = Json::object();
    for (const auto& [name, value] : facts) json[name] = to_json(value);
    return json;
}

Json to_json(const AxisMapping& axis) {
    return {{"quantity", axis.quantity},
            {"formula", axis.formula},
            {"convention", axis.convention},
            {"first", axis.first},
            {"last", axis.last},
            {"end_points", to_string(axis.end_points)},
            {"wrap", to_string(axis.wrap)},
            {"filter", to_string(axis.filter)},
            {"constants", to_json(axis.constants)}};
}

Json color_error_json(const ColorError& error) {
    return {{"median", error.median},
            {"ninth_decile", error.ninth_decile},
            {"max", error.max},
            {"disc_at_5_1_0_deg", error.disc},
            {"skies", error.skies}};
}

Json to_json(const std::optional<Certificate>& certificate) {
    if (!certificate) return nullptr;
    const Certificate& c = *certificate;
    Json json = {{"texel", {{"max", c.texel.max}, {"rms", c.texel.rms}}},
                 {"lookup", {{"max", c.lookup.max}, {"rms", c.lookup.rms}}},
                 {"reference", c.reference},
                 {"points", c.lookup_points},
                 {"texel_points", c.texel_points},
                 {"scale", c.scale},
                 {"worst", c.worst},
                 {"advice", c.advice}};
    if (c.sky) json["sky"] = sky_error_json(*c.sky);
    if (c.color) json["color"] = color_error_json(*c.color);
    return json;
}

Json place_json(const std::vector<std::pair<std::string, double>>& place) {
    Json at = Json::object();
    for (const auto& [quantity, value] : place) at[quantity] = value;
    return at;
}

// A table's `w` is left out, because it is always 1/2.
Json probe_json(const Probe& probe, bool of_volume) {
    Json json = {{"at", place_json(probe.at)}};
    if (of_volume) {
        json["uvw"] = probe.uvw;
    } else {
        json["uv"] = {probe.uvw[0], probe.uvw[1]};
    }
    if (probe.blend) json["blend"] = {{"uvw", probe.blend->uvw}, {"share", probe.blend->share}};
    json["value"] = probe.value;
    json["tolerance"] = probe.tolerance;
    if (!probe.column_km.empty()) json["column_km"] = probe.column_km;
    return json;
}

Json to_json(const ValueStatistics& statistics) {
    return {
        {"min", statistics.min},
        {"max", statistics.max},
        {"mean", statistics.mean},
        {"histogram", {{"range", statistics.histogram_range}, {"counts", statistics.histogram}}}};
}

template <class T>
Json array_of(const std::vector<T>& elements) {
    Json json = Json::array();
    for (const T& element : elements) json.push_back(to_json(element));
    return json;
}

Json probes_json(const ManifestLevel& level, bool of_volume) {
    Json json = Json::array();
    for (const Probe& probe : level.probes) json.push_back(probe_json(probe, of_volume));
    return json;
}

Json mip_json(const ManifestLevel& level, bool of_volume) {
    std::vector<int> size(level.size.begin(), level.size.begin() + (of_volume ? 3 : 2));
    return {{"size", std::move(size)},
            {"statistics", array_of(level.statistics)},
            {"probes", probes_json(level, of_volume)},
            {"catches", level.catches},
            {"content_hash", level.content_hash}};
}

Json mapping_json(const ManifestAsset& asset) {
    constexpr std::array names = {"u", "v", "w"};
    Json json = {{"name", asset.mapping}};
    for (std::size_t i = 0; i < asset.axes.size(); ++i) json[names[i]] = to_json(asset.axes[i]);
    return json;
}

// Adds the levels. Level 0 is the asset itself.
void add_levels(const ManifestAsset& asset, Json& json) {
    json["probes"] = probes_json(asset.levels[0], asset.is_volume());
    json["catches"] = asset.levels[0].catches;
    json["statistics"] = array_of(asset.levels[0].statistics);
    if (asset.is_volume()) json["seam_error"] = asset.seam_error;
    json["mips"] = Json::array();
    for (std::size_t i = 1; i < asset.levels.size(); ++i) {
        json["mips"].push_back(mip_json(asset.levels[i], asset.is_volume()));
    }
}

Json to_json(const ColorConvention& color) {
    return {
        {"space", color.space},       {"white", color.white},           {"sun", color.sun},
        {"observer", color.observer}, {"is_applied", color.is_applied}, {"weights", color.weights}};
}

// Leaves out members that do not apply to the asset.
Json to_json(const Conventions& conventions, bool of_volume) {
    Json json = Json::object();
    const auto add_text = [&json](const char* name, const std::string& text) {
        if (!text.empty()) json[name] = text;
    };
    add_text("length_unit", conventions.length_unit);
    add_text("coefficient_unit", conventions.coefficient_unit);
    add_text("angle_unit", conventions.angle_unit);
    add_text("radiance_unit", conventions.radiance_unit);
    if (!conventions.solar_irradiance.empty()) {
        json["solar_irradiance"] = to_json(FactValue(conventions.solar_irradiance));
    }
    if (!conventions.wavelengths_nm.empty()) {
        json["wavelengths_nm"] = to_json(FactValue(conventions.wavelengths_nm));
    }
    if (conventions.color) json["color"] = to_json(*conventions.color);
    add_text("up_axis", conventions.up_axis);
    json["texel_origin"] =
        of_volume ? "first voxel u = 0, v = 0, w = 0" : "first column u = 0, first row v = 0";
    return json;
}

Json to_json(const ManifestAsset& asset) {
    Json json = {{"name", asset.name},       {"kind", asset.kind},
                 {"content", asset.content}, {"files", array_of(asset.files)},
                 {"size", asset.size},       {"channels", asset.channels}};
    json["conventions"] = to_json(asset.conventions, asset.is_volume());
    json["mapping"] = mapping_json(asset);
    json["timing"] = {{"light_s", asset.timing.bake.light},
                      {"colors_s", asset.timing.bake.colors},
                      {"texels_s", asset.timing.bake.texels},
                      {"certificate_s", asset.timing.bake.certificate},
                      {"write_s", asset.timing.write_s},
                      {"threads", asset.timing.threads}};
    json["error"] = to_json(asset.error);
    json["range"] = {{"below_normal", asset.range.below_normal},
                     {"above_range", asset.range.above_range}};
    add_levels(asset, json);
    json["details"] = to_json(asset.details);
    json["parameters"] = asset.parameters;
    json["content_hash"] = asset.content_hash;
    json["release"] = asset.release;
    if (!asset.key.empty()) {
        json["key"] = asset.key;
        json["certification"] = asset.certification;
        json["inputs"] = array_of(asset.inputs);
    }
    json["hash"] = entry_hash(json);
    return json;
}

Json to_json(const config::Value& value) {
    struct Visitor {
        Json operator()(std::monostate) const { return nullptr; }
        Json operator()(bool flag) const { return flag; }
        Json operator()(std::int64_t number) const { return number; }
        Json operator()(double number) const { return number; }
        Json operator()(const std::string& text) const { return text; }
        Json operator()(const config::Array& array) const {
            Json result = Json::array();
            for (const config::Value& element : array) result.push_back(to_json(element));
            return result;
        }
        Json operator()(const config::Table& table) const {
            Json result = Json::object();
            for (const config::Entry& entry : table) result[entry.key] = to_json(entry.value);
            return result;
        }
    };
    return std::visit(Visitor{}, value.data);
}

// Invalid UTF-8 in a string must not cause an exception, so it is replaced by U+FFFD.
std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json sky_error_json(const SkyError& error) {
    Json json = {{"median", error.median},
                 {"ninth_decile", error.ninth_decile},
                 {"max", error.max},
                 {"standard_error", error.standard_error},
                 {"points", error.points},
                 {"left_out", error.left_out},
                 {"reference", error.reference},
                 {"worst", error.worst}};
    if (error.worst_sun_deg) json["worst_sun_elevation_deg"] = *error.worst_sun_deg;
    if (!error.better.empty()) json["better"] = error.better;
    return json;
}

std::string manifest_json(const Manifest& manifest) {
    Json assets = Json::array();
    for (const ManifestAsset& asset : manifest.assets) assets.push_back(to_json(asset));
    Json parameters = Json::parse(manifest.parameters, nullptr, false);
    if (!parameters.is_object()) parameters = Json::object();
    Json json = {{"format", manifest_format},
                 {"tool", {{"name", manifest.tool_name}, {"version", manifest.tool_version}}},
                 {"parameters", std::move(parameters)},
                 {"assets", std::move(assets)}};
    if (!manifest.retired.empty()) json["retired"] = array_of(manifest.retired);
    json["hash"] = manifest_hash(json);
    return text_of(json, 2) + "\n";
}

std::string file_entry_json(const ManifestAsset& asset, const ManifestFile& file) {
    ManifestAsset of_file = asset;
    of_file.files = {file};
    const auto first = asset.levels.begin() + file.level;
    of_file.levels = {first, first + file.levels};
    of_file.size = size_of(asset, file);
    of_file.content_hash = first->content_hash;
    Json json = to_json(of_file);
    for (const char* changing : {"timing", "hash", "key", "certification", "inputs"}) {
        json.erase(changing);
    }
    for (const char* changing : {"path", "bytes", "xxh3"}) json["files"][0].erase(changing);
    return text_of(json, -1);
}

std::string parameters_json(std::span<const config::ResolvedValue> values) {
    Json root = Json::object();
    for (const config::ResolvedValue& value : values) {
        const auto path = config::split_path(value.path);
        if (!path || path->empty()) continue;
        Json* table = &root;
        for (std::size_t i = 0; i + 1 < path->size(); ++i) {
            Json& next = (*table)[(*path)[i]];
            if (!next.is_object()) next = Json::object();
            table = &next;
        }
        const auto parsed = config::parse_toml_value(value.canonical);
        (*table)[path->back()] = parsed ? to_json(*parsed) : Json(value.canonical);
    }
    return text_of(root, -1);
}

}  // namespace skybake
