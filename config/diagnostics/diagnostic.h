// This header defines errors and warnings. They are values with a place: they are collected, never
// thrown, and cli/ shows them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/text/value_tree.h"

namespace skybake::config {

enum class Severity { error, warning };

// This says where something stands in the user's text. `source` is a file's path as the user wrote
// it, or "--set `a.b=c`". Line and column count from 1; they are 0 where the place is not known.
struct SourceRange {
    std::string source;
    int line = 0;
    int column = 0;
    int length = 0;
    std::string line_text;
    bool operator==(const SourceRange&) const = default;
};

template <class T>
struct Outcome;

struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;     // "E0102", see diagnostic_codes.h
    std::string message;  // one sentence: what was found
    SourceRange where;
    std::string label;  // shown beside the caret: what is allowed, or the nearest known name
    std::string key = {};  // of its asset's section, whose place it has; empty: the section's own

    // A function that fails returns its diagnostic.
    template <class T>
    operator Outcome<T>() const {
        return {{}, {*this}};
    }
};

// Returns a diagnostic without a place. Its code, "E0405" or "W0227", says how severe it is.
inline Diagnostic diagnosis(std::string code, std::string message, std::string label = {},
                            std::string key = {}) {
    const Severity severity = code.starts_with('W') ? Severity::warning : Severity::error;
    return {severity, std::move(code), std::move(message), {}, std::move(label), std::move(key)};
}

// This is a value, or the diagnostics that say why there is none. Warnings may accompany a value.
template <class T>
struct [[nodiscard]] Outcome {
    std::optional<T> value;
    std::vector<Diagnostic> diagnostics;
};

// Collects the diagnostics of one recipe while it is read, and hands them over. Warnings come
// first, so that errors are the last lines on a terminal. Each group is in reading order.
class DiagnosticList {
  public:
    void error(std::string code, const Place& place, std::string message, std::string label = "");
    void warning(std::string code, const Place& place, std::string message, std::string label = "");

    bool has_errors() const { return errors_ > 0; }

    // Hands over the warnings and then the errors, each sorted by source, line and column. If there
    // are more than a person can read, it cuts the list off and adds a diagnostic that says how
    // many more there were.
    [[nodiscard]] std::vector<Diagnostic> take();

  private:
    struct Item {
        Severity severity;
        std::string code;
        std::string message;
        Place place;
        std::string label;
    };
    void add(Item item);

    std::vector<Item> items_;
    int errors_ = 0;
    int left_out_ = 0;
};

// Returns the place with the text of its line, without the line ending. A line that is too long to
// show is left out.
SourceRange source_range(const Place& place);

}  // namespace skybake::config

namespace skybake {

// Every room speaks of these.
using config::diagnosis;
using config::Diagnostic;
using config::Outcome;
using config::Severity;

}  // namespace skybake
