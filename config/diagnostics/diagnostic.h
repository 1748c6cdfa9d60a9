// Errors and warnings are values with an address: collected, never thrown, shown by cli/.
#pragma once

#include <optional>
#include <string>
#include <vector>

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
struct Outcome {
    std::optional<T> value;
    std::vector<Diagnostic> diagnostics;
};

}  // namespace skybake::config
