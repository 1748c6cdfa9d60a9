#include "bakers/io/formats/exr/attribute_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace skybake {
namespace {

constexpr std::string_view own_names = "skybake/";

// Whether a byte is the second or a later one of a character of UTF-8.
bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// Returns how many of the first bytes of a text make its next piece. If the bytes are not UTF-8, so
// that a character seems to have more than four bytes, the piece has the greatest allowed length.
std::size_t piece_length(std::string_view text) {
    constexpr std::size_t most = longest_attribute - 1;
    constexpr std::size_t longest_character = 4;
    if (text.size() <= most) return text.size();
    std::size_t length = most;
    while (length > most - longest_character && continues_character(text[length])) --length;
    return continues_character(text[length]) ? most : length;
}

struct PieceName {
    std::string whole;  // the name of the whole text
    std::size_t index = 0;
};

// Parses a name such as "skybake/parameters.12". Returns nothing for a name that split_attributes
// does not make.
std::optional<PieceName> piece_name(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || name.substr(0, own_names.size()) != own_names) return {};
    const std::string_view digits = name.substr(dot + 1);
    PieceName piece{std::string(name.substr(0, dot)), 0};
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, piece.index);
    if (read.ec != std::errc{} || read.ptr != end) return {};
    if (std::to_string(piece.index) != digits) return {};  // "01"
    return piece;
}

using Pieces = std::map<std::size_t, std::string>;  // by index

// Whether the pieces are numbered from 0 on without a gap.
bool are_complete(const Pieces& pieces) { return pieces.rbegin()->first + 1 == pieces.size(); }

bool has_attribute(const Attributes& attributes, const std::string& name) {
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const auto& attribute) { return attribute.first == name; });
}

void append_joined(const std::string& name, const Pieces& pieces, Attributes& attributes) {
    std::string& whole = attributes.emplace_back(name, "").second;
    for (const auto& [index, text] : pieces) whole += text;
}

void append_as_they_are(const std::string& name, const Pieces& pieces, Attributes& attributes) {
    for (const auto& [index, text] : pieces) {
        attributes.emplace_back(fmt::format("{}.{}", name, index), text);
    }
}

}  // namespace

Attributes split_attributes(const Attributes& attributes) {
    Attributes result;
    for (const auto& [name, text] : attributes) {
        if (text.size() < longest_attribute) {
            result.emplace_back(name, text);
            continue;
        }
        std::string_view rest = text;
        for (std::size_t i = 0; !rest.empty(); ++i) {
            const std::size_t length = piece_length(rest);
            result.emplace_back(fmt::format("{}.{}", name, i), rest.substr(0, length));
            rest.remove_prefix(length);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

Attributes joined_attributes(const Attributes& attributes) {
    Attributes result;
    std::map<std::string, Pieces> split;
    for (const auto& [name, text] : attributes) {
        if (auto piece = piece_name(name)) {
            split[piece->whole][piece->index] = text;
        } else {
            result.emplace_back(name, text);
        }
    }
    for (const auto& [name, pieces] : split) {
        if (are_complete(pieces) && !has_attribute(attributes, name)) {
            append_joined(name, pieces, result);
        } else {
            append_as_they_are(name, pieces, result);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace skybake
