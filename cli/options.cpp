#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <utility>
#include <variant>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/io/files/file_io.h"
#include "bakers/workspace/cache_folder.h"
#include "bakers/workspace/http_cache.h"
#include "cli/volume_recipe.h"
#include "config/fields/fields.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

struct Unit {
    std::string_view name;
    double bytes;
};

constexpr std::array units = {
    Unit{"", 1},
    Unit{"B", 1},
    Unit{"K", 1024.0},
    Unit{"M", 1024.0 * 1024},
    Unit{"G", 1024.0 * 1024 * 1024},
    Unit{"T", 1024.0 * 1024 * 1024 * 1024},
    Unit{"KiB", 1024.0},
    Unit{"MiB", 1024.0 * 1024},
    Unit{"GiB", 1024.0 * 1024 * 1024},
    Unit{"TiB", 1024.0 * 1024 * 1024 * 1024},
    Unit{"kB", 1e3},
    Unit{"MB", 1e6},
    Unit{"GB", 1e9},
    Unit{"TB", 1e12},
};

Diagnostic nothing_to_bake() {
    return {Severity::error,
            "E0124",
            "the recipe bakes nothing: it has no [bake.*]",
            {},
            "add [bake.transmittance]"};
}

// Reads the input when it is called first.
Outcome<Recipe> recipe_from_standard_input(const std::vector<std::string>& settings) {
    static const auto text = config::read_standard_input(config::most_recipe_bytes);
    if (const auto* error = std::get_if<config::FileError>(&text)) {
        return file_error(
            error->too_large ? "E0120" : "E0300", std::string(standard_input_name),
            fmt::format("cannot read a recipe from standard input: {}", error->reason));
    }
    return config::parse_recipe(std::get<std::string>(text), std::string(standard_input_name), {},
                                settings);
}

// Returns the paths of keys in tables whose names a recipe does not choose, with an equals sign. An
// asset's own name stands for that of its table.
std::vector<std::string> keys_to_set() {
    std::vector<std::string> keys;
    for (const config::Section& section : config::sections()) {
        const bool is_of_asset = !section.asset.empty();
        if (section.path.starts_with("sweep") || section.path.starts_with("preview")) continue;
        if (!is_of_asset && section.path.find('*') != std::string_view::npos) continue;
        const std::string table =
            is_of_asset ? fmt::format("bake.{}", section.asset) : std::string(section.path);
        for (const config::Field& field : section.fields) {
            keys.push_back(config::join_path(table, field.key) + "=");
        }
    }
    return keys;
}

}  // namespace

std::optional<std::uint64_t> parse_byte_size(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (error != std::errc{} || !(number >= 0)) return std::nullopt;
    std::string_view unit(after, static_cast<std::size_t>(end - after));
    if (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    for (const Unit& known : units) {
        if (unit != known.name) continue;
        const double bytes = std::ceil(number * known.bytes);
        if (!(bytes <= 0x1p63)) return std::nullopt;
        return static_cast<std::uint64_t>(bytes);
    }
    return std::nullopt;
}

std::optional<int> parse_count(std::string_view text, int least, int most) {
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || count < least || count > most) return std::nullopt;
    return count;
}

Diagnostic bad_value(std::string_view option, std::string_view text, std::string label) {
    return usage_error(fmt::format("`{}` cannot be `{}`", option, config::shorten(text)),
                       std::move(label));
}

// --- Options ------------------------------------------------------------------------------------

namespace options {

Outcome<fs::path> read_folder(const std::string& text) {
    if (text.empty()) return usage_error("-o: the folder's name is empty");
    return {fs::path(text), {}};
}

Outcome<int> read_jobs(const std::string& text) {
    if (const auto threads = parse_count(text, 1, 1024)) return {threads, {}};
    return bad_value("-j", text, "it takes a number of threads from 1 to 1024");
}

Outcome<std::string> read_cache(const std::string& text) {
    std::string problem = cache_url_problem(text);
    if (problem.empty()) return {text, {}};
    return bad_value("--cache", without_credentials(text), std::move(problem));
}

Outcome<double> read_max_memory(const std::string& text) {
    const auto bytes = parse_byte_size(text);
    if (bytes) return {static_cast<double>(*bytes) / (1024.0 * 1024.0), {}};
    return bad_value("--max-memory", text, std::string(byte_size_words));
}

}  // namespace options

OptionRow set_row() {
    OptionRow row = options::set("override a value of the recipe");
    row.offered = keys_to_set();
    return row;
}

OptionRow certify_row() { return options::certify("how thoroughly to measure errors", "quick"); }

