// This header says how a command is declared and what it is given. The parser, help, man pages and
// completions are all made from these tables.
//
// Each command has one file:
//
//   ExitCode run(const Invocation& invocation, Console& console);
//   Command verify_command() { return {.name = "verify", .summary = "...", .run = run}; }
//
// It also has one line in command.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cli/console.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// --- Options ------------------------------------------------------------------------------------

// This is an option of a command as the parser and the pages see it.
struct OptionRow {
    std::string_view name = {};   // long name without dashes: "dry-run"
    char short_name = 0;          // 'j', or 0
    std::string_view value = {};  // what stands after it: "N", "FILE"; empty for a switch
    std::string_view help = {};
    std::string_view fallback = {};              // the value if not given, as help shows it
    std::vector<std::string_view> choices = {};  // the only values allowed; empty: any
    std::vector<std::string> offered = {};       // by shells, besides other values
    bool repeatable = false;                     // if false, the last value counts
    bool is_path = false;                        // the value names a file or a folder
    // It returns E0001 for a text that the option does not take. If it is null, the option takes
    // any text.
    std::function<std::vector<Diagnostic>(const std::string& text)> check = nullptr;
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

// This is what an option is called, and the type of its value. An option of type bool is a switch,
// and one whose type is a vector is repeatable. Each command that has the option says what it is
// for: force("overwrite the file").
template <class T>
struct Option {
    std::string_view name = {};
    char short_name = 0;
    std::string_view value = {};
    std::vector<Choice<T>> choices = {};
    // It turns the text into the value, or reports E0001. If it is null, the text is one of the
    // choices or the value itself.
    Outcome<T> (*read)(const std::string& text) = nullptr;

    OptionRow operator()(std::string_view help, std::string_view fallback = {}) const;

    // Returns no value for a text that the option does not take.
    Outcome<T> value_of(const std::string& text) const;
};

// This is what the user typed, checked against the command's tables.
class Invocation {
  public:
    // Returns the last value given, else the table's fallback, else an empty value: false, 0 or "".
    // For a list it returns all values given, in order.
    template <class T>
    T operator[](const Option<T>& option) const;
    template <class T>
    bool has(const Option<T>& option) const {
        return entry(option.name).given;
    }
    // Returns the value, or nothing if the option was not given.
    template <class T>
    std::optional<T> given(const Option<T>& option) const {
        return has(option) ? std::optional<T>((*this)[option]) : std::nullopt;
    }
    // Returns the values as they were typed.
    template <class T>
    std::vector<std::string> typed(const Option<T>& option) const {
        return has(option) ? entry(option.name).texts : std::vector<std::string>();
    }
    // Returns the positional arguments in order. At least the required ones are there.
    const std::vector<std::string>& arguments() const { return arguments_; }

    void declare(const OptionRow& option);
    void give(std::string_view name, std::vector<std::string> texts);
    void add_argument(std::string text) { arguments_.push_back(std::move(text)); }

  private:
    struct Entry {
        bool given = false;
        std::vector<std::string> texts;  // only the fallback if nothing was given
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
    bool repeatable = false;                     // only the last argument may be
    std::vector<std::string_view> choices = {};  // what shells complete; empty: files and folders
};

struct Example {
    std::string_view command = {};  // "skybake bake earth.toml -o out"
    std::string_view what = {};     // what the command does, in a few words
};

struct Command {
    std::string_view name = {};
    std::string_view brief = {};    // a few words, for the shortest help
    std::string_view summary = {};  // one line without a full stop
    std::vector<Argument> arguments = {};
    std::vector<OptionRow> options = {};
    std::vector<Example> examples = {};     // at least one
    std::vector<ExitCode> exit_codes = {};  // in addition to done, usage and interrupted
    ExitCode (*run)(const Invocation& invocation, Console& console) = nullptr;
};

// Returns all commands, in the order in which a new user needs them. Help shows them in this order.
const std::vector<Command>& commands();

// Returns the options that every command takes.
const std::vector<OptionRow>& global_options();

// --- Parsing ------------------------------------------------------------------------------------

struct CommandLine {
    const Command* command = nullptr;     // null if none was named
    Invocation invocation;                // the command's options and the global ones
    std::vector<Diagnostic> diagnostics;  // E0001
};

// Parses the words after the program's name. Options may stand anywhere after the command, and
// global ones before it too; "--" ends them. With --help or --version the rest of the line may be
// incomplete.
CommandLine parse_arguments(std::span<const std::string> words, std::span<const Command> commands,
                            std::span<const OptionRow> global_options);

// Returns E0001 with the nearest known name, if one is near.
Diagnostic unknown_command(const std::string& name, std::span<const Command> commands);

// Returns an E0001 diagnostic about the command line.
Diagnostic usage_error(std::string message, std::string label = {});

// Runs the program once, from its words to its exit code. `words` are the words after the program's
// name. An exception is a mistake in the program; it ends here with the exit code `internal`.
ExitCode run(std::span<const std::string> words, Sink out, Sink error,
             const ColorEnvironment& environment = {});

// --- Templates ----------------------------------------------------------------------------------

template <class T>
Outcome<T> Option<T>::value_of(const std::string& text) const {
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

// The rest of this header is about what the program says of itself: help, man pages and shell
// completions. They are made from the tables of commands and options.
inline constexpr std::string_view program_summary =
    "bakes sky tables, cloud noise and cloud volumes, and measures their errors";

struct ExitCodeWords {
    ExitCode code;
    std::string_view words;
};

// Returns the exit codes of `codes` with their words, in the order of their numbers, or all exit
// codes if `codes` is empty.
std::vector<ExitCodeWords> exit_codes(std::span<const ExitCode> codes);

// Says in one line what an option is for, its choices and its default.
std::string option_help(const OptionRow& option);

// Returns the twelve lines that `skybake` prints without a command.
std::string short_help();

// Prints the help of a command, or of the program if `command` is null, in at most 40 lines.
void show_help(const Command* command, Console& console);

// These return the sources of the man pages skybake(1) and skybake-COMMAND(1).
std::string man_page(std::span<const Example> examples);
std::string man_page(const Command& command);

enum class Shell { bash, zsh, fish };

// Returns a shell script that completes commands, options, choices and file names.
std::string completion(Shell shell);

}  // namespace skybake::cli
