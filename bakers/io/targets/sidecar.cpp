#include "bakers/io/targets/sidecar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "bakers/field/baked.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/math/hash.h"
#include "bakers/math/transcendental.h"
#include "config/sections/targets.h"
#include "config/text/units.h"

namespace skybake {
namespace {

using Values = std::map<std::string, std::string, std::less<>>;

// Returns the name as most languages write names: letters, digits and underscores, no digit first.
std::string identifier(std::string name) {
    for (char& c : name) {
        if (c == '-') c = '_';
    }
    return name.front() >= '0' && name.front() <= '9' ? "_" + name : name;
}

void add_place(const Baked& baked, Values& values) {
    constexpr std::array axes = {'X', 'Y', 'Z'};
    for (std::size_t a = 0; a < 3; ++a) {
        const double extent = baked.voxel_size_m[a] * baked.levels.front().size[a];
        const auto add = [&](std::string_view what, double meters) {
            values[fmt::format("{}_{}", what, axes[a])] = fmt::format("{}", meters);
        };
        add("LOW", baked.minimum_m[a]);
        add("HIGH", baked.minimum_m[a] + extent);
        add("CENTER", baked.minimum_m[a] + extent / 2);
        add("EXTENT", extent);
        add("HALF", extent / 2);
    }
}

void add_lookup(const Baked& baked, Values& values) {
    constexpr std::array axes = {'U', 'V', 'W'};
    for (std::size_t a = 0; a < 3; ++a) {
        const bool repeats = baked.levels.front().repeats[a];
        values[fmt::format("WRAP_{}", axes[a])] = repeats ? "repeat" : "clamp";
    }
    values["FILTER"] = baked.levels.front().nearest ? "nearest" : "linear";
}

// Adds the facts about the sun of Bruneton's tables. An asset without it has 0 and no numbers.
void add_sun(const Baked& baked, Values& values) {
    const auto number = [&](const std::string& name) {
        return number_named(baked.details, name).value_or(0);
    };
    values["NU_SIZE"] = fmt::format("{}", number("nu_size"));
    values["SUN_ANGLE"] = fmt::format("{}", arc_cosine(number("sun_cos_zenith_min")));
    values["SOLAR"] = fmt::format("{}", fmt::join(baked.conventions.solar_irradiance, ", "));
}

// "over +x", or "40 degrees to the right of +x": where an environment has the sun. Its parameters say
// it.
std::string sun_place(const Baked& baked) {
    constexpr std::string_view key = "\nsun_azimuth = \"";
    const std::size_t at = baked.parameters.find(key);
    if (at == std::string::npos) return "over +x";
    const std::string_view text = std::string_view(baked.parameters).substr(at + key.size());
    const auto parsed = config::parse_quantity(text.substr(0, text.find('"')));
    const auto* angle = std::get_if<config::Quantity>(&parsed);
    const double degrees = angle ? std::remainder(angle->value * 180 / std::numbers::pi, 360) : 0;
    if (std::fabs(degrees) < 1e-9) return "over +x";
    return fmt::format("{:.6g} degrees to the {} of +x", std::fabs(degrees),
                       degrees > 0 ? "right" : "left");
}

// Returns what the texts may name.
Values values_of(const Baked& baked, const ManifestAsset& asset) {
    const std::array<int, 3>& size = baked.levels.front().size;
    const std::string extinction = fact_named(baked.details, "extinction_scale_per_m");
    Values values = {
        {"NAME", baked.name},
        {"ID", identifier(baked.name)},
        {"FILE", asset.files.front().path},
        {"FORMAT", asset.files.front().format},
        {"KIND", baked.kind},
        {"MAPPING", baked.mapping},
        {"PARTS", std::string(to_string(texture_parts(baked)))},
        {"TYPE", std::string(to_string(baked.pixel_type))},
        {"DIM", baked.is_table() ? "2" : "3"},
        {"FLAT", size[2] == 1 ? "yes" : "no"},
        {"WIDTH", std::to_string(size[0])},
        {"HEIGHT", std::to_string(size[1])},
        {"DEPTH", std::to_string(size[2])},
        {"LEVELS", std::to_string(baked.levels.size())},
        {"CHANNELS", std::to_string(baked.channel_names.size())},
        {"GRID", asset.is_volume() ? vdb_grid_names(baked).front() : ""},
        {"EXTINCTION", extinction.empty() ? "1" : extinction},
        {"SUN_PLACE", sun_place(baked)},
    };
    add_lookup(baked, values);
    add_sun(baked, values);
    add_place(baked, values);
    return values;
}

// Returns the identifier of the file beside which a sidecar NAME.meta stands. It follows from the
// file's name, so that a new bake keeps what refers to the file.
std::string guid_of(const std::string& name) {
    return xxh3_hex("skybake/" + name.substr(0, name.rfind('.')));
}

// Returns the text between the mark at `from` and the next one, and the place behind that.
std::pair<std::string_view, std::size_t> marked(std::string_view text, std::size_t from) {
    const std::size_t end = text.find('$', from + 1);
    assert(end != std::string_view::npos);
    return {text.substr(from + 1, end - from - 1), end + 1};
}

bool is_among(std::string_view word, std::string_view words) {
    while (true) {
        const std::size_t comma = words.find(',');
        if (words.substr(0, comma) == word) return true;
        if (comma == std::string_view::npos) return false;
        words.remove_prefix(comma + 1);
    }
}

// Drops the conditions at the head of a line. Returns whether the line stays.
bool meets_conditions(std::string_view& line, const Values& values) {
    constexpr std::string_view condition = "$if ";
    bool stays = true;
    while (line.starts_with(condition)) {
        auto [text, end] = marked(line, 0);
        text.remove_prefix(condition.size() - 1);
        const std::size_t equals = text.find('=');
        stays = is_among(values.at(std::string(text.substr(0, equals))), text.substr(equals + 1)) &&
                stays;
        line.remove_prefix(end);
    }
    return stays;
}

bool is_key(std::string_view word) {
    return !word.empty() && word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == word.npos;
}

void append_filled(std::string_view line, const Values& values, std::string& text) {
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t mark = line.find('$', at);
        text += line.substr(at, mark - at);
        if (mark == std::string_view::npos) return;
        const std::size_t end = line.find('$', mark + 1);
        const std::string_view key = line.substr(mark + 1, end - mark - 1);
        const bool is_filled = end != std::string_view::npos && is_key(key);
        text += is_filled ? values.at(std::string(key)) : "$";
        at = is_filled ? end + 1 : mark + 1;
    }
}

std::string filled_in(std::string_view pattern, const Values& values) {
    std::string text;
    while (!pattern.empty()) {
        const std::size_t end = pattern.find('\n') + 1;
        std::string_view line = pattern.substr(0, end);
        if (meets_conditions(line, values)) append_filled(line, values, text);
        pattern.remove_prefix(end);
    }
    return text;
}

}  // namespace

std::vector<std::string> sidecars_of(const Baked& baked) {
    return config::sidecar_names(baked, baked.kind, baked.name);
}

std::string sidecar_text(const Baked& baked, const ManifestAsset& asset, const std::string& name) {
    const std::string text = "NAME" + name.substr(baked.name.size());
    Values values = values_of(baked, asset);
    values["GUID"] = guid_of(name);
    return filled_in(sidecar_template(text), values);
}

}  // namespace skybake
