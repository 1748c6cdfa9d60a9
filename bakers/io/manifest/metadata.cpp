#include "bakers/io/manifest/metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/release.h"
#include "config/diagnostics/toml_source.h"
#include "config/fields/fields.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

std::string details_text(const Facts& details) {
    std::string text;
    for (const auto& [name, value] : details) {
        text += fmt::format("{} = {}\n", name, fact_text(value));
    }
    return text;
}

// Writes one number if all colours have the same irradiance.
std::string irradiance_text(const std::vector<double>& irradiance) {
    const bool alike =
        std::ranges::all_of(irradiance, [&](double value) { return value == irradiance.front(); });
    return alike ? fmt::format("{}", irradiance.front())
                 : fmt::format("{}", fmt::join(irradiance, ", "));
}

std::string statistics_text(const std::vector<std::string>& channels, const ManifestLevel& level) {
    std::string text;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const ValueStatistics& s = level.statistics[c];
        text += fmt::format("{}: min {} max {} mean {} histogram {} to {}: {}\n", channels[c],
                            s.min, s.max, s.mean, s.histogram_range[0], s.histogram_range[1],
                            fmt::join(s.histogram, " "));
    }
    return text;
}

// "texel max 1e-7 rms 2e-8 (1024 points); lookup max ..."
std::string error_line(const std::optional<Certificate>& certificate) {
    if (!certificate) return "not measured";
    const Certificate& c = *certificate;
    std::string line;
    if (c.sky) {
        line = fmt::format(
            "sky median {} ninth decile {} max {} standard error {} ({} values), reference: {}; ",
            c.sky->median, c.sky->ninth_decile, c.sky->max, c.sky->standard_error, c.sky->points,
            c.sky->reference);
    }
    if (c.color) {
        line += fmt::format("colour median {} ninth decile {} max {} ({} skies); ", c.color->median,
                            c.color->ninth_decile, c.color->max, c.color->skies);
    }
    line += fmt::format(
        "lookup max {} rms {} ({} points); texel max {} rms {} ({} points); reference: {}; scale: "
        "{}",
        c.lookup.max, c.lookup.rms, c.lookup_points, c.texel.max, c.texel.rms, c.texel_points,
        c.reference, c.scale);
    if (!c.worst.empty()) line += fmt::format("; worst at {}", c.worst);
    return line;
}

std::string axis_line(const AxisMapping& axis) {
    return fmt::format("{} from {} to {}, {}: {}", axis.quantity, axis.first, axis.last,
                       axis.convention, axis.formula);
}

using Json = nlohmann::ordered_json;

// Whether a key only tells where other values come from (`include`, `preset`, `frequency`). The
// values that result are recorded beside it, and reading both would be a contradiction. `enabled`
// stays, because nothing else says it.
bool only_tells_the_origin(const std::string& table, const std::string& key) {
    const auto sections = config::sections();
    return std::ranges::any_of(sections, [&](const config::Section& section) {
        const bool is_root = table.empty() && section.path.empty();  // "" is no path of keys
        if (!is_root && !config::path_matches(table, std::string(section.path))) return false;
        const config::Field* field = config::find_field(section, key);
        return field != nullptr && field->only_shown && field->kind != config::Kind::flag;
    });
}

config::Value value_of(const Json& json);

config::Table table_of(const Json& json) {
    config::Table table;
    for (const auto& [key, value] : json.items()) table.push_back({key, {}, value_of(value)});
    std::ranges::sort(table,
                      [](const config::Entry& a, const config::Entry& b) { return a.key < b.key; });
    return table;
}

config::Value value_of(const Json& json) {
    config::Value value;
    if (json.is_boolean()) value.data = json.get<bool>();
    if (json.is_number_integer()) value.data = json.get<std::int64_t>();
    if (json.is_number_float()) value.data = json.get<double>();
    if (json.is_string()) value.data = json.get<std::string>();
    if (json.is_object()) value.data = table_of(json);
    if (json.is_array()) {
        config::Array array;
        for (const Json& element : json) array.push_back(value_of(element));
        value.data = std::move(array);
    }
    return value;
}

// The albedo of an aerosol stands for itself: its scattering is not recorded.
bool is_of_aerosol(const Json& table, const std::string& key) {
    return key == "single_scattering_albedo" &&
           (table.contains("optical_depth") || table.contains("visibility"));
}

// Appends the tables below `path`. Each table's own values come before its subtables.
void append_toml(const Json& table, const std::string& path, std::string& text) {
    if (!path.empty()) text += fmt::format("[{}]\n", path);
    for (const auto& [key, value] : table.items()) {
        if (value.is_object() || value.is_null()) continue;
        if (only_tells_the_origin(path, key) && !is_of_aerosol(table, key)) continue;
        text += fmt::format("{} = {}\n", config::key_to_string(key),
                            config::value_to_string(value_of(value)));
    }
    for (const auto& [key, value] : table.items()) {
        if (value.is_object()) append_toml(value, config::join_path(path, key), text);
    }
}

}  // namespace

