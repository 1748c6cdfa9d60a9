#include "cli/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

struct ExitCodeWords {
    ExitCode code;
    std::string_view words;
};
constexpr std::array<ExitCodeWords, 7> exit_code_words = {{
    {ExitCode::done, "done"},
    {ExitCode::differs, "a comparison or verification found differences"},
    {ExitCode::usage, "usage or parameter error"},
    {ExitCode::io, "a file cannot be opened, read or written"},
    {ExitCode::checks, "the result failed its checks"},
    {ExitCode::internal, "internal error"},
    {ExitCode::interrupted, "interrupted"},
}};

// "-o, --output FOLDER"; long names are aligned whether there is a short one or not.
std::string option_text(const Option& option) {
    const std::string short_name =
        option.short_name != 0 ? fmt::format("-{}, ", option.short_name) : "    ";
    const std::string value = option.value.empty() ? "" : fmt::format(" {}", option.value);
    return fmt::format("{}--{}{}", short_name, option.name, value);
}

std::string option_help(const Option& option) {
    std::string text(option.help);
    if (!option.choices.empty()) text += fmt::format(": {}", fmt::join(option.choices, ", "));
    if (!option.fallback.empty()) text += fmt::format(" (default {})", option.fallback);
    if (option.repeatable) text += "; may be given more than once";
    return text;
}

std::string option_table(std::span<const Option> options) {
    TextTable table;
    for (const Option& option : options) table.add_row({option_text(option), option_help(option)});
    return table.text();
}

std::string example_table(std::span<const Example> examples) {
    TextTable table;
    for (const Example& example : examples) {
        table.add_row({std::string(example.command), std::string(example.what)});
    }
    return table.text();
}

std::string command_table(std::span<const Command> commands) {
    TextTable table;
    for (const Command& command : commands) {
        table.add_row({std::string(command.name), std::string(command.summary)});
    }
    return table.text();
}

// The codes that a command may return, one per line; an empty list stands for all.
std::string exit_code_table(std::span<const ExitCode> codes) {
    TextTable table({Align::right});
    for (const ExitCodeWords& entry : exit_code_words) {
        if (codes.empty() || std::find(codes.begin(), codes.end(), entry.code) != codes.end()) {
            table.add_row(
                {fmt::format("{}", static_cast<int>(entry.code)), std::string(entry.words)});
        }
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

constexpr std::array<Example, 2> first_steps = {{
    {"skybake init earth.toml", "writes a commented recipe"},
    {"skybake bake earth.toml -o out", "bakes its tables and measures their errors"},
}};

}  // namespace

std::string short_help(std::span<const Command> commands) {
    TextTable table;
    const std::size_t rows = (commands.size() + 1) / 2;
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<std::string> row;
        for (std::size_t k = i; k < commands.size(); k += rows) {
            row.emplace_back(commands[k].name);
            row.emplace_back(commands[k].brief);
        }
        table.add_row(row);
    }
    return "usage: skybake <command> [recipe.toml] [options]\n" + table.text() +
           "`skybake help` and `skybake help <command>` show more\n";
}

std::string global_help(std::span<const Command> commands, std::span<const Option> global_options) {
    std::string text =
        "skybake bakes sky tables, cloud noise and cloud volumes, and measures their errors\n"
        "usage: skybake <command> [recipe.toml] [options]\n\ncommands:\n";
    text += command_table(commands);
    text += "\noptions (after the command):\n" + option_table(global_options);
    text += "\nexamples:\n" + example_table(first_steps);
    return text + "\nexit codes:\n" + exit_code_table({});
}

std::string command_help(const Command& command) {
    std::string text = fmt::format("skybake {}: {}\n\n", command.name, command.summary);
    text += usage_line(command);
    if (!command.arguments.empty()) {
        TextTable table;
        for (const Argument& argument : command.arguments) {
            table.add_row({std::string(argument.name), std::string(argument.help)});
        }
        text += "\narguments:\n" + table.text();
    }
    if (!command.options.empty()) text += "\noptions:\n" + option_table(command.options);
    text += "\n`skybake help` shows the options that every command has.\n";
    text += "\nexamples:\n" + example_table(command.examples);
    std::vector<ExitCode> codes = command.exit_codes;
    codes.insert(codes.end(), {ExitCode::done, ExitCode::usage});
    return text + "\nexit codes:\n" + exit_code_table(codes);
}

}  // namespace skybake::cli
