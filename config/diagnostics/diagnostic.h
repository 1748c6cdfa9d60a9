// Errors and warnings are values with an address: collected, never thrown, shown by cli/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/text/value_tree.h"

namespace skybake::config {

enum class Severity { error, warning };

// Where in the user's text something stands. `source` is a file's path as the user wrote it, or
// "--set `a.b=c`". line and column count from 1; 0 where the place is not known.
struct SourceRange {
    std::string source;
    int line = 0;
    int column = 0;
    int length = 0;
    std::string line_text;
};

struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;     // "E0102", see diagnostic_codes.h
    std::string message;  // one sentence: what was found
    SourceRange where;
    std::string label;  // beside the caret: what is allowed, or the nearest known name
};

// A value, or the diagnostics that say why there is none; warnings may accompany a value.
template <class T>
struct [[nodiscard]] Outcome {
    std::optional<T> value;
    std::vector<Diagnostic> diagnostics;
};

// Collects the diagnostics of one recipe while it is read, and hands them over: warnings first, so
// that errors are the last on a terminal, and each in reading order.
class DiagnosticList {
  public:
    void error(std::string code, const Place& place, std::string message, std::string label = "");
    void warning(std::string code, const Place& place, std::string message, std::string label = "");

    bool has_errors() const { return errors_ > 0; }

    // Warnings, then errors, each sorted by source, line and column. More than a person can read is
    // cut off, and a last diagnostic says how many more there were.
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

// The place with the text of its line, without its line ending. Lines too long to show come
// without.
SourceRange source_range(const Place& place);

}  // namespace skybake::config
