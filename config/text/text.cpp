#include "config/text/text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

namespace skybake::config {
namespace {

// These are the well-formed sequences of Unicode 15, table 3-7: the range of the first byte, the
// range of the second, and the length. Later bytes are 80..BF.
struct Sequence {
    unsigned char first_minimum, first_maximum;
    unsigned char second_minimum, second_maximum;
    std::size_t length;
};

constexpr std::array sequences = {
    Sequence{0x01, 0x7f, 0, 0, 1},       Sequence{0xc2, 0xdf, 0x80, 0xbf, 2},
    Sequence{0xe0, 0xe0, 0xa0, 0xbf, 3}, Sequence{0xe1, 0xec, 0x80, 0xbf, 3},
    Sequence{0xed, 0xed, 0x80, 0x9f, 3}, Sequence{0xee, 0xef, 0x80, 0xbf, 3},
    Sequence{0xf0, 0xf0, 0x90, 0xbf, 4}, Sequence{0xf1, 0xf3, 0x80, 0xbf, 4},
    Sequence{0xf4, 0xf4, 0x80, 0x8f, 4},
};

bool within(char c, unsigned char minimum, unsigned char maximum) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= minimum && byte <= maximum;
}

// Returns the length of the well-formed sequence at the head of a text that is not empty, or 0 if
// there is none.
std::size_t sequence_length(std::string_view text) {
    for (const Sequence& sequence : sequences) {
        if (!within(text[0], sequence.first_minimum, sequence.first_maximum)) continue;
        if (text.size() < sequence.length) return 0;
        for (std::size_t i = 1; i < sequence.length; ++i) {
            const bool valid =
                i == 1 ? within(text[i], sequence.second_minimum, sequence.second_maximum)
                       : within(text[i], 0x80, 0xbf);
            if (!valid) return 0;
        }
        return sequence.length;
    }
    return 0;
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

std::string wrap_line(std::string_view text, std::string_view prefix, std::size_t width) {
    std::string result;
    std::string line(prefix);
    bool empty = true;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        if (!empty && characters(line) + 1 + characters(word) > width) {
            result += line + '\n';
            line = prefix;
            empty = true;
        }
        if (!empty) line += ' ';
        line += word;
        empty = false;
    }
    return result + line + '\n';
}

FileError system_error() { return {false, std::generic_category().message(errno)}; }

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::variant<std::string, FileError> read_text(std::FILE* file, std::size_t most_bytes) {
    std::string text;
    constexpr std::size_t block = 65536;
    while (text.size() <= most_bytes) {
        const std::size_t before = text.size();
        text.resize(before + block);
        const std::size_t count = std::fread(text.data() + before, 1, block, file);
        text.resize(before + count);
        if (count < block && std::ferror(file) && errno == EINTR) {
            std::clearerr(file);
        } else if (count == 0) {
            break;
        }
    }
    if (std::ferror(file)) return system_error();
    if (text.size() > most_bytes) return FileError{true, "File too large"};
    return without_byte_order_mark(std::move(text));
}

// Returns the end of a string that opens at `at`, as TOML sees it. Three quotes open a text that
// may span lines. In other strings a line break ends the string, because it is an error that the
// parser will report.
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

std::optional<std::size_t> find_invalid_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = sequence_length(text.substr(at));
        if (length == 0) return at;
        at += length;
    }
    return std::nullopt;
}

std::string wrap(std::string_view text, std::string_view prefix, std::size_t width) {
    std::string result;
    for (const std::string_view line : pieces_between(text, '\n')) {
        result += wrap_line(line, prefix, width);
    }
    return result;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string lower;
    for (const char c : text) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<char, std::string_view>> signs) {
    std::string result;
    for (const char sign : text) {
        std::string_view written(&sign, 1);
        for (const auto& [from, to] : signs) {
            if (from == sign) written = to;
        }
        result += written;
    }
    return result;
}

std::size_t find_equals(std::string_view setting) {
    bool quoted = false;
    for (std::size_t i = 0; i < setting.size(); ++i) {
        if (quoted && setting[i] == '\\') {
            ++i;
        } else if (setting[i] == '"') {
            quoted = !quoted;
        } else if (setting[i] == '=' && !quoted) {
            return i;
        }
    }
    return std::string_view::npos;
}

int edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<int> before_last(columns);
    std::vector<int> last(columns);
    std::vector<int> row(columns);
    for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j < columns; ++j) {
            const int substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known) {
    constexpr std::size_t longest_sensible_name = 80;
    if (name.empty() || name.size() > longest_sensible_name) return std::nullopt;
    int best = static_cast<int>(name.size()) / 3 + 1;
    std::optional<std::string> nearest;
    for (const std::string_view candidate : known) {
        const int distance = edit_distance(name, candidate);
        // A name that keeps none of its letters is not near, however short it is.
        if (distance >= static_cast<int>(name.size())) continue;
        if (nearest ? distance < best : distance <= best) {
            best = distance;
            nearest = std::string(candidate);
        }
    }
    return nearest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
    const std::optional<std::string> nearest = nearest_name(name, known);
    return nearest ? "did you mean `" + *nearest + "`?" : "";
}

std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes) {
    // The file is opened with fopen because the streams of the standard library do not say why they
    // failed.
    std::unique_ptr<std::FILE, FileCloser> file;
    do {
        file.reset(std::fopen(path.c_str(), "rb"));
    } while (!file && errno == EINTR);
    if (!file) return system_error();
    return read_text(file.get(), most_bytes);
}

std::variant<std::string, FileError> read_standard_input(std::size_t most_bytes) {
    return read_text(stdin, most_bytes);
}

std::string without_byte_order_mark(std::string text) {
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

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
            at = std::min(text.find('\n', at), text.size());
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

std::vector<std::string_view> pieces_between(std::string_view list, char mark) {
    std::vector<std::string_view> pieces;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(mark, at), list.size());
        pieces.push_back(list.substr(at, end - at));
        at = end + 1;
    }
    return pieces;
}

TextPosition text_position(std::string_view text, std::size_t offset) {
    TextPosition position{1, 1};
    for (const char c : text.substr(0, offset)) {
        if (c == '\n') {
            ++position.line;
            position.column = 1;
        } else if (begins_character(c)) {
            ++position.column;
        }
    }
    return position;
}

}  // namespace skybake::config
