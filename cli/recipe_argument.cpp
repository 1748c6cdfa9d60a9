#include "cli/recipe_argument.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "bakers/io/files/file_diagnostic.h"
#include "cli/preset_kinds.h"
#include "config/text/text_file.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Outcome;
using config::Recipe;

Outcome<Recipe> recipe_from_standard_input(const std::vector<std::string>& settings) {
    auto text = config::read_standard_input(config::most_recipe_bytes);
    if (const auto* error = std::get_if<config::FileError>(&text)) {
        return {{},
                {file_error(
                    error->too_large ? "E0120" : "E0300", std::string(standard_input_name),
                    fmt::format("cannot read a recipe from standard input: {}", error->reason))}};
    }
    return config::parse_recipe(std::get<std::string>(text), std::string(standard_input_name), {},
                                settings);
}

}  // namespace

bool is_standard_input(std::string_view argument) { return argument == "-"; }

std::string recipe_name(std::string_view argument) {
    return std::string(is_standard_input(argument) ? standard_input_name : argument);
}

Outcome<Recipe> recipe_of(const Invocation& invocation) {
    const std::string& file = invocation.arguments()[0];
    const std::vector<std::string> settings = invocation.values("set");
    if (is_standard_input(file)) return recipe_from_standard_input(settings);
    if (auto diagnostic = preset_in_place_of_file(file)) return {{}, {std::move(*diagnostic)}};
    return config::load_recipe(file, settings);
}

std::optional<config::Diagnostic> preset_in_place_of_file(const fs::path& path) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(path, error))) return std::nullopt;
    const auto presets = presets_for_init(path.string());
    if (presets.empty()) return std::nullopt;
    config::Diagnostic diagnostic =
        file_error("E0300", "", fmt::format("`{}` is a preset and not a file", path.string()));
    diagnostic.label =
        fmt::format("write a recipe from it: {}", init_command_of(presets, path.string()));
    return diagnostic;
}

}  // namespace skybake::cli
