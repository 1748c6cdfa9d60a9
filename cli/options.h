// This header holds what several commands share of the command line: options, the recipe, the
// choice of its assets, and the cache.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/math/bake_options.h"
#include "cli/command.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

// Reads an amount of memory or disk in bytes, such as "512MiB", "2G", "1.5 GB" or "4096". KiB, MiB,
// GiB and TiB are powers of 1024, and so are K, M, G and T alone, as in Slurm and systemd; kB, MB,
// GB and TB are powers of 1000. Returns none for anything else and for more than 2^63 bytes.
std::optional<std::uint64_t> parse_byte_size(std::string_view text);
inline constexpr std::string_view byte_size_words = "it takes a size such as 512M, 2GiB or 2GB";

// Reads a whole number from `least` to `most`. The text must hold nothing else, neither sign nor
// blanks.
std::optional<int> parse_count(std::string_view text, int least, int most);

// Returns E0001, "`--tasks` cannot be `x`", with a label that says what the option takes.
Diagnostic bad_value(std::string_view option, std::string_view text, std::string label);

// --- Options ------------------------------------------------------------------------------------

namespace options {

using Texts = std::vector<std::string>;

// Returns E0001 for an empty name.
Outcome<std::filesystem::path> read_folder(const std::string& text);
// Reads a number of threads from 1 to 1024.
Outcome<int> read_jobs(const std::string& text);
// Reads the URL of a cache. The error E0001 does not show a password.
Outcome<std::string> read_cache(const std::string& text);
// Reads an amount of memory and returns it in MiB.
Outcome<double> read_max_memory(const std::string& text);

// All commands take these options.
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

// Several commands take these options.
inline const Option<std::filesystem::path> output{"output", 'o', "FOLDER", {}, read_folder};
inline const Option<Texts> set{"set", 0, "KEY=VALUE"};
inline const Option<Texts> only{"only", 0, "NAME"};
inline const Option<Certification> certify{
    "certify",
    0,
    "HOW",
    {{"quick", Certification::quick}, {"full", Certification::full}, {"off", Certification::off}}};
// The value is 0 if the option is not given, which means as many threads as the machine has.
inline const Option<int> jobs{"jobs", 'j', "N", {}, read_jobs};
inline const Option<bool> dry_run{"dry-run"};
inline const Option<bool> force{"force"};
inline const Option<std::filesystem::path> cache_dir{"cache-dir", 0, "FOLDER"};
// The value is a URL.
inline const Option<std::string> cache{"cache", 0, "URL", {}, read_cache};
inline const Option<double> max_memory{"max-memory", 0, "SIZE", {}, read_max_memory};

}  // namespace options

// These return the rows of options whose help is the same in every command.
OptionRow set_row();
OptionRow certify_row();
OptionRow cache_row();
OptionRow server_row();

// Returns the folder of the cache: --cache-dir, else the environment variable SKYBAKE_CACHE_DIR. It
// is empty if there is no cache. The cache decides how fast a bake is, never what it makes. E0302 if the
// folder is no cache and holds files.
Outcome<std::filesystem::path> cache_folder(const Invocation& invocation);

// Returns the folder of the program's own cache for previews, below $XDG_CACHE_HOME or ~/.cache. It is
// empty if there is no such place, or if something else stands there.
std::filesystem::path own_cache_folder();

// Returns the URL of the cache on a server: --cache, else the environment variable SKYBAKE_CACHE. It
// is empty if there is none. E0001 if the variable holds no URL.
Outcome<std::string> cache_url(const Invocation& invocation);

// --- The recipe ---------------------------------------------------------------------------------

// Diagnostics and events call standard input by this name.
inline constexpr std::string_view standard_input_name = "<stdin>";

// This is the help of the argument `recipe.toml` where it may be standard input.
inline constexpr std::string_view recipe_help = "the recipe; - reads it from standard input";

// Whether the argument is `-`. A file of that name is `./-`.
bool is_standard_input(std::string_view argument);

// Returns what a recipe is called: its path, or standard_input_name.
std::string recipe_name(std::string_view argument);

// Reads the recipe that the first argument names, with its --set values and `more` of the same. Paths
// in a recipe from standard input, which may be read again, are relative to the current folder. It
// reports E0300 and E0120 if the recipe cannot be read, and the recipe's own diagnostics.
Outcome<Recipe> recipe_of(const Invocation& invocation, std::span<const std::string> more = {});

// Returns E0300 if the path is not a file but the name of a preset. The label says how to begin
// with the preset.
[[nodiscard]] std::optional<Diagnostic> preset_in_place_of_file(const std::filesystem::path& path);

struct BakeSelection {
    Recipe recipe;
    std::vector<Bake> bakes;  // all bakes of the recipe, or those that --only names
    int threads = 0;          // 0: as many as the machine has
};

// Reads the recipe that the first argument names, with its --set values, and selects its bakes. It
// reports the recipe's own diagnostics, E0001 for --only, E0124 for a recipe without bakes, and
// E0300 and E0304 for maps that cannot be read.
Outcome<BakeSelection> select_bakes(const Invocation& invocation);

}  // namespace skybake::cli
