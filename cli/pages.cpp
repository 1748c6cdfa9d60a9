// This file makes man pages and shell completions from the tables of commands and options. They
// hold no date, so that equal programs have equal pages.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bakers/io/manifest/release.h"
#include "cli/command.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

using config::replaced;

// --- Man pages ----------------------------------------------------------------------------------

// Returns text for a roff source. None of its lines begins with a full stop or an apostrophe, which
// would make the line a request.
std::string roff(std::string_view text) {
    const bool request = text.starts_with('.') || text.starts_with('\'');
    return (request ? "\\&" : "") +
           replaced(text, {{'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}});
}

// Returns a paragraph with a term and its meaning.
std::string term(const std::string& markup, std::string_view text) {
    return fmt::format(".TP\n{}\n{}\n", markup, roff(text));
}

std::string page_head(const std::string& name, std::string_view what) {
    return fmt::format(".TH {} 1 \"\" \"skybake {}\" \"User Commands\"\n.nh\n.SH NAME\n{} \\- {}\n",
                       replaced(name, {{'-', "\\-"}}), release(), roff(name), roff(what));
}

std::string option_terms(std::span<const OptionRow> options) {
    std::string text;
    for (const OptionRow& option : options) {
        std::string markup =
            option.short_name != 0 ? fmt::format("\\fB\\-{}\\fR, ", option.short_name) : "";
        markup += fmt::format("\\fB\\-\\-{}\\fR", roff(option.name));
        if (!option.value.empty()) markup += fmt::format(" \\fI{}\\fR", roff(option.value));
        text += term(markup, option_help(option));
    }
    return text;
}

std::string example_terms(std::span<const Example> examples) {
    std::string text = ".SH EXAMPLES\n";
    for (const Example& example : examples) {
        text += term(fmt::format("\\fB{}\\fR", roff(example.command)), example.what);
    }
    return text;
}

std::string exit_terms(std::span<const ExitCode> codes) {
    std::string text = ".SH EXIT STATUS\n";
    for (const auto& [code, words] : exit_codes(codes)) {
        text += term(fmt::format("\\fB{}\\fR", static_cast<int>(code)), words);
    }
    return text;
}

std::string synopsis(const Command& command) {
    std::string text = fmt::format(".SH SYNOPSIS\n\\fBskybake {}\\fR", command.name);
    for (const Argument& argument : command.arguments) {
        const std::string name =
            fmt::format("\\fI{}\\fR{}", roff(argument.name), argument.repeatable ? "..." : "");
        text += argument.required ? " " + name : fmt::format(" [{}]", name);
    }
    return text + " [\\fIoptions\\fR]\n";
}

// --- Completions --------------------------------------------------------------------------------

// Returns the spellings of an option, "-o" and "--output". A shell completes them, and they may
// stand before a value.
std::vector<std::string> spellings(const OptionRow& option) {
    std::vector<std::string> words;
    if (option.short_name != 0) words.push_back(fmt::format("-{}", option.short_name));
    words.push_back(fmt::format("--{}", option.name));
    return words;
}

// Returns the names that shells complete for an argument. For `help` these are the names of the
// commands.
std::vector<std::string_view> argument_choices(const Command& command) {
    std::vector<std::string_view> choices;
    if (command.name == "help") {
        for (const Command& other : commands()) choices.push_back(other.name);
    } else if (!command.arguments.empty()) {
        choices = command.arguments[0].choices;
    }
    return choices;
}

// Returns the values of an option that shells offer.
std::string offered(const OptionRow& option) {
    if (!option.choices.empty()) return fmt::format("{}", fmt::join(option.choices, " "));
    return fmt::format("{}", fmt::join(option.offered, " "));
}

// Returns how a shell completes the values of an option: by words, by folders, by files, or otherwise.
std::string completed_by(const OptionRow& option, const std::string& words, const char* folders,
                         const char* files, const char* otherwise) {
    if (!offered(option).empty()) return words;
    if (!option.is_path) return otherwise;
    return option.value == "FOLDER" ? folders : files;
}

// Returns the cases `COMMAND:OPTION`, where OPTION is the word before the cursor, that complete the
// option's value.
std::string bash_values(std::string_view command, std::span<const OptionRow> options) {
    std::string text;
    for (const OptionRow& option : options) {
        if (option.value.empty()) continue;
        std::vector<std::string> patterns;
        for (const std::string& word : spellings(option)) {
            patterns.push_back(fmt::format("{}:{}", command, word));
        }
        const std::string reply =
            completed_by(option, fmt::format("_skybake_words \"{}\"", offered(option)),
                         "_skybake_paths -d", "_skybake_paths -f", ":");
        text += fmt::format("        {}) {}; return ;;\n", fmt::join(patterns, "|"), reply);
    }
    return text;
}

std::string bash_words(std::span<const OptionRow> options) {
    std::string text;
    for (const OptionRow& option : options) {
        text += fmt::format(" {}", fmt::join(spellings(option), " "));
    }
    return text;
}

constexpr std::string_view bash_functions = R"(# bash completion for skybake
_skybake_words() {
    COMPREPLY=($(compgen -W "$1" -- "$cur"))
    # A value follows the equals sign.
    [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace 2>/dev/null || true
}
_skybake_paths() {
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen "$1" -- "$cur"))
}
_skybake() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= i
    COMPREPLY=()
    # --option=value is three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = && COMP_CWORD -gt 1 ]]; then
        prev=${COMP_WORDS[COMP_CWORD-2]}
    fi
)";

std::string bash_completion() {
    std::vector<std::string_view> names;
    std::string values, options, arguments;
    for (const Command& command : commands()) {
        names.push_back(command.name);
        values += bash_values(command.name, command.options);
        options += fmt::format("            {}) options+=\"{}\" ;;\n", command.name,
                               bash_words(command.options));
        const auto choices = argument_choices(command);
        if (choices.empty()) continue;
        arguments += fmt::format("        {}) _skybake_words \"{}\" ;;\n", command.name,
                                 fmt::join(choices, " "));
    }
    return fmt::format(
        "{}    for ((i = 1; i < COMP_CWORD; i++)); do\n"
        "        case ${{COMP_WORDS[i]}} in\n"
        "            {}) command=${{COMP_WORDS[i]}}; break ;;\n"
        "        esac\n    done\n"
        "    case $command:$prev in\n{}{}    esac\n"
        "    if [[ $cur == -* ]]; then\n        local options=\"{}\"\n"
        "        case $command in\n{}        esac\n"
        "        _skybake_words \"$options\"\n        return\n    fi\n"
        "    case $command in\n        \"\") _skybake_words \"{}\" ;;\n{}        *) _skybake_paths "
        "-f ;;\n    esac\n}}\n"
        "complete -F _skybake skybake\n",
        bash_functions, fmt::join(names, "|"), bash_values("*", global_options()), values,
        bash_words(global_options()), options, fmt::join(names, " "), arguments);
}

// Puts a text between the single quotes of a shell.
std::string shell_quoted(std::string_view text) {
    return fmt::format("'{}'", replaced(text, {{'\'', "'\\''"}}));
}

std::string zsh_specs(std::span<const OptionRow> options) {
    std::string text;
    for (const OptionRow& option : options) {
        const std::string help = replaced(option.help, {{'[', "\\["}, {']', "\\]"}});
        std::string spec = fmt::format("[{}]", help);
        if (!option.value.empty()) {
            spec += fmt::format(":{}:{}", option.value,
                                completed_by(option, fmt::format("({})", offered(option)),
                                             "_files -/", "_files", " "));
        }
        for (const std::string& word : spellings(option)) {
            const std::string once =
                option.repeatable ? "*" : fmt::format("({})", fmt::join(spellings(option), " "));
            text += fmt::format(" \\\n        {}", shell_quoted(once + word + spec));
        }
    }
    return text;
}

std::string zsh_arguments(const Command& command) {
    std::string text;
    const auto choices = argument_choices(command);
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
        const Argument& argument = command.arguments[i];
        const std::string place = argument.repeatable ? "*" : fmt::format("{}", i + 1);
        const std::string action =
            choices.empty() ? "_files" : fmt::format("({})", fmt::join(choices, " "));
        text += fmt::format(
            " \\\n        {}",
            shell_quoted(fmt::format("{}{}{}:{}", place,
                                     argument.required ? ":" : "::", argument.name, action)));
    }
    return text;
}

