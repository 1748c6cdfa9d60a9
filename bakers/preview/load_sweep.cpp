#include "bakers/preview/load_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <variant>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/release.h"
#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/variants.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
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

SweptFigures read_figures(const Json& asset) {
    SweptFigures figures = {{"bytes", asset.at("bytes").get<double>()}};
    if (const Json& sky = asset.at("sky_error"); !sky.is_null()) {
        figures["sky_median"] = sky.at("median").get<double>();
        figures["sky_p90"] = sky.at("ninth_decile").get<double>();
        figures["sky_max"] = sky.at("max").get<double>();
    }
    if (const Json& lookup = asset.at("lookup_error"); !lookup.is_null()) {
        figures["lookup_max"] = lookup.at("max").get<double>();
        figures["lookup_rms"] = lookup.at("rms").get<double>();
    }
    return figures;
}

// Reads a variant. Throws nlohmann's exceptions if a field is missing or has another type.
SweepVariant read_variant(const Json& json, const std::vector<std::string>& paths,
                          PreviewSweep& sweep) {
    SweepVariant variant;
    variant.index = json.at("index").get<int>();
    variant.name = json.at("name").get<std::string>();
    variant.status = json.at("status").get<std::string>();
    for (const std::string& path : paths) {
        variant.values.push_back(swept_value(json.at("values").at(path)));
    }
    if (!json.contains("assets")) return variant;
    for (const Json& asset : json.at("assets")) {
        const auto name = asset.at("name").get<std::string>();
        variant.figures[name] = read_figures(asset);
        if (std::ranges::find(sweep.assets, name) == sweep.assets.end()) {
            sweep.assets.push_back(name);
        }
    }
    return variant;
}

// Returns the labels of an axis whose keys have these names.
std::vector<std::string> read_labels(const Json& axis, std::span<const std::string> names) {
    std::vector<std::string> labels;
    for (const Json& point : axis.at("values")) {
        std::string label;
        for (std::size_t i = 0; i < names.size(); ++i) {
            label +=
                fmt::format("{}{} {}", i == 0 ? "" : ", ", names[i], swept_value(point.at(i)).text);
        }
        labels.push_back(std::move(label));
    }
    return labels;
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
    std::span<const std::string> names = sweep.names;
    double count = 1;
    for (const Json& axis : json.at("axes")) {
        const std::size_t keys = axis.at("paths").size();
        sweep.axes.push_back(read_labels(axis, names.first(keys)));
        names = names.subspan(keys);
        count *= static_cast<double>(sweep.axes.back().size());
    }
    for (const Json& variant : json.at("variants")) {
        sweep.variants.push_back(read_variant(variant, paths, sweep));
        const SweepVariant& read = sweep.variants.back();
        if (!is_plain_name(read.name) || read.index < 0 || read.index >= count) return std::nullopt;
    }
    return sweep;
}

// Adds the times of timing.csv, of which index and asset are the first columns. Names of variants may
// have commas and are the last column, so that fields before them have none.
void add_times(std::istream& csv, PreviewSweep& sweep) {
    std::map<std::string, SweepVariant*> variants;
    for (SweepVariant& variant : sweep.variants) variants[std::to_string(variant.index)] = &variant;
    std::string header, line;
    std::getline(csv, header);
    const std::vector<std::string_view> titles = config::pieces_between(header, ',');
    while (std::getline(csv, line)) {
        const std::vector<std::string_view> fields = config::pieces_between(line, ',');
        if (fields.size() < titles.size()) continue;
        const auto variant = variants.find(std::string(fields[0]));
        if (variant == variants.end()) continue;
        const auto asset = variant->second->figures.find(std::string(fields[1]));
        if (asset == variant->second->figures.end()) continue;
        for (std::size_t i = 2; i < titles.size(); ++i) {
            double seconds = 0;
            const char* const end = fields[i].data() + fields[i].size();
            if (titles[i].ends_with("_s") &&
                std::from_chars(fields[i].data(), end, seconds).ptr == end) {
                asset->second.emplace(titles[i], seconds);
            }
        }
    }
}

}  // namespace

std::optional<double> figure_of(const SweepVariant& variant, const std::string& asset,
                                std::string_view figure) {
    const auto figures = variant.figures.find(asset);
    if (figures == variant.figures.end()) return std::nullopt;
    const auto found = figures->second.find(figure);
    return found == figures->second.end() ? std::nullopt : std::optional(found->second);
}

std::size_t PreviewSweep::place(const SweepVariant& variant, std::size_t axis) const {
    auto rest = static_cast<std::size_t>(variant.index);
    for (std::size_t i = axes.size(); --i > axis;) rest /= axes[i].size();
    return rest % axes[axis].size();
}

std::string PreviewSweep::label(const SweepVariant& variant, std::size_t first) const {
    std::string text;
    for (std::size_t axis = first; axis < axes.size(); ++axis) {
        text += (axis == first ? "" : ", ") + axes[axis][place(variant, axis)];
    }
    return text;
}

bool is_sweep_folder(const fs::path& folder) {
    std::error_code error;
    return fs::is_regular_file(folder / sweep_manifest_name, error);
}

Outcome<PreviewSweep> load_sweep(const fs::path& folder) {
    constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;
    const fs::path file = folder / sweep_manifest_name;
    const Outcome<std::string> text = read_file(file, largest);
    if (!text.value) return {{}, text.diagnostics};
    std::string reason = "skybake did not write it";
    try {
        const Json json = Json::parse(*text.value);
        if (const int format = json.at("format").get<int>(); format != sweep_format) {
            reason = fmt::format("it has format {} in place of {}; run the sweep again", format,
                                 sweep_format);
        } else if (std::optional<PreviewSweep> sweep = read_sweep(json)) {
            std::ifstream times(folder / sweep_timing_name);
            add_times(times, *sweep);
            return {std::move(sweep), {}};
        }
    } catch (const nlohmann::json::exception& error) {
        reason = error.what();
    }
    return file_error("E0304", file.string(),
                      fmt::format("cannot read `{}` as a sweep: {}", file.string(), reason));
}

}  // namespace skybake
