#include "bakers/shading/dialect.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace skybake {

namespace {

constexpr std::size_t kLanguages = shading_languages.size();

// A type's names in all languages, in the order of ShadingLanguage.
struct TypeRow {
    std::array<std::string_view, kLanguages> words;
    std::string_view scalar;
    int components;  // 0 of textures
};
constexpr std::array<TypeRow, 11> kTypes = {{
    {{"float", "float", "float", "f32", "float"}, "float", 1},
    {{"vec2", "float2", "float2", "vec2f", "vec2"}, "float", 2},
    {{"vec3", "float3", "float3", "vec3f", "vec3"}, "float", 3},
    {{"vec4", "float4", "float4", "vec4f", "vec4"}, "float", 4},
    {{"int", "int", "int", "i32", "int"}, "int", 1},
    {{"ivec2", "int2", "int2", "vec2i", "ivec2"}, "int", 2},
    {{"ivec3", "int3", "int3", "vec3i", "ivec3"}, "int", 3},
    {{"bool", "bool", "bool", "bool", "bool"}, "bool", 1},
    {{"sampler2D", "Texture2D", "texture2d<float>", "texture_2d<f32>", "sampler2D"}, "", 0},
    {{"sampler2DArray", "Texture2DArray", "texture2d_array<float>", "texture_2d_array<f32>",
      "sampler2DArray"},
     "",
     0},
    {{"sampler3D", "Texture3D", "texture3d<float>", "texture_3d<f32>", "sampler3D"}, "", 0},
}};

struct FunctionRow {
    std::array<std::string_view, kLanguages> words;
    FunctionResult result;
};
constexpr FunctionRow same(std::string_view name, FunctionResult result = FunctionResult::vector) {
    return {{name, name, name, name, name}, result};
}
constexpr std::array<FunctionRow, 15> kFunctions = {{
    same("abs"),
    {{"atan", "atan2", "atan2", "atan2", "atan"}, FunctionResult::vector},  // of two arguments
    same("clamp"),
    same("cross"),
    same("dot", FunctionResult::scalar),
    same("exp"),
    same("floor"),
    same("length", FunctionResult::scalar),
    same("log"),
    same("max"),
    same("min"),
    {{"mix", "lerp", "mix", "mix", "mix"}, FunctionResult::vector},
    same("pow"),
    same("sign"),
    same("sqrt"),
}};

struct TextureRow {
    std::string_view name, type, result;
    std::array<std::string_view, kLanguages> forms;
};
constexpr std::string_view kSampleCall = "texture({0}, {2})";
constexpr std::array<std::string_view, kLanguages> kSampleForms = {
    kSampleCall, "{0}.SampleLevel({1}, {2}, 0.0)", "{0}.sample({1}, {2}, metal::level(0.0))",
    "textureSampleLevel({0}, {1}, {2}, 0.0)", kSampleCall};
constexpr std::array<TextureRow, 4> kTextureFunctions = {{
    {"texture", "sampler2D", "vec4", kSampleForms},
    {"texture", "sampler3D", "vec4", kSampleForms},
    {"texture",
     "sampler2DArray",
     "vec4",
     {kSampleCall, "{0}.SampleLevel({1}, {2}, 0.0)",
      "{0}.sample({1}, float2({2}.x, {2}.y), uint({2}.z), metal::level(0.0))",
      "textureSampleLevel({0}, {1}, {2}.xy, i32({2}.z), 0.0)", kSampleCall}},
    {"texelFetch",
     "sampler3D",
     "vec4",
     {"texelFetch({0}, {2}, {3})", "{0}.Load(int4({2}, {3}))", "{0}.read(uint3({2}), {3})",
      "textureLoad({0}, {2}, {3})", "texelFetch({0}, {2}, {3})"}},
}};

// Names in lookups that a language keeps for itself: WGSL's reserved words, Godot's constants.
struct ReservedWord {
    std::string_view word;
    ShadingLanguage language;
};
constexpr std::array<ReservedWord, 2> kReserved = {
    {{"from", ShadingLanguage::wgsl}, {"PI", ShadingLanguage::godot}}};

const TypeRow* type_row(std::string_view type) {
    const auto* const row =
        std::ranges::find_if(kTypes, [&](const TypeRow& one) { return one.words[0] == type; });
    return row != kTypes.end() ? row : nullptr;
}

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

std::string_view translated_type(std::string_view type, ShadingLanguage language) {
    const TypeRow* const row = type_row(type);
    return row != nullptr ? row->words[static_cast<std::size_t>(language)] : std::string_view{};
}

int components_of(std::string_view type) {
    const TypeRow* const row = type_row(type);
    return row != nullptr ? row->components : 0;
}

std::string_view scalar_of(std::string_view type) {
    const TypeRow* const row = type_row(type);
    return row != nullptr ? row->scalar : std::string_view{};
}

std::string vector_of(std::string_view scalar, int components) {
    if (components == 1) return std::string(scalar);
    return (scalar == "int" ? "ivec" : "vec") + std::to_string(components);
}

DialectFunction translated_function(std::string_view name, ShadingLanguage language) {
    const auto* const row = std::ranges::find_if(
        kFunctions, [&](const FunctionRow& one) { return one.words[0] == name; });
    if (row == kFunctions.end()) return {};
    return {row->words[static_cast<std::size_t>(language)], row->result};
}

TextureFunction translated_texture_function(std::string_view name, std::string_view type,
                                            ShadingLanguage language) {
    const auto* const row = std::ranges::find_if(kTextureFunctions, [&](const TextureRow& one) {
        return one.name == name && one.type == type;
    });
    if (row == kTextureFunctions.end()) return {};
    return {row->forms[static_cast<std::size_t>(language)], row->result};
}

std::string allowed_name(std::string_view name, ShadingLanguage language) {
    const bool is_reserved = std::ranges::any_of(kReserved, [&](const ReservedWord& one) {
        return one.word == name && one.language == language;
    });
    return std::string(name) + (is_reserved ? "_" : "");
}

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
