// skybake show: prints every resolved value of a recipe and where it came from. The output is TOML.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/table_printer.h"
#include "config/recipe/recipe.h"
#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::cli {
namespace {

using Names = std::vector<std::string>;

// This is a value whose path is split into the table and the key.
struct Line {
    std::string table;
    std::string key;
    const config::ResolvedValue* value = nullptr;
};

Line make_line(const config::ResolvedValue& value) {
    const Names names = config::split_path(value.path).value_or(Names{});
    Line line;
    line.value = &value;
    for (std::size_t i = 0; i + 1 < names.size(); ++i) {
        line.table = config::join_path(line.table, names[i]);
    }
    if (!names.empty()) line.key = config::key_to_string(names.back());
    return line;
}

// Whether a path is the one asked for or lies below it. A `*` in the path asked for stands for any
// name.
bool is_below(std::string_view path, const Names& asked) {
    const Names names = config::split_path(path).value_or(Names{});
    if (names.size() < asked.size()) return false;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (asked[i] != "*" && asked[i] != names[i]) return false;
    }
    return true;
}

std::vector<Line> lines_below(const Recipe& recipe, const Names& asked) {
    std::vector<Line> lines;
    for (const auto* values : {&recipe.values, &recipe.sweep_values}) {
        for (const config::ResolvedValue& value : *values) {
            if (is_below(value.path, asked)) lines.push_back(make_line(value));
        }
    }
    return lines;
}

// Writes the keys, values and origins of one table in aligned columns. A long value does not move
// the origins of the others.
std::string block_text(const std::vector<Line>& lines) {
    constexpr int widest_aligned = 64;
    int key_width = 0;
    int value_width = 0;
    for (const Line& line : lines) {
        key_width = std::max(key_width, text_width(line.key));
        const int width = text_width(line.value->written);
        if (width <= widest_aligned) value_width = std::max(value_width, width);
    }
    std::string text;
    for (const Line& line : lines) {
        const int key_gap = key_width - text_width(line.key);
        const int value_gap = std::max(0, value_width - text_width(line.value->written));
        text += fmt::format("{}{:{}} = {}{:{}}   # {}\n", line.key, "", key_gap,
                            line.value->written, "", value_gap, line.value->origin);
    }
    return text;
}

// Writes the values under table headers. The headers are left out if all values are in the one
// table that was asked for.
std::string values_text(const std::vector<Line>& lines, const std::string& asked) {
    std::string text;
    const bool one_table = std::ranges::all_of(lines, [&](const Line& line) {
        return !asked.empty() && line.table == lines.front().table;
    });
    for (std::size_t start = 0; start < lines.size();) {
        std::size_t end = start;
        while (end < lines.size() && lines[end].table == lines[start].table) ++end;
        if (!text.empty()) text += '\n';
        if (!one_table && !lines[start].table.empty()) {
            text += fmt::format("[{}]\n", lines[start].table);
        }
        text += block_text({lines.begin() + static_cast<std::ptrdiff_t>(start),
                            lines.begin() + static_cast<std::ptrdiff_t>(end)});
        start = end;
    }
    return text;
}

std::vector<std::string> depth_row(const std::string& name, const std::vector<double>& depths) {
    std::vector<std::string> row = {"# " + name};
    for (const double depth : depths) row.push_back(fmt::format("{:.4g}", depth));
    return row;
}

// Writes the optical depths straight up. A wrong unit shows in these sums more clearly than in any
// single number.
std::string depths_text(const Parameters& parameters) {
    TextTable table({Align::left, Align::right, Align::right, Align::right}, 0);
    std::vector<std::string> heading = {"# zenith optical depth"};
    for (const config::Length wavelength : parameters.wavelengths) {
        heading.push_back(config::wavelength_to_string(wavelength.meters));
    }
    table.add_row(std::move(heading));
    std::vector<double> total(parameters.wavelengths.size(), 0);
    for (const config::Layer& layer : parameters.atmosphere.layers) {
        const auto depths =
            config::zenith_optical_depth(with_coefficients(layer), parameters.atmosphere);
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += depths[i];
        table.add_row(depth_row("  " + config::key_to_string(layer.name), depths));
    }
    table.add_row(depth_row("  all layers", total));
    return table.text();
}

// Whether the recipe has an atmosphere. A recipe that only has noises has no atmosphere and no
// ground.
bool has_atmosphere(const Parameters& parameters) {
    return parameters.atmosphere.ground_radius.meters > 0;
}

