// GLSL written in other shading languages.
//
// It knows the GLSL of examples/lookups and of what bakers add to it: functions and structs of float,
// int, bool and their vectors, textures as arguments, declarations, assignments, if, while and return,
// and a few of GLSL's functions (dialect.h). It refuses all else, as it would have no test.
//
//   texture     a texture and its sampler are one argument in GLSL and in Godot. In the others the
//               sampler follows its texture as NAME_sampler, where the function samples at all
//   level       textures are read at level 0 (but for GLSL and Godot, where a fragment shader chooses
//               the level), so that functions may stand in any stage and in any branch
//   select      WGSL has no ?:, so that both sides are computed there
//   names       words that a language keeps for itself get a `_` at their end
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace skybake {

enum class ShadingLanguage { glsl, hlsl, msl, wgsl, godot };

struct ShadingLanguageName {
    std::string_view word;  // what commands call it
    ShadingLanguage language;
    std::string_view name;  // what its users call it
};
inline constexpr std::array<ShadingLanguageName, 5> shading_languages = {
    {{"glsl", ShadingLanguage::glsl, "GLSL"},
     {"hlsl", ShadingLanguage::hlsl, "HLSL"},
     {"msl", ShadingLanguage::msl, "Metal's language"},
     {"wgsl", ShadingLanguage::wgsl, "WGSL"},
     {"godot", ShadingLanguage::godot, "Godot's language"}}};

constexpr const ShadingLanguageName& row_of(ShadingLanguage language) {
    return shading_languages[static_cast<std::size_t>(language)];
}

// The same functions, with comments and line breaks as in GLSL. Throws std::invalid_argument, which
// names the line, where the text holds what the list above does not.
std::string translated(std::string_view glsl, ShadingLanguage to);

}  // namespace skybake
