// How the shading languages spell the types and functions of GLSL that lookups use.
//
// The words, numbers and marks of a text of GLSL.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/shading/shading_language.h"

namespace skybake {

// Returns the name of a type of GLSL, such as "vec3" or "sampler3D"; empty if it is none.
std::string_view translated_type(std::string_view type, ShadingLanguage language);

// Types are numbers or vectors of them: "vec3" has 3 components of "float".
int components_of(std::string_view type);
std::string_view scalar_of(std::string_view type);
std::string vector_of(std::string_view scalar, int components);

enum class FunctionResult {
    none,
    vector,
    scalar
};  // of as many components as its arguments, or of one

struct DialectFunction {
    std::string_view word;                         // its name in that language
    FunctionResult result = FunctionResult::none;  // `none` of a function that is not in the table
};
DialectFunction translated_function(std::string_view name, ShadingLanguage language);

struct TextureFunction {
    // With {0} for the texture, {1} for its sampler, {2} and {3} for the other arguments.
    std::string_view form;
    std::string_view result;
};
// How the language looks up such a texture; `form` is empty for other types.
TextureFunction translated_texture_function(std::string_view name, std::string_view type,
                                            ShadingLanguage language);

// A name that is not reserved in the language.
std::string allowed_name(std::string_view name, ShadingLanguage language);

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
