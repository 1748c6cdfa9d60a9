#include "bakers/workspace/sweep/index_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/manifest/release.h"
#include "config/diagnostics/toml_source.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;  // keys stay in the order of the schema

Json to_json(const config::Value& value);

Json to_json(const config::Array& array) {
    Json list = Json::array();
    for (const config::Value& item : array) list.push_back(to_json(item));
    return list;
}

// Converts the value of a recipe's key.
Json to_json(const config::Value& value) {
    if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
    if (const auto* integer = std::get_if<std::int64_t>(&value.data)) return *integer;
    if (const auto* number = std::get_if<double>(&value.data)) return *number;
    if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
    if (const auto* array = std::get_if<config::Array>(&value.data)) return to_json(*array);
    return nullptr;
}

Json to_json(const config::SweepValue& value) {
    const auto parsed = config::parse_toml_value(value.toml);
    return parsed ? to_json(*parsed) : Json(value.plain);
}

Json to_json(const std::optional<ErrorFigures>& figures) {
    if (!figures) return nullptr;
    return {{"max", figures->max}, {"rms", figures->rms}};
}

Json to_json(const std::optional<SkyError>& error) {
    if (!error) return nullptr;
    return {{"median", error->median}, {"ninth_decile", error->ninth_decile}, {"max", error->max}};
}

Json to_json(const VariantAsset& asset, const std::string& folder) {
    Json files = Json::array();
    for (const std::string& file : asset.files) files.push_back(folder + "/" + file);
    return {{"name", asset.name},
            {"kind", asset.kind},
            {"size", asset.size},
            {"sky_error", to_json(asset.sky_error)},
            {"lookup_error", to_json(asset.lookup_error)},
            {"texel_error", to_json(asset.texel_error)},
            {"bytes", asset.bytes},
            {"cover", asset.cover ? Json(*asset.cover) : Json()},
            {"content_hash", asset.content_hash},
            {"files", std::move(files)}};
}

Json errors_json(const VariantResult& variant) {
    Json errors = Json::array();
    for (const Diagnostic& diagnostic : variant.diagnostics) {
        if (diagnostic.severity != Severity::error) continue;
        errors.push_back({{"code", diagnostic.code}, {"message", diagnostic.message}});
    }
    return errors;
}

Json values_json(const config::Sweep& sweep, int index) {
    const std::vector<std::string> paths = swept_paths(sweep);
    const std::vector<config::SweepValue> values = variant_values(sweep, index);
    Json json = Json::object();
    for (std::size_t i = 0; i < paths.size(); ++i) json[paths[i]] = to_json(values[i]);
    return json;
}

Json variant_json(const config::Sweep& sweep, const VariantResult& variant) {
    Json json = {{"index", variant.index},
                 {"name", variant.name},
                 {"values", values_json(sweep, variant.index)},
                 {"status", to_string(variant.status)}};
    if (variant.status == VariantStatus::done) {
        Json assets = Json::array();
        for (const VariantAsset& asset : variant.assets) {
            assets.push_back(to_json(asset, variant.name));
        }
        json["assets"] = std::move(assets);
    }
    if (variant.status == VariantStatus::failed) json["errors"] = errors_json(variant);
    return json;
}

// Invalid UTF-8 in a string must not cause an exception, so it is replaced by U+FFFD.
std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields)
        line += (&field == &fields[0] ? "" : ",") + csv_field(field);
    return line + "\n";
}

// Returns the shortest decimal that reads back as the same number.
std::string figure_to_string(double value) { return Json(value).dump(); }

// Returns the names of all assets of any variant, in the order of their first occurrence.
std::vector<std::string> asset_names(std::span<const VariantResult> variants) {
    std::vector<std::string> names;
    for (const VariantResult& variant : variants) {
        if (variant.status != VariantStatus::done) continue;
        for (const VariantAsset& asset : variant.assets) {
            if (std::ranges::find(names, asset.name) == names.end()) {
                names.push_back(asset.name);
            }
        }
    }
    return names;
}

constexpr std::array asset_columns = {"sky_median", "sky_p90",      "sky_max",   "lookup_max",
                                      "lookup_rms", "texel_max",    "texel_rms", "bytes",
                                      "cover",      "content_hash", "files"};

std::vector<std::string> csv_header(const config::Sweep& sweep,
                                    const std::vector<std::string>& assets) {
    std::vector<std::string> fields = {"index", "name"};
    for (std::string& path : swept_paths(sweep)) fields.push_back(std::move(path));
    fields.insert(fields.end(), {"status", "error"});
    for (const std::string& asset : assets) {
        for (const char* column : asset_columns) fields.push_back(asset + "." + column);
    }
    return fields;
}

void add_figures(const std::optional<ErrorFigures>& figures, std::vector<std::string>& fields) {
    fields.push_back(figures ? figure_to_string(figures->max) : "");
    fields.push_back(figures ? figure_to_string(figures->rms) : "");
}

