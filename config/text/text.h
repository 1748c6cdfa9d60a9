// Words and lines of text: UTF-8, columns, settings of the command line, and the word that was
// probably meant.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace skybake::config {

// Is a text UTF-8?

// The offset of the first byte that is no UTF-8 (overlong forms, surrogates and values above
// U+10FFFF included) or is a NUL; none if all is well.
std::optional<std::size_t> find_invalid_utf8(std::string_view text);

// Laying out paragraphs of plain text.

// Breaks text at blanks into lines of at most `width` characters, each behind the prefix and ended
// by a newline. Newlines in the text stay.
std::string wrap(std::string_view text, std::string_view prefix, std::size_t width);

// The parts of KEY=VALUE texts of the command line.

// Without the blanks and tabs at both ends.
std::string_view trim(std::string_view text);

// Where the '=' between key and value stands: not one in the quotes of a name. npos if there is
// none.
std::size_t find_equals(std::string_view setting);

// The nearest known name to a misspelt one.

// Restricted Damerau-Levenshtein distance in bytes: insertions, deletions, substitutions and swaps
// of neighbours each cost 1.
int edit_distance(std::string_view a, std::string_view b);

// The known name nearest to `name`, the first of equals; none if every one is further away than a
// third of the name's length plus one. A `name` longer than any sensible one has no neighbour.
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known);

// "did you mean `x`?", or nothing.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

// Reading a small text file, with a bound on its size.

// A recipe and each file that it includes may be as long as this.
inline constexpr std::size_t most_recipe_bytes = std::size_t{4} << 20;

struct FileError {
    bool too_large = false;
    std::string reason;  // "No such file or directory"
};

// At most one byte more than `most_bytes` is read, so that a file of any size, or a device without
// end, is refused at once. A leading UTF-8 byte order mark is left out.
std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

// The same of standard input, to its end.
std::variant<std::string, FileError> read_standard_input(std::size_t most_bytes);

std::string without_byte_order_mark(std::string text);

// A look at a TOML text before it is parsed: how deeply it nests. The parser builds one table per
// name of a dotted key, and trees of tables are freed by recursion, so `a.a.a.a...` of a few
// hundred thousand names would overrun the stack. A recipe needs a depth of four.
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