OptionRow cache_row() {
    return options::cache_dir(
        "share baked assets through this folder (default: $SKYBAKE_CACHE_DIR)");
}

OptionRow server_row() {
    return options::cache("share baked assets through this server too (default: $SKYBAKE_CACHE)");
}

Outcome<fs::path> cache_folder(const Invocation& invocation) {
    const char* const variable = std::getenv("SKYBAKE_CACHE_DIR");
    fs::path folder =
        invocation.given(options::cache_dir).value_or(variable != nullptr ? variable : "");
    auto problems = folder.empty() ? std::vector<Diagnostic>{} : check_cache_folder(folder);
    if (!problems.empty()) return {{}, std::move(problems)};
    return {std::move(folder), {}};
}

fs::path own_cache_folder() {
    const char* const caches = std::getenv("XDG_CACHE_HOME");
    const char* const home = std::getenv("HOME");
    fs::path folder = caches != nullptr ? caches : "";
    if (folder.is_relative()) folder = home != nullptr ? fs::path(home) / ".cache" : "";
    if (folder.is_relative()) return {};
    folder /= "skybake";
    return check_cache_folder(folder).empty() ? folder : fs::path();
}

Outcome<std::string> cache_url(const Invocation& invocation) {
    if (auto given = invocation.given(options::cache)) return {std::move(given), {}};
    const char* const url = std::getenv("SKYBAKE_CACHE");
    if (url == nullptr || *url == '\0') return {"", {}};
    std::string problem = cache_url_problem(url);
    if (problem.empty()) return {url, {}};
    return bad_value("SKYBAKE_CACHE", without_credentials(url), std::move(problem));
}

// --- The recipe ---------------------------------------------------------------------------------

bool is_standard_input(std::string_view argument) { return argument == "-"; }

std::string recipe_name(std::string_view argument) {
    return std::string(is_standard_input(argument) ? standard_input_name : argument);
}

Outcome<Recipe> recipe_of(const Invocation& invocation, std::span<const std::string> more) {
    const std::string& file = invocation.arguments()[0];
    std::vector<std::string> settings = invocation[options::set];
    settings.insert(settings.end(), more.begin(), more.end());
    if (is_standard_input(file)) return recipe_from_standard_input(settings);
    if (auto diagnostic = preset_in_place_of_file(file)) return std::move(*diagnostic);
    if (is_foreign_volume(file)) return recipe_of_volume(file, settings);
    return config::load_recipe(file, settings);
}

namespace {

// Whether an asset is a frame or a packet of [bake.NAME]: NAME_0001, NAME_2.
bool is_part_of(const std::string& name, std::string_view asset) {
    const std::string begin = name + "_";
    return asset.size() > begin.size() && asset.starts_with(begin) &&
           asset.find_first_not_of("0123456789", begin.size()) == std::string_view::npos;
}

}  // namespace

Outcome<BakeSelection> select_bakes(const Invocation& invocation) {
    auto recipe = recipe_of(invocation);
    Outcome<BakeSelection> outcome;
    outcome.diagnostics = std::move(recipe.diagnostics);
    if (!recipe.value) return outcome;
    const std::vector<Bake>& all = recipe.value->parameters.bakes;

    std::vector<Diagnostic> problems;
    std::vector<std::string_view> names;
    for (const Bake& bake : all) names.push_back(bake.name);
    const std::vector<std::string> only = invocation[options::only];
    std::set<std::string_view> wanted;
    for (const std::string& name : only) {
        const bool is_whole = std::ranges::find(names, name) != names.end();
        const std::size_t before = wanted.size();
        std::ranges::copy_if(names, std::inserter(wanted, wanted.end()), [&](std::string_view one) {
            return is_whole ? one == name : is_part_of(name, one);
        });
        if (is_whole || wanted.size() > before) continue;
        problems.push_back(usage_error(fmt::format("--only: the recipe has no [bake.{}]", name),
                                       config::did_you_mean(name, names)));
    }
    if (all.empty()) problems.push_back(nothing_to_bake());
    for (Diagnostic& problem : check_cloud_files(recipe.value->parameters)) {
        // The bake repeats warnings of what it reads.
        if (problem.severity == Severity::error) problems.push_back(std::move(problem));
    }
    outcome.diagnostics.insert(outcome.diagnostics.end(), problems.begin(), problems.end());
    if (!problems.empty()) return outcome;

    BakeSelection selection;
    for (const Bake& bake : all) {
        if (only.empty() || wanted.contains(bake.name)) selection.bakes.push_back(bake);
    }
    selection.threads = invocation[options::jobs];
    selection.recipe = std::move(*recipe.value);
    outcome.value = std::move(selection);
    return outcome;
}

}  // namespace skybake::cli
