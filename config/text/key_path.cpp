#include "config/text/key_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/text/text.h"

namespace skybake::config {
namespace {

bool is_bare_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
}

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
}

std::string hexadecimal(char c) { return fmt::format("{:02x}", static_cast<unsigned char>(c)); }

std::string escape_control(char c) {
    if (c == '\n') return "\\n";
    if (c == '\t') return "\\t";
    if (c == '\r') return "\\r";
    return "\\u00" + hexadecimal(c);
}

// Whether the text begins with a character that turns the direction of what follows on a terminal: U+200E,
// U+200F, U+202A to U+202E, U+2066 to U+2069. They have three bytes.
bool turns_direction(std::string_view text) {
    if (text.size() < 3 || text[0] != '\xe2') return false;
    const auto last = static_cast<unsigned char>(text[2]);
    if (text[1] == '\x81') return last >= 0xa6 && last <= 0xa9;
    return text[1] == '\x80' && (last == 0x8e || last == 0x8f || (last >= 0xaa && last <= 0xae));
}

// Their number is 0x2000, and six bits of each of the last two bytes.
std::string escape_direction(std::string_view text) {
    const bool is_second_block = text[1] == '\x81';
    const auto low = static_cast<unsigned char>(text[2]) & 0x3f;
    return "\\u20" + hexadecimal(static_cast<char>((is_second_block ? 0x40 : 0) + low));
}

int hexadecimal_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
}

// Reads the escape after a backslash at `at`, in the form that toml_string writes.
std::optional<char> read_escape(std::string_view path, std::size_t& at) {
    if (at >= path.size()) return std::nullopt;
    const char c = path[at++];
    if (c == '"' || c == '\\') return c;
    if (c == 'n') return '\n';
    if (c == 't') return '\t';
    if (c == 'r') return '\r';
    if (c != 'u' || path.size() - at < 4 || path.substr(at, 2) != "00") return std::nullopt;
    const int high = hexadecimal_digit(path[at + 2]);
    const int low = hexadecimal_digit(path[at + 3]);
    if (high < 0 || high > 7 || low < 0) return std::nullopt;
    at += 4;
    return static_cast<char>(high * 16 + low);
}

// Reads a quoted name whose opening quote stands before `at`, and moves `at` behind the closing
// one.
std::optional<std::string> read_quoted(std::string_view path, std::size_t& at) {
    std::string name;
    while (at < path.size()) {
        const char c = path[at++];
        if (c == '"') return name;
        if (c != '\\') {
            name += c;
            continue;
        }
        const std::optional<char> escaped = read_escape(path, at);
        if (!escaped) return std::nullopt;
        name += *escaped;
    }
    return std::nullopt;
}

std::optional<std::string> read_name(std::string_view path, std::size_t& at) {
    if (at < path.size() && path[at] == '"') return read_quoted(path, ++at);
    const std::size_t start = at;
    while (at < path.size() && (is_bare_character(path[at]) || path[at] == '*')) ++at;
    if (at == start) return std::nullopt;
    return std::string(path.substr(start, at - start));
}

}  // namespace

bool is_bare_key(std::string_view name) {
    return !name.empty() && std::ranges::all_of(name, is_bare_character);
}

std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += is_control(c) ? escape_control(c) : std::string(1, c);
    }
    return result + '"';
}

std::string key_to_string(std::string_view name) {
    return is_bare_key(name) ? std::string(name) : toml_string(name);
}

std::string join_path(std::string_view path, std::string_view name) {
    return path.empty() ? key_to_string(name) : std::string(path) + '.' + key_to_string(name);
}

std::optional<std::vector<std::string>> split_path(std::string_view path) {
    std::vector<std::string> names;
    std::size_t at = 0;
    while (true) {
        const std::optional<std::string> name = read_name(path, at);
        if (!name) return std::nullopt;
        names.push_back(*name);
        if (at == path.size()) return names;
        if (path[at++] != '.') return std::nullopt;
    }
}

// Name by name, since most paths differ in their first one.
bool path_matches(std::string_view path, std::string_view pattern) {
    std::size_t at = 0;
    std::size_t wanted_at = 0;
    while (true) {
        const std::optional<std::string> name = read_name(path, at);
        const std::optional<std::string> wanted = read_name(pattern, wanted_at);
        if (!name || !wanted || (*wanted != "*" && *wanted != *name)) return false;
        if (at == path.size() || wanted_at == pattern.size()) {
            return at == path.size() && wanted_at == pattern.size();
        }
        if (path[at++] != '.' || pattern[wanted_at++] != '.') return false;
    }
}

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t valid =
            std::min(find_invalid_utf8(text).value_or(text.size()), text.size());
        for (std::size_t i = 0; i < valid; ++i) {
            const bool is_c1 = i + 1 < valid && text[i] == '\xc2' &&
                               static_cast<unsigned char>(text[i + 1]) < 0xa0;
            if (turns_direction(text.substr(i, valid - i))) {
                result += escape_direction(text.substr(i));
                i += 2;
            } else if (is_control(text[i]) || is_c1) {
                result += escape_control(text[is_c1 ? ++i : i]);
            } else {
                result += text[i];
            }
        }
        if (valid < text.size()) result += "\\x" + hexadecimal(text[valid]);
        text.remove_prefix(std::min(valid + 1, text.size()));
    }
    return result;
}

std::string shorten(std::string_view text) {
    constexpr std::size_t longest = 60;
    if (text.size() <= longest) return printable(text);
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    return printable(text.substr(0, end)) + "...";
}

}  // namespace skybake::config
