#include "cli/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/options.h"
#include "config/text/mapped.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

bool is_option(std::string_view word) { return word.size() > 1 && word[0] == '-'; }

const OptionRow* find_option(std::span<const OptionRow> options, std::string_view name) {
    const auto found = std::ranges::find(options, name, &OptionRow::name);
    return found != options.end() ? &*found : nullptr;
}

const OptionRow* find_letter(std::span<const OptionRow> options, char letter) {
    const auto found = std::ranges::find(options, letter, &OptionRow::short_name);
    return found != options.end() ? &*found : nullptr;
}

// Returns the option that a word names: "--name", "--name=value", "-n" or "-nvalue".
const OptionRow* option_of(std::string_view word, std::span<const OptionRow> options) {
    if (!is_option(word)) return nullptr;
    return word.starts_with("--") ? find_option(options, word.substr(2, word.find('=') - 2))
                                  : find_letter(options, word[1]);
}

// Whether a word that begins like an option is one of these options. It may be spelt "--name",
// "--name=value", "-n" or "-nm".
bool is_option_of(std::string_view word, std::span<const OptionRow> options) {
    if (!word.starts_with("--")) {
        word.remove_prefix(1);
        return std::ranges::all_of(
            word, [&](char letter) { return find_letter(options, letter) != nullptr; });
    }
    word.remove_prefix(2);
    return word.empty() || find_option(options, word.substr(0, word.find('='))) != nullptr;
}

// Returns the first option before the command that is not a global one. No value of a global option
// begins with a dash.
std::optional<std::string> first_stray(std::span<const std::string> before,
                                       std::span<const OptionRow> globals) {
    for (const std::string& word : before) {
        if (is_option(word) && !is_option_of(word, globals)) return word;
    }
    return std::nullopt;
}

// Returns the position of the command among the words: the first word that is neither an option nor
// the value of a global option.
std::size_t command_position(std::span<const std::string> words,
                             std::span<const OptionRow> globals) {
    std::size_t i = 0;
    while (i < words.size() && is_option(words[i])) {
        const OptionRow* option =
            words[i].starts_with("--") ? find_option(globals, words[i].substr(2)) : nullptr;
        i += option != nullptr && !option->value.empty() ? 2 : 1;
    }
    return std::min(i, words.size());
}

// Returns `--name` in backticks, for messages.
std::string dashed(std::string_view name) { return fmt::format("`--{}`", name); }

// Returns the option of a command that a word before the command's name may mean, as help writes
// it.
std::string misplaced_option(std::string_view word, const Command& command) {
    const OptionRow* const option = option_of(word, command.options);
    if (option == nullptr) return "";
    const std::string name = word.starts_with("--") ? fmt::format("--{}", option->name)
                                                    : fmt::format("-{}", option->short_name);
    return option->value.empty() ? name : fmt::format("{} {}", name, option->value);
}

Diagnostic unknown_option(const std::string& word, std::span<const OptionRow> options,
                          const std::string& help) {
    const std::string shown = word.substr(0, word.find('='));
    const auto known = mapped<std::string_view>(options, &OptionRow::name);
    // The dashes are no part of the names, or all names would be near to each other.
    const auto nearest =
        shown.starts_with("--") ? config::nearest_name(shown.substr(2), known) : std::nullopt;
    return usage_error(fmt::format("unknown option `{}`", shown),
                       nearest ? fmt::format("did you mean {}?", dashed(*nearest))
                               : fmt::format("`{}` lists the options", help));
}

// Returns the command that an option before all commands was meant for: the command that the words
// name, else the first one that has the option. Returns null if no command has it.
const Command* command_of_option(const std::string& option, std::span<const std::string> words,
                                 std::span<const Command> commands) {
    const Command* first = nullptr;
    for (const Command& command : commands) {
        if (misplaced_option(option, command).empty()) continue;
        if (std::ranges::find(words, command.name) != words.end()) return &command;
        if (first == nullptr) first = &command;
    }
    return first;
}

