// This header holds helpers for text: it checks UTF-8, wraps paragraphs, splits KEY=VALUE settings,
// finds the name that was probably meant, reads text files, and finds positions in a text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace skybake::config {

// Returns the offset of the first byte that is not UTF-8 or is a NUL, or none if there is no such
// byte. Overlong forms, surrogates and values above U+10FFFF are not UTF-8.
std::optional<std::size_t> find_invalid_utf8(std::string_view text);

// Breaks text at blanks into lines of at most `width` characters. Each line begins with the prefix
// and ends with a newline. Newlines in the text are kept.
std::string wrap(std::string_view text, std::string_view prefix, std::size_t width);

// Returns the text without the blanks and tabs at both ends.
std::string_view trim(std::string_view text);

// Returns the text with the letters A to Z in lower case, in any locale.
std::string lower_case(std::string_view text);

// Returns a text in which each of the given characters is replaced.
std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<char, std::string_view>> signs);

// Returns the position of the '=' between key and value. A '=' within the quotes of a name does not
// count. Returns npos if there is none.
std::size_t find_equals(std::string_view setting);

// Returns the restricted Damerau-Levenshtein distance in bytes: an insertion, a deletion, a
// substitution and a swap of neighbours each cost 1.
int edit_distance(std::string_view a, std::string_view b);

// Returns the known name nearest to `name`, the first one if several are equally near. Returns none
// if every name is further away than a third of the length of `name` plus one, or if `name` is
// unreasonably long.
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known);

// Returns "did you mean `x`?", or an empty text.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

// A recipe, and each file that it includes, may have at most this many bytes.
inline constexpr std::size_t most_recipe_bytes = std::size_t{4} << 20;

struct FileError {
    bool too_large = false;
    std::string reason;  // "No such file or directory"
};

// Reads a small text file. It reads at most one byte more than `most_bytes`, so that a huge file,
// or a device without end, is refused at once. A leading UTF-8 byte order mark is left out.
std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

// Reads standard input to its end in the same way.
std::variant<std::string, FileError> read_standard_input(std::size_t most_bytes);

std::string without_byte_order_mark(std::string text);

// Returns the pieces of a list between its marks, such as commas, including empty ones.
std::vector<std::string_view> pieces_between(std::string_view list, char mark);

// This is a position in a text.
struct TextPosition {
    int line = 0;    // from 1
    int column = 0;  // from 1, in code points
};

// Looks at a TOML text before it is parsed, and returns the first position where a key has more
// than `limit` names or brackets nest more than `limit` deep, or none. The parser builds one table
// per name of a dotted key, and trees of tables are freed by recursion, so `a.a.a.a...` with a few
// hundred thousand names would overrun the stack. A recipe needs a depth of four. The text need not
// be valid TOML. Strings and comments do not count.
std::optional<TextPosition> find_deep_nesting(std::string_view text, int limit);

// Returns the line and column of a byte of the text.
TextPosition text_position(std::string_view text, std::size_t offset);

}  // namespace skybake::config