void add_asset(const VariantResult& variant, const std::string& name,
               std::vector<std::string>& fields) {
    const auto asset = std::ranges::find(variant.assets, name, &VariantAsset::name);
    if (variant.status != VariantStatus::done || asset == variant.assets.end()) {
        fields.insert(fields.end(), asset_columns.size(), "");
        return;
    }
    for (double SkyError::*const figure :
         {&SkyError::median, &SkyError::ninth_decile, &SkyError::max}) {
        fields.push_back(asset->sky_error ? figure_to_string((*asset->sky_error).*figure) : "");
    }
    add_figures(asset->lookup_error, fields);
    add_figures(asset->texel_error, fields);
    fields.push_back(fmt::format("{}", asset->bytes));
    fields.push_back(asset->cover ? figure_to_string(*asset->cover) : "");
    fields.push_back(asset->content_hash);
    std::string files;
    for (const std::string& file : asset->files) {
        files += (files.empty() ? "" : " ") + variant.name + "/" + file;
    }
    fields.push_back(std::move(files));
}

Json axis_json(const config::SweepAxis& axis) {
    Json values = Json::array();
    for (const auto& row : axis.rows) {
        Json point = Json::array();
        for (const config::SweepValue& value : row) point.push_back(to_json(value));
        values.push_back(std::move(point));
    }
    return {{"paths", axis.paths}, {"values", std::move(values)}};
}

bool is_sweep_manifest(const fs::path& file) {
    constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;
    const auto text = read_file(file, largest);
    const Json json = text.value ? Json::parse(*text.value, nullptr, false) : Json();
    const auto name = Json::json_pointer("/tool/name");
    return json.is_object() && json.contains("axes") && json.contains(name) &&
           json.at(name) == tool_name();
}

}  // namespace

std::string index_csv(const config::Sweep& sweep, std::span<const VariantResult> variants) {
    const std::vector<std::string> assets = asset_names(variants);
    std::string text = csv_line(csv_header(sweep, assets));
    for (const VariantResult& variant : variants) {
        std::vector<std::string> fields = {fmt::format("{}", variant.index), variant.name};
        for (config::SweepValue& value : variant_values(sweep, variant.index)) {
            fields.push_back(std::move(value.plain));
        }
        fields.emplace_back(to_string(variant.status));
        fields.push_back(first_error(variant));
        for (const std::string& asset : assets) add_asset(variant, asset, fields);
        text += csv_line(fields);
    }
    return text;
}

std::string timing_csv(std::span<const VariantResult> variants) {
    // The columns of times are the members of `timing` in a manifest.
    std::string text = csv_line({"index", "asset", "light_s", "colors_s", "texels_s",
                                 "certificate_s", "write_s", "threads", "name"});
    for (const VariantResult& variant : variants) {
        if (variant.status != VariantStatus::done) continue;
        for (const VariantAsset& asset : variant.assets) {
            const Timing& timing = asset.timing;
            std::vector<std::string> fields = {std::to_string(variant.index), asset.name};
            for (const double seconds : {timing.bake.light, timing.bake.colors, timing.bake.texels,
                                         timing.bake.certificate, timing.write_s}) {
                fields.push_back(figure_to_string(seconds));
            }
            fields.push_back(std::to_string(timing.threads));
            fields.push_back(variant.name);
            text += csv_line(fields);
        }
    }
    return text;
}

std::string index_jsonl(const config::Sweep& sweep, std::span<const VariantResult> variants) {
    std::string text;
    for (const VariantResult& variant : variants) {
        text += text_of(variant_json(sweep, variant), -1);
    }
    return text;
}

std::string sweep_json(const config::Sweep& sweep, std::span<const VariantResult> variants) {
    Json axes = Json::array();
    for (const config::SweepAxis& axis : sweep.axes) axes.push_back(axis_json(axis));
    Json listed = Json::array();
    for (const VariantResult& variant : variants) listed.push_back(variant_json(sweep, variant));
    const Json json = {{"format", sweep_format},
                       {"tool", {{"name", tool_name()}, {"version", release()}}},
                       {"axes", std::move(axes)},
                       {"variants", std::move(listed)}};
    return text_of(json, 2);
}

std::vector<Diagnostic> inspect_index(const fs::path& folder, bool force) {
    const auto usable = inspect_output_folder(folder, {}, force);
    if (!usable.value || force) return usable.diagnostics;
    // A sweep would mix its folders with the files of a bake.
    if (usable.value->previous) {
        return {file_error(
            "E0303", folder.string(),
            fmt::format("`{}` holds a bake: it has a {}", folder.string(), manifest_name),
            "choose another folder with -o, or sweep into this one with --force")};
    }
    if (is_sweep_manifest(folder / sweep_manifest_name)) return {};
    std::vector<Diagnostic> diagnostics;
    for (const std::string_view name : index_names) {
        std::error_code error;
        const fs::path file = folder / name;
        if (!fs::exists(fs::symlink_status(file, error))) continue;
        diagnostics.push_back(foreign_file(file, "no manifest there lists it"));
    }
    return diagnostics;
}

std::vector<Diagnostic> write_index(const fs::path& folder, const config::Sweep& sweep,
                                    std::span<const VariantResult> variants) {
    const auto made = create_output_folder(folder);
    if (!made.value) return made.diagnostics;
    const std::array texts = {index_csv(sweep, variants), index_jsonl(sweep, variants),
                              sweep_json(sweep, variants), timing_csv(variants)};
    AtomicFiles files;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto staged = files.stage(folder / index_names[i], std::string_view(texts[i]));
        if (!staged.value) return staged.diagnostics;
    }
    return files.commit();
}

}  // namespace skybake