// Reports an option before the command that is not a global one: it belongs to commands, or does
// not exist.
Diagnostic stray_option(const std::string& option, std::span<const std::string> words,
                        std::span<const Command> commands, std::span<const OptionRow> globals) {
    if (const Command* command = command_of_option(option, words, commands)) {
        return usage_error(fmt::format("`{}` stands before the command", option),
                           fmt::format("the options of a command come after it: skybake {} {}",
                                       command->name, misplaced_option(option, *command)));
    }
    std::vector<OptionRow> all(globals.begin(), globals.end());
    for (const Command& command : commands) {
        all.insert(all.end(), command.options.begin(), command.options.end());
    }
    return unknown_option(option, all, "skybake --help");
}

Diagnostic unknown_choice(const OptionRow& option, const std::string& value) {
    std::string hint = config::did_you_mean(value, option.choices);
    if (hint.empty()) hint = fmt::format("use one of {}", fmt::join(option.choices, ", "));
    return usage_error(fmt::format("{} cannot be `{}`", dashed(option.name), value),
                       std::move(hint));
}

Diagnostic missing_value(const OptionRow& option) {
    return usage_error(
        fmt::format("{} needs a value: --{} {}", dashed(option.name), option.name, option.value));
}

// The words of a command line, sorted by what they are.
struct Found {
    std::vector<std::vector<std::string>> values;  // per option; "true" for each use of a switch
    std::vector<std::string> arguments;
    std::vector<std::string> unknown;
    std::optional<Diagnostic> malformed;  // an option lacks its value, or a switch has one
};

// Sorts words as most programs do: "--name value", "--name=value", "-n value", "-nvalue", switches
// together as in "-qv", and arguments alone after "--". Ends at the first malformed option.
Found sort_words(std::vector<std::string> words, std::span<const OptionRow> options) {
    Found found;
    found.values.resize(options.size());
    std::size_t next = 0;
    while (next < words.size() && words[next] != "--") {
        const std::string word = words[next++];
        const bool is_long = word.starts_with("--");
        const std::size_t end = std::min(is_long ? word.find('=') : 2, word.size());
        const OptionRow* option = option_of(word, options);
        if (option == nullptr) {
            const bool is_number = is_option(word) && word[1] >= '0' && word[1] <= '9';
            (is_option(word) && !is_number ? found.unknown : found.arguments).push_back(word);
            continue;
        }
        const std::string rest = word.substr(std::min(is_long ? end + 1 : end, word.size()));
        auto& values = found.values[static_cast<std::size_t>(option - options.data())];
        if (option->value.empty() && is_long && !rest.empty()) {
            found.malformed = usage_error(fmt::format("{} takes no value", dashed(option->name)));
            return found;
        }
        if (option->value.empty()) {
            values.emplace_back("true");
            if (!rest.empty()) words[--next] = "-" + rest;
        } else if (rest.empty() && next == words.size()) {
            found.malformed = missing_value(*option);
            return found;
        } else {
            values.push_back(rest.empty() ? words[next++] : rest);
        }
    }
    for (++next; next < words.size(); ++next) found.arguments.push_back(words[next]);
    return found;
}

// Returns what is wrong with the values of an option. If the option cannot be repeated, only its
// last value counts.
std::vector<Diagnostic> check_values(const OptionRow& option,
                                     const std::vector<std::string>& values) {
    std::vector<Diagnostic> problems;
    for (const std::string& value : values) {
        const bool counts = option.repeatable || &value == &values.back();
        const bool known = std::ranges::find(option.choices, value) != option.choices.end();
        if (!option.choices.empty() && !known) problems.push_back(unknown_choice(option, value));
        if (!option.check || !counts) continue;
        const auto found = option.check(value);
        problems.insert(problems.end(), found.begin(), found.end());
    }
    return problems;
}

