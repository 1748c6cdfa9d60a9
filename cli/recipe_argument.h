// The recipe that a command is given: a file, or standard input.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

// What diagnostics and events call standard input.
inline constexpr std::string_view standard_input_name = "<stdin>";

// The help of the argument `recipe.toml`, and of one that may not be standard input.
inline constexpr std::string_view recipe_help = "the recipe; - reads it from standard input";

// Whether the argument is `-`. A file of that name is `./-`.
bool is_standard_input(std::string_view argument);

// What a recipe is called: its path, or standard_input_name.
std::string recipe_name(std::string_view argument);

// Reads the recipe that the first argument names, with its --set values. Paths in a recipe from
// standard input are relative to the current folder. E0300 and E0120 where it cannot be read, and
// its own diagnostics.
config::Outcome<config::Recipe> recipe_of(const Invocation& invocation);

// E0300 where the path is no file, but a preset's name; the label says how to begin with it.
std::optional<config::Diagnostic> preset_in_place_of_file(const std::filesystem::path& path);

}  // namespace skybake::cli
