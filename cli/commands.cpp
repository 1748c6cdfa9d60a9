#include "cli/commands.h"

namespace skybake::cli {

// Each is defined in NAME_command.cpp.
Command init_command();
Command check_command();
Command show_command();
Command explain_command();
Command schema_command();
Command bake_command();
Command sweep_command();
Command preview_command();
Command report_command();
Command info_command();
Command diff_command();
Command verify_command();
Command cache_command();
Command help_command();

const std::vector<Command>& commands() {
    static const std::vector<Command> table = {
        init_command(), check_command(),  show_command(),    explain_command(), schema_command(),
        bake_command(), sweep_command(),  preview_command(), report_command(),  info_command(),
        diff_command(), verify_command(), cache_command(),   help_command(),
    };
    return table;
}

const std::vector<Option>& global_options() {
    static const std::vector<Option> table = {
        {.name = "help", .short_name = 'h', .help = "show this help, or the help of a command"},
        {.name = "version", .short_name = 'V', .help = "show the version"},
        {.name = "quiet", .short_name = 'q', .help = "print only errors and warnings"},
        {.name = "verbose", .short_name = 'v', .help = "print more"},
        {.name = "json", .help = "print results and failures as JSON Lines on stdout"},
        {.name = "color",
         .value = "WHEN",
         .help = "when to colour messages",
         .choices = {"auto", "always", "never"},
         .fallback = "auto"},
        {.name = "diagnostics",
         .value = "FORMAT",
         .help = "how to print errors and warnings",
         .choices = {"human", "short", "json", "github", "sarif"},
         .fallback = "human"},
    };
    return table;
}

const Command* find_command(std::string_view name) {
    for (const Command& command : commands()) {
        if (command.name == name) return &command;
    }
    return nullptr;
}

}  // namespace skybake::cli
