// A look at a TOML text before it is parsed: how deeply it nests. The parser builds one table per
// name of a dotted key, and trees of tables are freed by recursion, so `a.a.a.a...` of a few
// hundred thousand names would overrun the stack. A recipe needs a depth of four.
#pragma once

#include <optional>
#include <string_view>

namespace skybake::config {

struct TextPosition {
    int line = 0;    // from 1
    int column = 0;  // from 1, in code points
};

// Where a key has more than `limit` names or brackets nest more than `limit` deep; none if nowhere.
// The text need not be valid TOML. Strings and comments do not count.
std::optional<TextPosition> find_deep_nesting(std::string_view text, int limit);

// The line and column of a byte of the text.
TextPosition text_position(std::string_view text, std::size_t offset);

}  // namespace skybake::config
