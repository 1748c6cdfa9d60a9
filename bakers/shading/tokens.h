// The words, numbers and marks of a text of GLSL.
#pragma once

#include <string_view>
#include <vector>

namespace skybake {

enum class TokenKind { word, number, mark, end };

// Views into the text. `before` holds the blanks and comments between the previous token and this one.
struct Token {
    TokenKind kind;
    std::string_view before;
    std::string_view text;
    int line;  // from 1 on
};

// The last token is the end of the text, with what stands before it.
std::vector<Token> tokens_of(std::string_view glsl);

}  // namespace skybake