// Whether a word in place of a value is a known option. In `--output --force` the folder was
// forgotten; it is not called `--force`.
bool is_known_option(std::string_view word, std::span<const OptionRow> options) {
    return word.starts_with("--") && find_option(options, word.substr(2)) != nullptr;
}

void take_options(const Found& found, std::span<const OptionRow> options, CommandLine& line) {
    for (std::size_t i = 0; i < options.size(); ++i) {
        const OptionRow& option = options[i];
        if (found.values[i].empty()) continue;
        if (is_known_option(found.values[i].back(), options)) {
            line.diagnostics.push_back(missing_value(option));
            continue;
        }
        if (!option.value.empty()) {
            const auto problems = check_values(option, found.values[i]);
            line.diagnostics.insert(line.diagnostics.end(), problems.begin(), problems.end());
            if (!problems.empty()) continue;
        }
        line.invocation.give(option.name, found.values[i]);
    }
}

void take_arguments(const Found& found, const Command& command, CommandLine& line) {
    const std::vector<Argument>& wanted = command.arguments;
    for (std::size_t i = 0; i < found.arguments.size(); ++i) {
        const bool known = i < wanted.size() || (!wanted.empty() && wanted.back().repeatable);
        if (known) {
            line.invocation.add_argument(found.arguments[i]);
        } else {
            line.diagnostics.push_back(
                usage_error(fmt::format("unexpected argument `{}`", found.arguments[i]),
                            fmt::format("`skybake {} --help` shows what it takes", command.name)));
        }
    }
    for (std::size_t i = found.arguments.size(); i < wanted.size(); ++i) {
        if (!wanted[i].required) break;
        line.diagnostics.push_back(
            usage_error(fmt::format("`skybake {}` needs <{}>", command.name, wanted[i].name),
                        fmt::format("for example {}", command.examples.front().command)));
    }
}

}  // namespace

Diagnostic unknown_command(const std::string& name, std::span<const Command> commands) {
    const auto names = mapped<std::string_view>(commands, &Command::name);
    std::string hint = config::did_you_mean(name, names);
    if (hint.empty()) hint = "`skybake --help` lists the commands";
    return usage_error(fmt::format("unknown command `{}`", name), std::move(hint));
}

Diagnostic usage_error(std::string message, std::string label) {
    return diagnosis("E0001", std::move(message), std::move(label));
}

CommandLine parse_arguments(std::span<const std::string> words, std::span<const Command> commands,
                            std::span<const OptionRow> global_options) {
    CommandLine line;
    std::vector<std::string> rest(words.begin(), words.end());
    std::vector<OptionRow> options(global_options.begin(), global_options.end());
    for (const OptionRow& option : global_options) line.invocation.declare(option);
    const std::size_t position = command_position(words, global_options);
    if (const auto stray = first_stray(words.first(position), global_options)) {
        line.diagnostics.push_back(stray_option(*stray, words, commands, global_options));
        return line;
    }
    if (position < rest.size()) {
        const auto command = std::ranges::find(commands, rest[position], &Command::name);
        if (command == commands.end()) {
            line.diagnostics.push_back(unknown_command(rest[position], commands));
            return line;
        }
        line.command = &*command;
        options.insert(options.end(), command->options.begin(), command->options.end());
        for (const OptionRow& option : command->options) line.invocation.declare(option);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(position));
    }
    const std::string help = line.command != nullptr
                                 ? fmt::format("skybake {} --help", line.command->name)
                                 : "skybake --help";

    const Found found = sort_words(std::move(rest), options);
    if (found.malformed) {
        line.diagnostics.push_back(*found.malformed);
        return line;
    }
    take_options(found, options, line);
    for (const std::string& word : found.unknown) {
        line.diagnostics.push_back(unknown_option(word, options, help));
    }
    const bool asks_only = line.invocation[options::help] || line.invocation[options::version];
    if (line.command != nullptr && !asks_only && line.diagnostics.empty()) {
        take_arguments(found, *line.command, line);
    }
    return line;
}

}  // namespace skybake::cli
