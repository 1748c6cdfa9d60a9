#include "bakers/io/targets/sidecar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>

#include "bakers/field/baked.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/formats/usda/usda.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/formats/volume_camera.h"
#include "bakers/math/hash.h"
#include "bakers/math/transcendental.h"
#include "config/sections/frames.h"
#include "config/sections/targets.h"
#include "config/text/units.h"

namespace skybake {
namespace {

// NAME of the sequence, or of the asset.
std::string asset_stem(const Baked& baked) {
    return baked.frames > 0 ? config::sequence_name(baked.name) : baked.name;
}

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

// Adds what plays the numbered files of a sequence. Other assets have no frames, and one file.
void add_sequence(const Baked& baked, const ManifestFile& first, Values& values) {
    const std::string stem = asset_stem(baked);
    const std::string number = baked.frames > 0 ? baked.name.substr(stem.size() + 1) : "";
    values["PLAYS"] = baked.frames > 0 ? "yes" : "no";
    values["FRAMES"] = std::to_string(baked.frames);
    values["RATE"] = fmt::format("{}", baked.frames_per_second);
    values["DIGITS"] = std::to_string(number.size());
    values["FIRST"] = number;
    values["ENDING"] = first.path.substr(baked.name.size());
}

// A direction or a place of z up, where y points up and +z towards whoever looks ahead.
glm::dvec3 y_up(const glm::dvec3& v) { return {v.x, v.z, -v.y}; }

std::string vector_text(const glm::dvec3& v) {
    return fmt::format("{:.7g}, {:.7g}, {:.7g}", v.x, v.y, v.z);
}

// The rows of a matrix that has these columns, one after the other.
std::string rows_text(const glm::dmat3& columns) {
    const glm::dmat3 rows = glm::transpose(columns);
    return fmt::format("{}, {}, {}, ", vector_text(rows[0]), vector_text(rows[1]),
                       vector_text(rows[2]));
}

// The columns of a rotation that turns +z to a direction, as lamps that shine towards -z need.
glm::dmat3 lamp_axes(const glm::dvec3& to_sun) {
    const glm::dvec3 level(to_sun.z, 0, -to_sun.x);
    const glm::dvec3 x = glm::length(level) > 0 ? glm::normalize(level) : glm::dvec3(1, 0, 0);
    return {x, glm::cross(to_sun, x), to_sun};
}

// Adds the camera that has all of a volume in its picture.
void add_camera(const Baked& baked, Values& values) {
    const VolumeCamera camera = volume_camera(baked);
    const glm::dmat3 axes(y_up(camera.axes[0]), y_up(camera.axes[1]), y_up(camera.axes[2]));
    values["CAMERA_AT"] = vector_text(camera.position_m);
    values["CAMERA_AHEAD"] = vector_text(-camera.axes[2]);
    values["CAMERA_REACH"] = fmt::format("{:.7g}", camera.reach_m);
    values["CAMERA_BASIS"] = rows_text(axes) + vector_text(y_up(camera.position_m));
    for (glm::length_t i = 0; i < 3; ++i) {
        values[fmt::format("CAMERA_AXIS_{}", "XYZ"[i])] = vector_text(axes[i]);
    }
    // The angle of the whole picture along an edge of the sensor.
    const auto degrees = [](double edge_mm) {
        const double reach_mm = glm::length(glm::dvec2(camera_focal_length_mm, edge_mm / 2));
        return 2 * arc_cosine(camera_focal_length_mm / reach_mm) * 180 / std::numbers::pi;
    };
    values["CAMERA_ANGLE"] = fmt::format("{:.7g}", degrees(camera_width_mm));
    values["CAMERA_HEIGHT_ANGLE"] = fmt::format("{:.7g}", degrees(camera_height_mm));
    values["CAMERA_FOCAL"] = fmt::format("{}", camera_focal_length_mm);
    values["CAMERA_WIDTH"] = fmt::format("{}", camera_width_mm);
    values["CAMERA_AT_Y_UP"] = vector_text(y_up(camera.position_m));
}

// Adds a lamp in the place of the sun's disc: IRRADIANCE times the colour. A sun that is below the
// horizon, behind the clouds or in the map has none.
void add_lamp(const Baked& baked, Values& values) {
    constexpr std::array places = {"SUN_RIGHT", "SUN_UP", "SUN_AHEAD"};
    constexpr std::array colors = {"SUN_R", "SUN_G", "SUN_B"};
    const std::vector<double> sun = numbers_named(baked.details, "sun_direction");
    const std::vector<double> light = numbers_named(baked.details, "sun_irradiance");
    const double most = light.empty() ? 0 : *std::max_element(light.begin(), light.end());
    const bool shines = sun.size() == 3 && light.size() == 3 && most > 0;
    values["LAMP"] = shines ? "yes" : "no";
    const auto add = [&](std::string_view key, double value) {
        values.emplace(key, fmt::format("{:.7g}", shines ? value : 0));
    };
    for (std::size_t i = 0; i < 3; ++i) {
        add(places[i], shines ? sun[i] : 0);
        add(colors[i], shines ? light[i] / most : 0);
    }
    add("IRRADIANCE", most);
    values["SUN_RGB"] = fmt::format("{:.7g}", fmt::join(light, ", "));
    add("ENERGY", most / std::numbers::pi);
    if (!shines) return;
    values["SUN_RAY"] =
        fmt::format("x=\"{:.7g}\" y=\"{:.7g}\" z=\"{:.7g}\"", -sun[2], sun[0], -sun[1]);
    values["SUN_BASIS"] = rows_text(lamp_axes({sun[0], sun[1], -sun[2]}));
    // Domes of USD have the middle of the map at +z and what is right of it at -x.
    values["SUN_MATRIX"] = usd_matrix(lamp_axes({-sun[0], sun[1], sun[2]}), glm::dvec3(0));
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
        {"NAME", asset_stem(baked)},
        {"ID", identifier(asset_stem(baked))},
        {"FILE", asset.files.front().path},
        {"FORMAT", asset.files.front().format},
        {"KIND", baked.kind},
        {"IS_SKY", baked.kind == "environment" ? "yes" : "no"},
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
    const SheetGrid sheet = asset.files.front().layout.value_or(SheetGrid{});
    values["COLUMNS"] = std::to_string(sheet.columns);
    values["ROWS"] = std::to_string(sheet.rows);
    add_sequence(baked, asset.files.front(), values);
    add_lookup(baked, values);
    add_lamp(baked, values);
    add_sun(baked, values);
    add_place(baked, values);
    if (asset.is_volume()) add_camera(baked, values);
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
    return fmt::format(",{},", words).find(fmt::format(",{},", word)) != std::string::npos;
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
    const std::string text = "NAME" + name.substr(asset_stem(baked).size());
    Values values = values_of(baked, asset);
    values["GUID"] = guid_of(name);
    return filled_in(sidecar_template(text), values);
}

}  // namespace skybake
