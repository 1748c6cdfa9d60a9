// skybake help: shows the help of the program or of a command.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/table_printer.h"

namespace skybake::cli {

namespace options {

inline const Option<bool> man{"man"};
inline const Option<Shell> completion{
    "completion", 0, "SHELL", {{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}}};

}  // namespace options

namespace {

constexpr std::array<ExitCodeWords, 7> exit_code_words = {{
    {ExitCode::done, "done"},
    {ExitCode::differs, "a comparison or verification found differences"},
    {ExitCode::usage, "usage or parameter error"},
    {ExitCode::io, "a file cannot be opened, read or written"},
    {ExitCode::checks, "the result failed its checks"},
    {ExitCode::internal, "internal error"},
    {ExitCode::interrupted, "interrupted"},
}};

// Returns "-o, --output FOLDER". Long names are aligned even if there is no short one.
std::string option_text(const OptionRow& option) {
    const std::string short_name =
        option.short_name != 0 ? fmt::format("-{}, ", option.short_name) : "    ";
    const std::string value = option.value.empty() ? "" : fmt::format(" {}", option.value);
    return fmt::format("{}--{}{}", short_name, option.name, value);
}

std::string option_table(std::span<const OptionRow> options) {
    TextTable table;
    for (const OptionRow& option : options)
        table.add_row({option_text(option), option_help(option)});
    return table.text();
}

// Returns a table of two members of each row.
template <class Rows, class Row>
std::string table_of(const Rows& rows, std::string_view Row::*first,
                     std::string_view Row::*second) {
    TextTable table;
    for (const Row& row : rows) table.add_row({std::string(row.*first), std::string(row.*second)});
    return table.text();
}

std::string exit_code_table(std::span<const ExitCode> codes) {
    TextTable table({Align::right});
    for (const auto& [code, words] : exit_codes(codes)) {
        table.add_row({fmt::format("{}", static_cast<int>(code)), std::string(words)});
    }
    return table.text();
}

std::string usage_line(const Command& command) {
    std::string line = fmt::format("usage: skybake {}", command.name);
    for (const Argument& argument : command.arguments) {
        const std::string name =
            fmt::format("{}{}", argument.name, argument.repeatable ? "..." : "");
        line += argument.required ? fmt::format(" <{}>", name) : fmt::format(" [{}]", name);
    }
    return line + " [options]\n";
}

constexpr std::array<Example, 1> first_steps = {{
    {"skybake bake earth.toml -o out", "bakes its tables and measures their errors"},
}};

std::string global_help() {
    std::string text = fmt::format("skybake {}\n", program_summary) +
                       "usage: skybake <command> [recipe.toml] [options]\n\ncommands:\n";
    text += table_of(commands(), &Command::name, &Command::summary);
    text += "\noptions (after the command):\n" + option_table(global_options());
    text += "\nexamples:\n" + table_of(first_steps, &Example::command, &Example::what);
    return text + "\nexit codes:\n" + exit_code_table({});
}

std::string command_help(const Command& command) {
    std::string text = fmt::format("skybake {}: {}\n\n", command.name, command.summary);
    text += usage_line(command);
    if (!command.arguments.empty()) {
        text += "\narguments:\n" + table_of(command.arguments, &Argument::name, &Argument::help);
    }
    text += "\noptions (`skybake help` shows those that every command has):\n" +
            option_table(command.options);
    text += "\nexamples:\n" + table_of(command.examples, &Example::command, &Example::what);
    std::vector<ExitCode> codes = command.exit_codes;
    codes.insert(codes.end(), {ExitCode::done, ExitCode::usage});
    return text + "\nexit codes:\n" + exit_code_table(codes);
}

ExitCode print(const std::string& text, Console& console) {
    console.result(console.json() ? event_line({{"event", "help"}, {"text", text}}) : text);
    return ExitCode::done;
}

ExitCode run_help(const Invocation& invocation, Console& console) {
    if (invocation.has(options::completion)) {
        return print(completion(invocation[options::completion]), console);
    }
    const Command* command = nullptr;
    if (!invocation.arguments().empty()) {
        const std::string& name = invocation.arguments()[0];
        const auto found = std::ranges::find(commands(), name, &Command::name);
        if (found == commands().end()) {
            return console.report(std::array{unknown_command(name, commands())});
        }
        command = &*found;
    }
    if (invocation[options::man]) {
        return print(command != nullptr ? man_page(*command) : man_page(first_steps), console);
    }
    show_help(command, console);
    return ExitCode::done;
}

}  // namespace

std::vector<ExitCodeWords> exit_codes(std::span<const ExitCode> codes) {
    std::vector<ExitCodeWords> known(exit_code_words.begin(), exit_code_words.end());
    std::erase_if(known, [&](const ExitCodeWords& entry) {
        return !codes.empty() && std::ranges::find(codes, entry.code) == codes.end();
    });
    return known;
}

std::string option_help(const OptionRow& option) {
    std::string text(option.help);
    if (!option.choices.empty()) text += fmt::format(": {}", fmt::join(option.choices, ", "));
    if (!option.fallback.empty()) text += fmt::format(" (default {})", option.fallback);
    if (option.repeatable) text += "; may be given more than once";
    return text;
}

std::string short_help() {
    TextTable table;
    const std::vector<Command>& all = commands();
    const std::size_t rows = (all.size() + 1) / 2;
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<std::string> row;
        for (std::size_t k = i; k < all.size(); k += rows) {
            row.emplace_back(all[k].name);
            row.emplace_back(all[k].brief);
        }
        table.add_row(row);
    }
    return "usage: skybake <command> [recipe.toml] [options]\n" + table.text() +
           "`skybake help` and `skybake help <command>` show more\n";
}

void show_help(const Command* command, Console& console) {
    print(command != nullptr ? command_help(*command) : global_help(), console);
}

Command help_command() {
    return {.name = "help",
            .brief = "show help",
            .summary = "show this help, or the help of a command",
            .arguments = {{.name = "command",
                           .help = "the command to explain (default: all commands, one line each)",
                           .required = false}},
            .options = {options::man("print the man page, for man -l"),
                        options::completion("print a script that completes words in this shell")},
            .examples = {{"skybake help bake", "shows what `skybake bake --help` shows"},
                         {"skybake help bake --man | man -l -", "shows the man page"},
                         {"source <(skybake help --completion bash)",
                          "completes commands and options in this shell"}},
            .run = run_help};
}

}  // namespace skybake::cli