bool shows_layers(const std::vector<Line>& lines) {
    return std::ranges::any_of(
        lines, [](const Line& line) { return line.table.starts_with("atmosphere.layers."); });
}

// Returns the first path that ends in the names asked for: "atmosphere.layers.mie" for "mie".
std::string path_with_tail(const std::vector<std::string>& known, const Names& tail) {
    for (const std::string& path : known) {
        const Names names = config::split_path(path).value_or(Names{});
        if (tail.empty() || names.size() <= tail.size()) continue;
        if (std::equal(tail.rbegin(), tail.rend(), names.rbegin())) return path;
    }
    return "";
}

Diagnostic unknown_path(const Recipe& recipe, const std::string& asked) {
    std::vector<std::string> known;
    for (const config::ResolvedValue& value : recipe.values) {
        const Line line = make_line(value);
        known.push_back(line.table);
        known.push_back(value.path);
    }
    const std::vector<std::string_view> names(known.begin(), known.end());
    const std::string tail = path_with_tail(known, config::split_path(asked).value_or(Names{}));
    return usage_error(fmt::format("the recipe has nothing at `{}`", asked),
                       tail.empty() ? config::did_you_mean(asked, names)
                                    : fmt::format("did you mean `{}`?", tail));
}

using Json = nlohmann::ordered_json;

Json depths_json(const Parameters& parameters) {
    std::vector<double> wavelengths_nm;
    for (const config::Length wavelength : parameters.wavelengths) {
        wavelengths_nm.push_back(wavelength.meters * 1e9);
    }
    Json layers = Json::object();
    for (const config::Layer& layer : parameters.atmosphere.layers) {
        layers[layer.name] =
            config::zenith_optical_depth(with_coefficients(layer), parameters.atmosphere);
    }
    return {{"wavelengths_nm", std::move(wavelengths_nm)}, {"layers", std::move(layers)}};
}

std::string values_event(const std::string& recipe, const std::vector<Line>& lines,
                         const Parameters* sky) {
    Json values = Json::array();
    for (const Line& line : lines) {
        values.push_back({{"path", line.value->path},
                          {"written", line.value->written},
                          {"canonical", line.value->canonical},
                          {"origin", line.value->origin}});
    }
    Json event = {{"event", "values"}, {"recipe", recipe}, {"values", std::move(values)}};
    if (sky != nullptr) event["zenith_optical_depths"] = depths_json(*sky);
    return event_line(event);
}

ExitCode run_show(const Invocation& invocation, Console& console) {
    const auto outcome = recipe_of(invocation);
    const ExitCode code = console.report(outcome.diagnostics);
    if (!outcome.value) return code;
    const bool whole = invocation.arguments().size() < 2;
    const std::string asked = whole ? "" : invocation.arguments()[1];
    const Names names = config::split_path(asked).value_or(Names{});
    const std::vector<Line> lines = lines_below(*outcome.value, names);
    if (!whole && (names.empty() || lines.empty())) {
        return console.report(std::array{unknown_path(*outcome.value, asked)});
    }
    // A user who asks for one layer, or for one key of all layers, has not asked for the sums.
    const bool all_layers = names.size() <= 2 && shows_layers(lines);
    const bool sums = (whole && has_atmosphere(outcome.value->parameters)) || all_layers;
    const Parameters* const sky = sums ? &outcome.value->parameters : nullptr;
    if (console.json()) {
        console.result(values_event(recipe_name(invocation.arguments()[0]), lines, sky));
    } else {
        console.result(values_text(lines, asked) + (sky ? '\n' + depths_text(*sky) : ""));
    }
    return ExitCode::done;
}

}  // namespace

Command show_command() {
    return {
        .name = "show",
        .brief = "show every resolved value",
        .summary = "show every resolved value and where it came from",
        .arguments = {{.name = "recipe.toml", .help = recipe_help},
                      {.name = "path",
                       .help =
                           "show only values at or below this path, in which * matches any name",
                       .required = false}},
        .options = {set_row()},
        .examples = {{"skybake show earth.toml", "shows all values and the zenith optical depths"},
                     {"skybake show earth.toml atmosphere.layers.aerosol", "shows one layer"},
                     {"skybake show clouds.toml noise.shape", "shows a noise and its preset"},
                     {"skybake show earth.toml --set preset=mars", "tries another preset"}},
        .exit_codes = {ExitCode::io},
        .run = run_show};
}

}  // namespace skybake::cli