ManifestAsset describe(const Baked& baked) {
    ManifestAsset asset;
    asset.name = baked.name;
    asset.kind = baked.kind;
    asset.content = baked.content;
    asset.channels = baked.channel_names;
    asset.mapping = baked.mapping;
    asset.axes = baked.axes;
    if (baked.certified) asset.error = baked.certificate;
    asset.range = baked.range;
    asset.conventions = baked.conventions;
    asset.details = baked.details;
    asset.parameters = baked.parameters;
    asset.release = release();
    asset.seam_error = baked.seam_error;
    for (const Level& level : baked.levels) {
        asset.levels.push_back(
            {level.size, level.content_hash, level.statistics, level.probes, level.catches});
    }
    const std::array<int, 3>& size = asset.levels[0].size;
    asset.size.assign(size.begin(), size.begin() + static_cast<long>(asset.axes.size()));
    asset.content_hash = asset.levels[0].content_hash;
    return asset;
}

std::string units_line(const Conventions& conventions) {
    std::vector<std::string> parts;
    if (!conventions.length_unit.empty()) {
        parts.push_back(fmt::format("lengths and altitudes {}", conventions.length_unit));
    }
    if (!conventions.coefficient_unit.empty()) {
        parts.push_back(fmt::format("coefficients {}", conventions.coefficient_unit));
    }
    if (!conventions.angle_unit.empty()) {
        parts.push_back(conventions.angle_unit == "cosine"
                            ? "angles as cosines"
                            : fmt::format("angles {}", conventions.angle_unit));
    }
    if (!conventions.solar_irradiance.empty()) {
        parts.push_back(fmt::format(
            "{} for a solar irradiance E = {}",
            conventions.radiance_unit.empty() ? "values" : "radiance " + conventions.radiance_unit,
            irradiance_text(conventions.solar_irradiance)));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

FactLines entry_lines(const ManifestAsset& asset, const ManifestFile& file) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    FactLines lines = {
        {"kind", asset.kind},
        {"content", asset.content},
        {"channels", fmt::format("{}", fmt::join(asset.channels, " "))},
        {"size", fmt::format("{}", fmt::join(size_of(asset, file), " x "))},
        {"mapping", asset.mapping},
    };
    const std::string units = units_line(asset.conventions);
    if (!units.empty()) lines.emplace_back("units", units);
    if (file.layout && asset.is_volume()) {
        lines.emplace_back("layout", sheet_line(level.size, *file.layout));
    } else if (file.layout && file.layout->flipped) {
        lines.emplace_back("layout", "upside down: row 0 last");
    } else if (file.texture == TextureParts::cube) {
        lines.emplace_back("layout", "cube of six faces: +x, -x, +y, -y, +z, -z");
    } else if (file.texture == TextureParts::layers) {
        lines.emplace_back("layout", "array of 2-D textures, a layer for each slice");
    }
    for (std::size_t i = 0; i < asset.axes.size(); ++i) {
        lines.emplace_back(fmt::format("mapping_{}", "uvw"[i]), axis_line(asset.axes[i]));
    }
    lines.emplace_back("error", error_line(asset.error));
    if (asset.is_volume()) lines.emplace_back("seam_error", fmt::format("{}", asset.seam_error));
    lines.emplace_back("range", fmt::format("below_normal {}, above_range {}",
                                            asset.range.below_normal, asset.range.above_range));
    lines.emplace_back("probes", fmt::format("{}, which detect {}", level.probes.size(),
                                             fmt::join(level.catches, ", ")));
    lines.emplace_back("release", asset.release);
    lines.emplace_back("content_hash", level.content_hash);
    lines.emplace_back("statistics", statistics_text(asset.channels, level));
    lines.emplace_back("details", details_text(asset.details));
    lines.emplace_back("parameters", asset.parameters);
    return lines;
}

Outcome<ManifestAsset> entry_of_file(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    const Format* format = find_format(extension.empty() ? "exr" : extension.substr(1));
    if (format == nullptr) format = &format_of(config::FileFormat::exr);
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    std::string text;
    if (format->has_metadata) {
        const auto facts = format->inspect(*file.value);
        if (!facts.value) return {{}, facts.diagnostics};
        text = facts.value->metadata;
    }
    Outcome<ManifestAsset> entry = parse_file_entry(text, path.string());
    if (!entry.value) {
        return file_error(
            "E0304", path.string(),
            fmt::format(
                "`{}` does not say what it holds: it is no asset of skybake, or it is incomplete",
                path.string()),
            "a manifest.json in its folder may describe it");
    }
    entry.value->name = path.stem().string();
    entry.value->files[0].bytes = file.value->size();
    return entry;
}

Outcome<Recipe> recorded_recipe(const Manifest& manifest, const std::string& name,
                                const std::filesystem::path& folder) {
    const Json json = Json::parse(manifest.parameters, nullptr, false);
    std::string text;
    if (json.is_object()) append_toml(json, "", text);
    auto recipe = config::parse_recipe(text, name, folder);
    if (recipe.value) return {std::move(recipe.value), {}};  // its warnings were given at the bake
    const std::string reason =
        recipe.diagnostics.empty() ? "nothing is recorded" : recipe.diagnostics.front().message;
    return file_error("E0304", name,
                      fmt::format("cannot take the recipe from `{}`: {}", name, reason));
}

}  // namespace skybake
