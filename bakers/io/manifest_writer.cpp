#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bakers/io/conventions.h"
#include "bakers/io/manifest.h"
#include "bakers/io/manifest_format.h"
#include "bakers/io/spelling.h"
#include "config/key_path.h"
#include "config/toml_source.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the schema

Json to_json(const ManifestFile& file, bool of_volume) {
    Json json = {{"path", file.path},
                 {"format", file.format},
                 {"pixel_type", spell(file.pixel_type)},
                 {"bytes", file.bytes},
                 {"xxh3", file.xxh3}};
    if (!of_volume) return json;
    json["level"] = file.level;
    json["compression"] = file.compression;
    if (file.layout) {
        json["layout"] = {{"kind", spell(file.layout->kind)},
                          {"columns", file.layout->columns},
                          {"rows", file.layout->rows}};
        if (file.layout->flipped) json["layout"]["flipped"] = true;
    }
    if (!file.grids.empty()) json["grids"] = file.grids;
    return json;
}

Json to_json(const ManifestInput& input) { return {{"file", input.file}, {"xxh3", input.xxh3}}; }

Json to_json(const RetiredFile& file) { return {{"path", file.path}, {"xxh3", file.xxh3}}; }

Json to_json(const AxisMapping& axis) {
    return {{"quantity", axis.quantity},
            {"formula", axis.formula},
            {"convention", axis.convention},
            {"first", axis.first},
            {"last", axis.last}};
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
    if (c.sky) {
        json["sky"] = {{"median", c.sky->median},
                       {"ninth_decile", c.sky->ninth_decile},
                       {"max", c.sky->max},
                       {"points", c.sky->points},
                       {"reference", c.sky->reference}};
    }
    return json;
}

Json place_json(const std::vector<std::pair<std::string, double>>& place) {
    Json at = Json::object();
    for (const auto& [quantity, value] : place) at[quantity] = value;
    return at;
}

Json to_json(const Probe& probe) {
    return {{"at", place_json(probe.at)},
            {"uv", probe.uv},
            {"value", probe.value},
            {"tolerance", probe.tolerance}};
}

Json to_json(const VolumeProbe& probe) {
    Json json = {{"at", place_json(probe.at)}, {"uvw", probe.uvw}};
    if (probe.blend) json["blend"] = {{"uvw", probe.blend->uvw}, {"share", probe.blend->share}};
    json["value"] = probe.value;
    json["tolerance"] = probe.tolerance;
    return json;
}

Json to_json(const ValueStatistics& statistics) {
    return {
        {"min", statistics.min},
        {"max", statistics.max},
        {"mean", statistics.mean},
        {"histogram", {{"range", statistics.histogram_range}, {"counts", statistics.histogram}}}};
}

Json to_json(const ManifestLevel& level);

template <class T>
Json array_of(const std::vector<T>& elements) {
    Json json = Json::array();
    for (const T& element : elements) json.push_back(to_json(element));
    return json;
}

Json to_json(const ManifestLevel& level) {
    return {{"size", level.size},
            {"statistics", array_of(level.statistics)},
            {"probes", array_of(level.probes)},
            {"catches", level.catches},
            {"content_hash", level.content_hash}};
}

Json mapping_json(const ManifestAsset& asset) {
    constexpr std::array names = {"u", "v", "w"};
    Json json = {{"name", asset.mapping}};
    for (std::size_t i = 0; i < asset.axes.size(); ++i) json[names[i]] = to_json(asset.axes[i]);
    return json;
}

// What only volumes have. Level 0 is the asset itself.
void add_volume(const ManifestAsset& asset, Json& json) {
    json["probes"] = array_of(asset.levels[0].probes);
    json["catches"] = asset.levels[0].catches;
    json["statistics"] = array_of(asset.levels[0].statistics);
    json["seam_error"] = asset.seam_error;
    json["mips"] = array_of(std::vector(asset.levels.begin() + 1, asset.levels.end()));
}

Json to_json(const ManifestAsset& asset) {
    Json files = Json::array();
    for (const ManifestFile& file : asset.files) files.push_back(to_json(file, asset.is_volume()));
    Json details = Json::object();
    for (const auto& [key, value] : asset.details) details[key] = value;
    Json json = {{"name", asset.name},        {"kind", asset.kind}, {"content", asset.content},
                 {"files", std::move(files)}, {"size", asset.size}, {"channels", asset.channels}};
    if (!asset.is_volume()) json["compression"] = spell(asset.compression);
    json["mapping"] = mapping_json(asset);
    json["timing"] = {{"bake_s", asset.timing.bake_s},
                      {"write_s", asset.timing.write_s},
                      {"threads", asset.timing.threads}};
    json["error"] = to_json(asset.error);
    json["range"] = {{"below_normal", asset.range.below_normal},
                     {"above_range", asset.range.above_range}};
    if (asset.is_volume()) {
        add_volume(asset, json);
    } else {
        json["probes"] = array_of(asset.probes);
        json["catches"] = asset.catches;
    }
    json["details"] = std::move(details);
    json["parameters"] = asset.parameters;
    json["content_hash"] = asset.content_hash;
    json["release"] = asset.release;
    if (asset.key.empty()) return json;
    json["key"] = asset.key;
    json["certification"] = asset.certification;
    json["inputs"] = array_of(asset.inputs);
    return json;
}

Json conventions_json(const Manifest& manifest) {
    return {{"length_unit", conventions::length_unit},
            {"coefficient_unit", conventions::coefficient_unit},
            {"angle_unit", conventions::angle_unit},
            {"radiance_unit", conventions::radiance_unit},
            {"solar_irradiance", conventions::solar_irradiance},
            {"wavelengths_nm", manifest.wavelengths_nm},
            {"up_axis", conventions::up_axis},
            {"texel_origin", conventions::texel_origin}};
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

// Damaged text in a string must not become an exception: it is replaced by U+FFFD.
std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string manifest_json(const Manifest& manifest) {
    Json assets = Json::array();
    for (const ManifestAsset& asset : manifest.assets) assets.push_back(to_json(asset));
    Json parameters = Json::parse(manifest.parameters, nullptr, false);
    if (!parameters.is_object()) parameters = Json::object();
    Json json = {{"format", manifest_format},
                 {"tool", {{"name", manifest.tool_name}, {"version", manifest.tool_version}}},
                 {"conventions", conventions_json(manifest)},
                 {"parameters", std::move(parameters)},
                 {"assets", std::move(assets)}};
    if (!manifest.retired.empty()) json["retired"] = array_of(manifest.retired);
    return text_of(json, 2) + "\n";
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
