// How a command is declared. Parser, help and shell examples all come from these tables.
//
// One file per command:
//
//   ExitCode run(const Invocation& invocation, Console& console) { ... }
//   Command verify_command() { return {.name = "verify", .summary = "...", ..., .run = run}; }
//
// and one line in commands.cpp.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/exit_code.h"

namespace skybake::cli {

class Console;

struct Argument {
    std::string_view name = {};  // "recipe.toml", as help shows it
    std::string_view help = {};
    bool required = true;
    bool repeatable = false;  // the last argument only
};

struct Option {
    std::string_view name = {};   // long name without dashes: "dry-run"
    char short_name = 0;          // 'j', or 0
    std::string_view value = {};  // what stands after it: "N", "FILE"; empty for a switch
    std::string_view help = {};
    bool repeatable = false;                     // else the last one wins
    std::vector<std::string_view> choices = {};  // the only values allowed; empty: any
    std::string_view fallback = {};              // the value if not given, as help shows it
};

// What the user typed, checked against the command's tables.
class Invocation {
  public:
    bool has(std::string_view option) const { return options_.find(option) != options_.end(); }
    // The (last) value given, else the table's fallback, else empty.
    std::string value(std::string_view option) const;
    // All values given to a repeatable option, in order.
    std::vector<std::string> values(std::string_view option) const;
    // Positional arguments, in order; at least the required ones are there.
    const std::vector<std::string>& arguments() const { return arguments_; }

    void add_option(std::string_view name, std::vector<std::string> values);
    void add_fallback(std::string_view name, std::string_view value);
    void add_argument(std::string text) { arguments_.push_back(std::move(text)); }

  private:
    std::map<std::string, std::vector<std::string>, std::less<>> options_;
    std::map<std::string, std::string, std::less<>> fallbacks_;
    std::vector<std::string> arguments_;
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
    std::vector<Option> options = {};
    std::vector<Example> examples = {};     // at least one
    std::vector<ExitCode> exit_codes = {};  // besides done, usage and interrupted
    ExitCode (*run)(const Invocation& invocation, Console& console) = nullptr;
};

}  // namespace skybake::cli