std::string zsh_completion() {
    std::string described, cases;
    for (const Command& command : commands()) {
        described += fmt::format("        {}\n",
                                 shell_quoted(fmt::format("{}:{}", command.name, command.summary)));
        cases += fmt::format("    {})\n      _arguments{}{}{}\n      ;;\n", command.name,
                             zsh_specs(global_options()), zsh_specs(command.options),
                             zsh_arguments(command));
    }
    return fmt::format(
        "#compdef skybake\n_skybake() {{\n  local curcontext=$curcontext state line\n"
        "  typeset -A opt_args\n  local -a commands=(\n{}    )\n"
        "  _arguments -C{} \\\n        '1:command:->command' '*::argument:->argument'\n"
        "  case $state in\n  command) _describe command commands ;;\n"
        "  argument)\n    case $words[1] in\n{}    esac\n    ;;\n  esac\n}}\n_skybake \"$@\"\n",
        described, zsh_specs(global_options()), cases);
}

// Returns the fish lines of options. `where` is a condition on the command line, or empty.
std::string fish_options(const std::string& where, std::span<const OptionRow> options) {
    std::string text;
    for (const OptionRow& option : options) {
        text += fmt::format("complete -c skybake{} -l {}", where, option.name);
        if (option.short_name != 0) text += fmt::format(" -s {}", option.short_name);
        text += completed_by(option, fmt::format(" -x -a {}", shell_quoted(offered(option))),
                             " -x -a '(__fish_complete_directories)'", " -r -F",
                             option.value.empty() ? "" : " -x");
        text += fmt::format(" -d {}\n", shell_quoted(option.help));
    }
    return text;
}

