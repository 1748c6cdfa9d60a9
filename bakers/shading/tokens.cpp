#include "bakers/shading/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace skybake {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::size_t end_of_blanks(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        if (text.substr(at, 2) == "//") {
            at = std::min(text.find('\n', at), text.size());
        } else if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
            ++at;
        } else {
            break;
        }
    }
    return at;
}

// 6360.0, 7, 1e-20, 1.0e-05
std::size_t end_of_number(std::string_view text, std::size_t at) {
    const auto digits = [&] {
        while (at < text.size() && is_digit(text[at])) ++at;
    };
    digits();
    if (at < text.size() && text[at] == '.') {
        ++at;
        digits();
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
        digits();
    }
    return at;
}

std::size_t end_of_mark(std::string_view text, std::size_t at) {
    static constexpr std::array<std::string_view, 10> kPairs = {"==", "!=", "<=", ">=", "&&",
                                                                "||", "+=", "-=", "*=", "/="};
    const bool is_pair = std::ranges::find(kPairs, text.substr(at, 2)) != kPairs.end();
    return at + (is_pair ? 2 : 1);
}

}  // namespace

std::vector<Token> tokens_of(std::string_view glsl) {
    std::vector<Token> tokens;
    std::size_t at = 0;
    int line = 1;
    while (tokens.empty() || tokens.back().kind != TokenKind::end) {
        const std::size_t begin = end_of_blanks(glsl, at);
        const std::string_view before = glsl.substr(at, begin - at);
        line += static_cast<int>(std::ranges::count(before, '\n'));
        TokenKind kind = TokenKind::end;
        at = begin;
        if (begin < glsl.size() && is_letter(glsl[begin])) {
            kind = TokenKind::word;
            while (at < glsl.size() && (is_letter(glsl[at]) || is_digit(glsl[at]))) ++at;
        } else if (begin < glsl.size() && is_digit(glsl[begin])) {
            kind = TokenKind::number;
            at = end_of_number(glsl, begin);
        } else if (begin < glsl.size()) {
            kind = TokenKind::mark;
            at = end_of_mark(glsl, begin);
        }
        tokens.push_back({kind, before, glsl.substr(begin, at - begin), line});
    }
    return tokens;
}

}  // namespace skybake
