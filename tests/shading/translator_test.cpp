// Translations of GLSL, line by line. That they compile and that they return the same numbers is shown in
// tests/lookups and tests/browser.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/shading/dialect.h"
#include "bakers/shading/shading_language.h"

namespace skybake {
namespace {

using Language = ShadingLanguage;

constexpr std::array<const char*, 15> kLibraries = {"aerial_perspective.glsl",
                                                    "blue_noise.glsl",
                                                    "bruneton.glsl",
                                                    "clouds.glsl",
                                                    "columns.glsl",
                                                    "environment.glsl",
                                                    "film.glsl",
                                                    "irradiance.glsl",
                                                    "moments.glsl",
                                                    "multiple_scattering.glsl",
                                                    "noise.glsl",
                                                    "phase.glsl",
                                                    "sky_view.glsl",
                                                    "transmittance.glsl",
                                                    "weather_map.glsl"};

// Without what stands before the functions.
std::string body(std::string_view glsl, Language to) {
    std::string text = translated(glsl, to);
    for (const char* end : {"#endif\n\n", "using namespace metal;\n\n"}) {
        const std::size_t at = text.find(end);
        if (at != std::string::npos) text.erase(0, at + std::string_view(end).size());
    }
    return text;
}

void expect(std::string_view glsl, Language to, std::string_view expected) {
    EXPECT_EQ(body(glsl, to), expected);
}

std::string refusal(std::string_view glsl) {
    try {
        return "accepted: " + translated(glsl, Language::hlsl);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

TEST(Translation, OfGlslToGlslIsTheSame) {
    for (const char* library : kLibraries) {
        EXPECT_EQ(translated(published_lookup(library), Language::glsl), published_lookup(library));
    }
}

TEST(Translation, KeepsCommentsAndLines) {
    const auto comments_of = [](const std::string& text) {
        std::istringstream lines(text);
        std::vector<std::string> comments;
        for (std::string line; std::getline(lines, line);) {
            const std::size_t at = line.find("//");
            if (at != std::string::npos) comments.push_back(line.substr(at));
        }
        return comments;
    };
    for (const char* library : kLibraries) {
        const std::string glsl(published_lookup(library));
        for (const ShadingLanguageName& one : shading_languages) {
            const std::string text = body(glsl, one.language);
            EXPECT_EQ(comments_of(text), comments_of(glsl)) << library << ", " << one.word;
            if (one.language == Language::wgsl) continue;  // a declaration has a line of its own
            EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
                      std::count(glsl.begin(), glsl.end(), '\n'))
                << library << ", " << one.word;
        }
    }
}

TEST(Translation, TakesTheLayerOfAnArrayApartWhereALanguageWantsThat) {
    constexpr auto kGlsl = "vec4 layer(sampler2DArray t, vec3 p) { return texture(t, p); }\n";
    expect(kGlsl, Language::hlsl,
           "float4 layer(Texture2DArray t, SamplerState t_sampler, float3 p) { return "
           "t.SampleLevel(t_sampler, p, 0.0); }\n");
    expect(kGlsl, Language::msl,
           "inline float4 layer(texture2d_array<float> t, sampler t_sampler, float3 p) { return "
           "t.sample(t_sampler, float2(p.x, p.y), uint(p.z), metal::level(0.0)); }\n");
    expect(kGlsl, Language::wgsl,
           "fn layer(t: texture_2d_array<f32>, t_sampler: sampler, p: vec3f) -> vec4f { return "
           "textureSampleLevel(t, t_sampler, p.xy, i32(p.z), 0.0); }\n");
}

TEST(Translation, PassesASamplerWhereATextureIsSampled) {
    constexpr const char* kGlsl =
        "vec4 inner(sampler3D t, vec3 p) { return texture(t, p); }\n"
        "float outer(sampler3D a, sampler3D b, vec3 p) {\n"
        "    return inner(a, p).r + texelFetch(b, ivec3(p), 0).r;\n"
        "}\n";
    expect(kGlsl, Language::hlsl,
           "float4 inner(Texture3D t, SamplerState t_sampler, float3 p) { return "
           "t.SampleLevel(t_sampler, p, 0.0); }\n"
           "float outer(Texture3D a, SamplerState a_sampler, Texture3D b, float3 p) {\n"
           "    return inner(a, a_sampler, p).r + b.Load(int4((int3)(p), 0)).r;\n"
           "}\n");
    expect(
        kGlsl, Language::msl,
        "inline float4 inner(texture3d<float> t, sampler t_sampler, float3 p) { return "
        "t.sample(t_sampler, p, metal::level(0.0)); }\n"
        "inline float outer(texture3d<float> a, sampler a_sampler, texture3d<float> b, float3 p) "
        "{\n"
        "    return inner(a, a_sampler, p).r + b.read(uint3(int3(p)), 0).r;\n"
        "}\n");
    expect(kGlsl, Language::wgsl,
           "fn inner(t: texture_3d<f32>, t_sampler: sampler, p: vec3f) -> vec4f { return "
           "textureSampleLevel(t, t_sampler, p, 0.0); }\n"
           "fn outer(a: texture_3d<f32>, a_sampler: sampler, b: texture_3d<f32>, p: vec3f) -> f32 "
           "{\n"
           "    return inner(a, a_sampler, p).r + textureLoad(b, vec3i(p), 0).r;\n"
           "}\n");
    expect(kGlsl, Language::godot, kGlsl);
}

TEST(Translation, OfConstructors) {
    constexpr const char* kGlsl =
        "vec3 f(vec4 v, ivec2 i, float x) { return vec3(v) + vec3(x) + vec3(vec2(i), i.x); }\n";
    expect(kGlsl, Language::hlsl,
           "float3 f(float4 v, int2 i, float x) { return v.xyz + (float3)(x) + "
           "float3((float2)(i), float(i.x)); }\n");
    expect(kGlsl, Language::wgsl,
           "fn f(v: vec4f, i: vec2i, x: f32) -> vec3f { return v.xyz + vec3f(x) + "
           "vec3f(vec2f(i), f32(i.x)); }\n");
    // A cast binds less than a dot.
    expect("float f(ivec3 i) { return vec3(i).x; }\n", Language::hlsl,
           "float f(int3 i) { return ((float3)(i)).x; }\n");
    expect("vec3 f(vec4 a, vec4 b) { return vec3(a + b); }\n", Language::msl,
           "inline float3 f(float4 a, float4 b) { return (a + b).xyz; }\n");
}

TEST(Translation, OfFunctions) {
    constexpr const char* kGlsl =
        "vec2 f(vec2 a, float x) { return mix(clamp(a, 0.0, 1.0), a, atan(x, length(a))); }\n";
    expect(kGlsl, Language::hlsl,
           "float2 f(float2 a, float x) { return lerp(clamp(a, (float2)(0.0), (float2)(1.0)), a, "
           "(float2)(atan2(x, length(a)))); }\n");
    expect(kGlsl, Language::wgsl,
           "fn f(a: vec2f, x: f32) -> vec2f { return mix(clamp(a, vec2f(0.0), vec2f(1.0)), a, "
           "vec2f(atan2(x, length(a)))); }\n");
}

TEST(Translation, OfChoicesAndBranchesToWgsl) {
    expect("float f(float x) { return x < 0.0 ? -x : x > 1.0 ? 1.0 : x; }\n", Language::wgsl,
           "fn f(x: f32) -> f32 { return select(select(x, 1.0, x > 1.0), -x, x < 0.0); }\n");
    expect(
        "float f(float x) {\n    if (x < 0.0) return 0.0;\n    else if (x > 2.0) x = 2.0;\n"
        "    while (x > 1.0) x -= 1.0;\n    return x;\n}\n",
        Language::wgsl,
        "fn f(x_given: f32) -> f32 { var x = x_given;\n    if (x < 0.0) { return 0.0; }\n"
        "    else if (x > 2.0) { x = 2.0; }\n    while (x > 1.0) { x -= 1.0; }\n    return "
        "x;\n}\n");
}

TEST(Translation, OfDeclarations) {
    constexpr const char* kGlsl =
        "float f(float from) {\n    const float PI = 3.0;\n    float a = from * 1e-7, b;\n"
        "    b = a * PI;\n    return b;\n}\n";
    expect(kGlsl, Language::wgsl,
           "fn f(from_: f32) -> f32 {\n    let PI: f32 = 3.0;\n    var a: f32 = from_ * 1.0e-7;\n"
           "    var b: f32;\n    b = a * PI;\n    return b;\n}\n");
    expect(kGlsl, Language::godot,
           "float f(float from) {\n    const float PI_ = 3.0;\n    float a = from * 1.0e-7, b;\n"
           "    b = a * PI_;\n    return b;\n}\n");
    expect("struct Shell {\n    float R;  // km\n};\nfloat f(Shell s) { return s.R; }\n",
           Language::wgsl,
           "struct Shell {\n    R: f32,  // km\n}\nfn f(s: Shell) -> f32 { return s.R; }\n");
}

// The translator refuses what it does not know, with the line.
TEST(Translation, RefusesTheRestOfGlsl) {
    const std::vector<std::pair<const char*, const char*>> cases = {
        {"float f(float x) {\n    return fract(x);\n}", "line 2 of GLSL: the function `fract`"},
        {"float f(inout float x) { return x; }", "line 1 of GLSL: the type `inout`"},
        {"void f() {}", "line 1 of GLSL: the type `void`"},
        {"float f(float x) { return x; }\nfloat f(vec2 x) { return x.x; }", "line 2"},
        {"float f(float x) { for (;;) x = 1.0; return x; }", "line 1 of GLSL: `;` is unknown"},
        {"float f(float x) { return x + 1; }", "`float` + `int`"},
        {"float f(float x) { return y; }", "`y` is unknown"},
        {"vec3 f(vec2 x) { return vec3(x); }", "2 components in `vec3`"},
        {"vec3 f(vec2 x) { return x.xyx.a.b; }", "`b` of `float`"},
        {"float f(float x) { return x;", "it ends here"},
        {"float f(sampler2D t) { return texelFetch(t, ivec2(0, 0), 0).r; }",
         "the function `texelFetch`"},
        {"float f(float x) { float y = ivec2(1, 2); return x; }", "`ivec2` as `float`"},
        {"float g(int x) { return 1.0; }\nfloat f(float x) { return g(x); }", "`float` for `x`"},
    };
    for (const auto& [glsl, expected] : cases) {
        EXPECT_NE(refusal(glsl).find(expected), std::string::npos) << glsl << "\n" << refusal(glsl);
    }
}

// Words that the languages keep for themselves and that a name in GLSL may be: of the specifications of
// WGSL (15.2) and of Metal's language (C++14's keywords and 2), of HLSL's appendix of keywords, and of
// Godot's shading language with its constants.
const std::map<Language, const char*> kReservedWords = {
    {Language::hlsl,
     "AppendStructuredBuffer asm asm_fragment auto BlendState Buffer ByteAddressBuffer "
     "case "
     "catch cbuffer centroid char class column_major compile compile_fragment "
     "CompileShader const_cast ConsumeStructuredBuffer default delete DepthStencilState "
     "DepthStencilView double dword dynamic_cast enum explicit export extern "
     "float1 friend fxgroup GeometryShader goto groupshared half Hullshader inline "
     "InputPatch interface line lineadj linear LineStream long matrix mutable namespace "
     "new nointerpolation noperspective NULL operator OutputPatch packoffset pass "
     "pixelfragment PixelShader point PointStream precise private protected public "
     "RasterizerState register reinterpret_cast row_major sample sampler SamplerState "
     "shared short signed sizeof snorm stateblock static static_cast string "
     "StructuredBuffer switch tbuffer technique template texture this throw "
     "triangle triangleadj TriangleStream try typedef typename uint uniform union unorm "
     "unsigned using vector vertexfragment VertexShader virtual void volatile size_of"},
    {Language::msl,
     "alignas alignof and asm auto bitand bitor case catch char class compl constant "
     "constexpr const_cast decltype default delete device double dynamic_cast enum "
     "explicit export extern fragment friend goto half inline kernel long mutable "
     "namespace new noexcept not nullptr operator or private protected public register "
     "reinterpret_cast short signed sizeof static static_assert static_cast switch "
     "template this thread threadgroup throw try typedef typeid typename uint union "
     "unsigned using vertex virtual void volatile wchar_t xor"},
    {Language::wgsl,
     "NULL Self abstract active alias alignas alignof as asm asm_fragment async "
     "attribute "
     "auto await become break case cast catch class co_await co_return co_yield "
     "coherent column_major common compile compile_fragment concept const const_assert "
     "const_cast consteval constexpr constinit continue continuing crate debugger "
     "decltype default delete demote demote_to_helper diagnostic discard do "
     "dynamic_cast enable enum explicit export extends extern external fallthrough "
     "filter final finally fn for friend from fxgroup get goto groupshared highp impl "
     "implements import inline instanceof interface layout let loop lowp macro "
     "macro_rules match mediump meta mod module move mut mutable namespace new nil "
     "noexcept noinline nointerpolation non_coherent noncoherent noperspective null "
     "nullptr of operator override package packoffset partial pass patch "
     "pixelfragment precise precision premerge priv protected pub public readonly ref "
     "regardless register reinterpret_cast require requires resource restrict self set "
     "shared sizeof smooth snorm static static_assert static_cast std subroutine super "
     "switch target template this thread_local throw trait try type typedef typeid "
     "typename typeof union unless unorm unsafe unsized use using var varying virtual "
     "volatile wgsl where with writeonly yield"},
    {Language::godot,
     "PI TAU E TIME CLIP_SPACE_FAR OUTPUT_IS_SRGB break case continue default discard "
     "do flat for "
     "global group_uniforms hint_range highp in inout instance instance_uniform lowp "
     "mediump out render_mode shader_type smooth source_color stencil_mode switch uint "
     "uniform varying void mat2 mat3 mat4 uvec2 bvec2"},
    {Language::glsl, ""}};

std::set<std::string> reserved_words(Language language) {
    std::istringstream words(kReservedWords.at(language));
    return {std::istream_iterator<std::string>(words), {}};
}

TEST(Translation, UsesNoReservedWordAsAName) {
    std::set<std::string> names;  // what stands after a type or a comma and is no type
    for (const char* library : kLibraries) {
        const std::vector<Token> tokens = tokens_of(published_lookup(library));
        for (std::size_t i = 1; i < tokens.size(); ++i) {
            const bool is_word = tokens[i].kind == TokenKind::word;
            const std::string_view before = tokens[i - 1].text;
            const bool is_after_type = before == "," || before == "ColumnShell" ||
                                       !translated_type(before, Language::glsl).empty();
            if (is_word && is_after_type &&
                translated_type(tokens[i].text, Language::glsl).empty()) {
                names.insert(std::string(tokens[i].text));
            }
        }
    }
    for (const char* function : {"abs", "clamp", "texture", "sqrt"})
        names.erase(function);  // called
    EXPECT_GT(names.size(), 150u);
    for (const ShadingLanguageName& one : shading_languages) {
        const std::set<std::string> reserved = reserved_words(one.language);
        for (const std::string& name : names) {
            EXPECT_FALSE(reserved.contains(allowed_name(name, one.language)))
                << name << " in " << one.word;
        }
    }
}

}  // namespace
}  // namespace skybake
