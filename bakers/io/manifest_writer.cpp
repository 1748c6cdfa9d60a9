#include <fmt/format.h>

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

Json to_json(const ManifestFile& file) {
    return {{"path", file.path},
            {"format", file.format},
            {"pixel_type", spell(file.pixel_type)},
            {"bytes", file.bytes},
            {"xxh3", file.xxh3}};
}

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
    return {{"texel", {{"max", c.texel.max}, {"rms", c.texel.rms}}},
            {"lookup", {{"max", c.lookup.max}, {"rms", c.lookup.rms}}},
            {"reference", c.reference},
            {"points", c.lookup_points},
            {"texel_points", c.texel_points},
            {"scale", c.scale},
            {"worst", c.worst},
            {"advice", c.advice}};
}

Json to_json(const Probe& probe) {
    Json at = Json::object();
    for (const auto& [quantity, value] : probe.at) at[quantity] = value;
    return {{"at", std::move(at)},
            {"uv", probe.uv},
            {"value", probe.value},
            {"tolerance", probe.tolerance}};
}

Json to_json(const ManifestAsset& asset) {
    Json files = Json::array();
    for (const ManifestFile& file : asset.files) files.push_back(to_json(file));
    Json probes = Json::array();
    for (const Probe& probe : asset.probes) probes.push_back(to_json(probe));
    Json details = Json::object();
    for (const auto& [key, value] : asset.details) details[key] = value;
    return {
        {"name", asset.name},
        {"kind", asset.kind},
        {"content", asset.content},
        {"files", std::move(files)},
        {"size", asset.size},
        {"channels", asset.channels},
        {"compression", spell(asset.compression)},
        {"mapping",
         {{"name", asset.mapping}, {"u", to_json(asset.axes[0])}, {"v", to_json(asset.axes[1])}}},
        {"timing",
         {{"bake_s", asset.timing.bake_s},
          {"write_s", asset.timing.write_s},
          {"threads", asset.timing.threads}}},
        {"error", to_json(asset.error)},
        {"range",
         {{"below_normal", asset.range.below_normal}, {"above_range", asset.range.above_range}}},
        {"probes", std::move(probes)},
        {"details", std::move(details)},
        {"parameters", asset.parameters},
        {"content_hash", asset.content_hash},
        {"release", asset.release}};
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
    const Json json = {{"format", manifest_format},
                       {"tool", {{"name", manifest.tool_name}, {"version", manifest.tool_version}}},
                       {"conventions", conventions_json(manifest)},
                       {"parameters", std::move(parameters)},
                       {"assets", std::move(assets)}};
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
