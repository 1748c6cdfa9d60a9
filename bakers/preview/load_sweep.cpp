#include "bakers/preview/load_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/release.h"
#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/variants.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

SweptValue swept_value(const Json& json) {
    if (json.is_number()) return {json.dump(), json.get<double>()};
    if (!json.is_string()) return {json.dump(), std::nullopt};
    SweptValue value{json.get<std::string>(), std::nullopt};
    const auto parsed = config::parse_quantity(value.text);
    if (const auto* quantity = std::get_if<config::Quantity>(&parsed)) {
        value.number = quantity->value;
    }
    return value;
}

// Whether the name is a plain one, so that a variant's folder is inside the sweep's folder.
bool is_plain_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." &&
           name.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

// Reads a variant. Throws nlohmann's exceptions if a field is missing or has another type.
SweepVariant read_variant(const Json& json, const std::vector<std::string>& paths,
                          PreviewSweep& sweep) {
    SweepVariant variant;
    variant.name = json.at("name").get<std::string>();
    variant.status = json.at("status").get<std::string>();
    for (const std::string& path : paths) {
        variant.values.push_back(swept_value(json.at("values").at(path)));
    }
    if (!json.contains("assets")) return variant;
    for (const Json& asset : json.at("assets")) {
        const Json& error = asset.at("lookup_error");
        if (error.is_null()) continue;
        const auto name = asset.at("name").get<std::string>();
        variant.lookup_errors[name] = {error.at("max").get<double>(),
                                       error.at("rms").get<double>()};
        if (std::find(sweep.assets.begin(), sweep.assets.end(), name) == sweep.assets.end()) {
            sweep.assets.push_back(name);
        }
    }
    return variant;
}

std::optional<PreviewSweep> read_sweep(const Json& json) {
    if (json.at("tool").at("name").get<std::string>() != tool_name()) return std::nullopt;
    PreviewSweep sweep;
    std::vector<std::string> paths;
    for (const Json& axis : json.at("axes")) {
        for (const Json& path : axis.at("paths")) paths.push_back(path.get<std::string>());
    }
    for (const std::string& path : paths) {
        if (!config::split_path(path)) return std::nullopt;
    }
    sweep.names = distinguishing_names(paths);
    for (const Json& variant : json.at("variants")) {
        sweep.variants.push_back(read_variant(variant, paths, sweep));
        if (!is_plain_name(sweep.variants.back().name)) return std::nullopt;
    }
    return sweep;
}

}  // namespace

bool is_sweep_folder(const fs::path& folder) {
    std::error_code error;
    return fs::is_regular_file(folder / sweep_manifest_name, error);
}

config::Outcome<PreviewSweep> load_sweep(const fs::path& folder) {
    constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;
    const fs::path file = folder / sweep_manifest_name;
    const config::Outcome<std::string> text = read_file(file, largest);
    if (!text.value) return {{}, text.diagnostics};
    std::string reason = "skybake did not write it";
    try {
        std::optional<PreviewSweep> sweep = read_sweep(Json::parse(*text.value));
        if (sweep) return {std::move(sweep), {}};
    } catch (const nlohmann::json::exception& error) {
        reason = error.what();
    }
    return {{},
            {file_error("E0304", file.string(),
                        fmt::format("cannot read `{}` as a sweep: {}", file.string(), reason))}};
}

}  // namespace skybake