std::string fish_completion() {
    std::string text = "# fish completion for skybake\n" + fish_options("", global_options());
    for (const Command& command : commands()) {
        const std::string where = fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name);
        text += fmt::format("complete -c skybake -n __fish_use_subcommand -f -a {} -d {}\n",
                            command.name, shell_quoted(command.summary));
        text += fish_options(where, command.options);
        const auto choices = argument_choices(command);
        if (choices.empty()) continue;
        text += fmt::format("complete -c skybake{} -f -a '{}'\n", where, fmt::join(choices, " "));
    }
    return text;
}

}  // namespace

std::string man_page(std::span<const Example> examples) {
    std::string text = page_head("skybake", program_summary) +
                       ".SH SYNOPSIS\n\\fBskybake\\fR \\fIcommand\\fR [\\fIrecipe.toml\\fR] "
                       "[\\fIoptions\\fR]\n.SH COMMANDS\n";
    for (const Command& command : commands()) {
        text += term(fmt::format("\\fBskybake\\-{}\\fR(1)", command.name), command.summary);
    }
    text +=
        ".SH OPTIONS\nThese options stand after any command.\n" + option_terms(global_options());
    text +=
        ".SH ENVIRONMENT\n" +
        term("\\fBSKYBAKE_CACHE_DIR\\fR",
             "the folder through which bakes share assets, where --cache-dir names none") +
        term("\\fBSKYBAKE_CACHE\\fR",
             "the URL of the server through which bakes share assets, where --cache names none") +
        term("\\fBNO_COLOR\\fR", "messages have no colours if this is set") +
        term("\\fBCLICOLOR_FORCE\\fR, \\fBFORCE_COLOR\\fR",
             "messages have colours even outside a terminal if one of these is set");
    return text + exit_terms({}) + example_terms(examples);
}

std::string man_page(const Command& command) {
    std::string text =
        page_head(fmt::format("skybake-{}", command.name), command.summary) + synopsis(command);
    if (!command.arguments.empty()) text += ".SH ARGUMENTS\n";
    for (const Argument& argument : command.arguments) {
        text += term(fmt::format("\\fI{}\\fR", roff(argument.name)), argument.help);
    }
    if (!command.options.empty()) text += ".SH OPTIONS\n" + option_terms(command.options);
    std::vector<ExitCode> codes = command.exit_codes;
    codes.insert(codes.end(), {ExitCode::done, ExitCode::usage});
    return text + exit_terms(codes) + example_terms(command.examples) +
           ".SH SEE ALSO\n\\fBskybake\\fR(1) has the options that every command takes.\n";
}

std::string completion(Shell shell) {
    if (shell == Shell::bash) return bash_completion();
    if (shell == Shell::zsh) return zsh_completion();
    return fish_completion();
}

}  // namespace skybake::cli
