// How a command is declared, and what it is given. Parser, help, man pages and completions all come
// from these tables.
//
// One file per command:
//
//   ExitCode run(const Invocation& invocation, Console& console);
//   Command verify_command() { return {.name = "verify", .summary = "...", .run = run}; }
//
// and one line in command.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cli/console.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// --- Options ------------------------------------------------------------------------------------

// An option of a command, as parser and pages see it.
struct OptionRow {
    std::string_view name = {};   // long name without dashes: "dry-run"
    char short_name = 0;          // 'j', or 0
    std::string_view value = {};  // what stands after it: "N", "FILE"; empty for a switch
    std::string_view help = {};
    std::string_view fallback = {};              // the value if not given, as help shows it
    std::vector<std::string_view> choices = {};  // the only values allowed; empty: any
    bool repeatable = false;                     // else the last one wins
    bool is_path = false;                        // the value names a file or a folder
    // E0001 for what the option does not take; null: it takes any text.
    std::function<std::vector<config::Diagnostic>(const std::string& text)> check = nullptr;
};

template <class T>
struct Choice {
    std::string_view word;
    T value;
};

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

// What an option is called and the type that its value arrives as. bool is a switch; a vector is
// repeatable. What it is for is said by each command that has it: force("overwrite the file").
template <class T>
struct Option {
    std::string_view name = {};
    char short_name = 0;
    std::string_view value = {};
    std::vector<Choice<T>> choices = {};
    // From text to the value, or E0001. Null: one of the choices, or the text as it is.
    config::Outcome<T> (*read)(const std::string& text) = nullptr;

    OptionRow operator()(std::string_view help, std::string_view fallback = {}) const;

    // No value for what the option does not take.
    config::Outcome<T> value_of(const std::string& text) const;
};

// What the user typed, checked against the command's tables.
class Invocation {
  public:
    // The (last) value given, else the table's fallback, else an empty value: false, 0, "". A list
    // has all values given, in order.
    template <class T>
    T operator[](const Option<T>& option) const;
    template <class T>
    bool has(const Option<T>& option) const {
        return entry(option.name).given;
    }
    // Values as they were typed.
    template <class T>
    std::vector<std::string> typed(const Option<T>& option) const {
        return has(option) ? entry(option.name).texts : std::vector<std::string>();
    }
    // Positional arguments, in order; at least the required ones are there.
    const std::vector<std::string>& arguments() const { return arguments_; }

    void declare(const OptionRow& option);
    void give(std::string_view name, std::vector<std::string> texts);
    void add_argument(std::string text) { arguments_.push_back(std::move(text)); }

  private:
    struct Entry {
        bool given = false;
        std::vector<std::string> texts;  // the fallback alone where nothing was given
    };
    // Throws std::logic_error for an option that is not in the command's table.
    const Entry& entry(std::string_view name) const;

    std::map<std::string_view, Entry> options_;
    std::vector<std::string> arguments_;
};

// --- Commands -----------------------------------------------------------------------------------

struct Argument {
    std::string_view name = {};  // "recipe.toml", as help shows it
    std::string_view help = {};
    bool required = true;
    bool repeatable = false;                     // the last argument only
    std::vector<std::string_view> choices = {};  // what shells complete; empty: files and folders
};

struct Example {
    std::string_view command = {};  // "skybake bake earth.toml -o out"
    std::string_view what = {};     // what it does, in a few words
};

struct Command {
    std::string_view name = {};
    std::string_view brief = {};    // a few words, for the shortest help
    std::string_view summary = {};  // one line without a full stop
    std::vector<Argument> arguments = {};
    std::vector<OptionRow> options = {};
    std::vector<Example> examples = {};     // at least one
    std::vector<ExitCode> exit_codes = {};  // besides done, usage and interrupted
    ExitCode (*run)(const Invocation& invocation, Console& console) = nullptr;
};

// In the order of a newcomer's day; help shows them so.
const std::vector<Command>& commands();

// Options that every command takes.
const std::vector<OptionRow>& global_options();

// --- Parsing ------------------------------------------------------------------------------------

struct CommandLine {
    const Command* command = nullptr;             // null where none was named
    Invocation invocation;                        // the command's options and the global ones
    std::vector<config::Diagnostic> diagnostics;  // E0001
};

// `words` are those behind the program's name. Options may stand anywhere after the command, global
// ones before it too; "--" ends them. With --help or --version nothing else need be complete.
CommandLine parse_arguments(std::span<const std::string> words, std::span<const Command> commands,
                            std::span<const OptionRow> global_options);

// E0001 with the nearest name, if one is near.
config::Diagnostic unknown_command(const std::string& name, std::span<const Command> commands);

// A diagnostic about the command line.
config::Diagnostic usage_error(std::string message, std::string label = {});

// One run of the program, from its words to its exit code. `words` are those behind the program's
// name. Exceptions are mistakes of the program's own and end here as `internal`.
ExitCode run(std::span<const std::string> words, Sink out, Sink error,
             const ColorEnvironment& environment = {});

// --- Templates ----------------------------------------------------------------------------------

template <class T>
config::Outcome<T> Option<T>::value_of(const std::string& text) const {
    if (read) return read(text);
    for (const Choice<T>& choice : choices) {
        if (choice.word == text) return {choice.value, {}};
    }
    if constexpr (std::is_constructible_v<T, std::string>) return {T(text), {}};
    if constexpr (std::is_same_v<T, std::vector<std::string>>) return {T{text}, {}};
    return {};
}

template <class T>
OptionRow Option<T>::operator()(std::string_view help, std::string_view fallback) const {
    OptionRow row{name, short_name, value, help, fallback};
    for (const Choice<T>& choice : choices) row.choices.push_back(choice.word);
    row.repeatable = is_list<T>;
    row.is_path = std::is_same_v<T, std::filesystem::path>;
    if (read) row.check = [reader = read](const auto& text) { return reader(text).diagnostics; };
    return row;
}

template <class T>
T Invocation::operator[](const Option<T>& option) const {
    const Entry& found = entry(option.name);
    if constexpr (std::is_same_v<T, bool>) {
        return found.given;
    } else if constexpr (is_list<T>) {
        T all;
        for (const std::string& text : found.texts) {
            const T some = *option.value_of(text).value;
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    } else {
        return found.texts.empty() ? T{} : *option.value_of(found.texts.back()).value;
    }
}

// What the program says of itself, made from the tables of commands and options: help, man pages
// and shell completions.
class Console;

inline constexpr std::string_view program_summary =
    "bakes sky tables, cloud noise and cloud volumes, and measures their errors";

struct ExitCodeWords {
    ExitCode code;
    std::string_view words;
};

// Those of `codes` in the order of their numbers; of an empty list, all.
std::vector<ExitCodeWords> exit_codes(std::span<const ExitCode> codes);

// What an option is for, its choices and its default, in one line.
std::string option_help(const OptionRow& option);

// What `skybake` without a command prints: twelve lines.
std::string short_help(std::span<const Command> commands);

// Prints the help of a command, or of the program where that is null: at most 40 lines.
void show_help(const Command* command, Console& console);

// The sources of skybake(1) and skybake-COMMAND(1).
std::string man_page(std::span<const Command> commands, std::span<const OptionRow> globals,
                     std::span<const Example> examples);
std::string man_page(const Command& command);

enum class Shell { bash, zsh, fish };

// A script that completes commands, options, choices and names of files.
std::string completion(Shell shell, std::span<const Command> commands,
                       std::span<const OptionRow> globals);

}  // namespace skybake::cli
