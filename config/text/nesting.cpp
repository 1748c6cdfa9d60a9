#include "config/text/nesting.h"

#include <algorithm>

namespace skybake::config {
namespace {

std::size_t find_or_end(std::string_view text, std::string_view what, std::size_t from) {
    return std::min(text.find(what, from), text.size());
}

// The end of a string that is opened at `at`, as TOML sees it: three quotes open a text that spans
// lines; in the others a line break ends the string, since that is an error the parser will report.
std::size_t skip_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    const bool spans_lines = text.substr(at, 3) == three;
    for (at += spans_lines ? 3 : 1; at < text.size(); ++at) {
        if (quote == '"' && text[at] == '\\') {
            ++at;
        } else if (spans_lines ? text.substr(at, 3) == three : text[at] == quote) {
            return at + (spans_lines ? 3 : 1);
        } else if (!spans_lines && text[at] == '\n') {
            return at;
        }
    }
    return text.size();
}

}  // namespace

std::optional<TextPosition> find_deep_nesting(std::string_view text, int limit) {
    int names = 1;
    int brackets = 0;
    std::size_t at = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = skip_string(text, at);
            continue;
        }
        if (c == '#') {
            at = find_or_end(text, "\n", at);
            continue;
        }
        if (c == '.') {
            ++names;
        } else if (c == '[' || c == '{') {
            names = 1;
            ++brackets;
        } else if (c == ']' || c == '}') {
            names = 1;
            brackets = std::max(0, brackets - 1);
        } else if (c == '\n' || c == ',' || c == '=') {
            names = 1;
        }
        if (names > limit || brackets > limit) return text_position(text, at);
        ++at;
    }
    return std::nullopt;
}

TextPosition text_position(std::string_view text, std::size_t offset) {
    TextPosition position{1, 1};
    for (const char c : text.substr(0, offset)) {
        if (c == '\n') {
            ++position.line;
            position.column = 1;
        } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {
            ++position.column;
        }
    }
    return position;
}

}  // namespace skybake::config
