// What commands share of the command line: options, the recipe, which of its assets, the cache.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/bake_folder.h"
#include "cli/command.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

// Amounts of memory and disk. "512MiB", "2G", "1.5 GB", "4096" (bytes): KiB, MiB, GiB, TiB are
// powers of 1024, and so are K, M, G, T alone, as in Slurm and systemd; kB, MB, GB, TB are powers
// of 1000. None for anything else, also for more than 2^63 bytes.
std::optional<std::uint64_t> parse_byte_size(std::string_view text);
inline constexpr std::string_view byte_size_words = "it takes a size such as 512M, 2GiB or 2GB";

// A whole number of `least` to `most`, the whole text without sign or blanks.
std::optional<std::int64_t> parse_count(std::string_view text, std::int64_t least,
                                        std::int64_t most);

// E0001: "`--tasks` cannot be `x`", and what it takes.
config::Diagnostic bad_value(std::string_view option, std::string_view text, std::string label);

// --- Options ------------------------------------------------------------------------------------

namespace options {

using Texts = std::vector<std::string>;

// E0001 for an empty name.
config::Outcome<std::filesystem::path> read_folder(const std::string& text);
// A number of threads from 1 to 1024.
config::Outcome<int> read_jobs(const std::string& text);
// In MiB.
config::Outcome<double> read_max_memory(const std::string& text);

// Of all commands.
inline const Option<bool> help{"help", 'h'};
inline const Option<bool> version{"version", 'V'};
inline const Option<bool> quiet{"quiet", 'q'};
inline const Option<bool> verbose{"verbose", 'v'};
inline const Option<bool> json{"json"};
inline const Option<WhenColor> color{
    "color",
    0,
    "WHEN",
    {{"auto", WhenColor::automatic}, {"always", WhenColor::always}, {"never", WhenColor::never}}};
inline const Option<DiagnosticFormat> diagnostics{"diagnostics",
                                                  0,
                                                  "FORMAT",
                                                  {{"human", DiagnosticFormat::human},
                                                   {"short", DiagnosticFormat::short_},
                                                   {"json", DiagnosticFormat::json},
                                                   {"github", DiagnosticFormat::github},
                                                   {"sarif", DiagnosticFormat::sarif}}};

// Of several.
inline const Option<std::filesystem::path> output{"output", 'o', "FOLDER", {}, read_folder};
inline const Option<Texts> set{"set", 0, "KEY=VALUE"};
inline const Option<Texts> only{"only", 0, "NAME"};
inline const Option<Certification> certify{
    "certify",
    0,
    "HOW",
    {{"quick", Certification::quick}, {"full", Certification::full}, {"off", Certification::off}}};
// 0, as many as the machine has, where it is not given.
inline const Option<int> jobs{"jobs", 'j', "N", {}, read_jobs};
inline const Option<bool> dry_run{"dry-run"};
inline const Option<bool> force{"force"};
inline const Option<std::filesystem::path> cache_dir{"cache-dir", 0, "FOLDER"};
inline const Option<double> max_memory{"max-memory", 0, "SIZE", {}, read_max_memory};

}  // namespace options

// The row of --set, which says the same everywhere.
OptionRow set_row();
OptionRow certify_row();
OptionRow cache_row();

// Where the cache is: --cache-dir, else the environment's SKYBAKE_CACHE_DIR; empty: no cache. It
// decides how fast a bake is, never what it makes.
std::filesystem::path cache_folder(const Invocation& invocation);

// None without --max-memory.
std::optional<double> memory_limit_mib(const Invocation& invocation);

// --- The recipe ---------------------------------------------------------------------------------

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
[[nodiscard]] std::optional<config::Diagnostic> preset_in_place_of_file(
    const std::filesystem::path& path);

struct BakeSelection {
    config::Recipe recipe;
    std::vector<config::Bake> bakes;  // all of the recipe, or those that --only names
    int threads = 0;                  // 0: as many as the machine has
};

// Reads the recipe named by the first argument with its --set values. The recipe's own diagnostics;
// E0001 for --only, E0124 for a recipe that asks for nothing, E0300 and E0304 for maps that cannot
// be read.
config::Outcome<BakeSelection> select_bakes(const Invocation& invocation);

}  // namespace skybake::cli
