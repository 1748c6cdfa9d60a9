// A parser of GLSL that writes what it reads: each rule returns the text of its part in the other
// language and, for expressions, its type. Blanks and comments stay before the token that they stood
// before. No sum of texts reads two tokens, as C++ says nothing of the order.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "bakers/shading/dialect.h"
#include "bakers/shading/shading_language.h"
#include "bakers/shading/tokens.h"

namespace skybake {
namespace {

using Language = ShadingLanguage;

// An expression. It binds tightly if a `.` after it is about all of it.
struct Value {
    std::string before;
    std::string text;
    std::string type;
    bool binds_tightly = true;

    std::string whole() const { return before + text; }
    std::string tight() const { return binds_tightly ? text : "(" + text + ")"; }
};

struct Parameter {
    std::string before, type, before_name, name;
    bool is_sampled = false;  // its function samples this texture
    bool is_assigned = false;
};

struct Function {
    std::string result;
    std::vector<Parameter> parameters;
};

class Translator {
  public:
    Translator(std::string_view glsl, Language to) : to_(to), tokens_(tokens_of(glsl)) {}

    std::string text() {
        std::string text;
        while (next().kind != TokenKind::end) {
            text += next().text == "struct" ? structure() : function();
        }
        return prelude() + text + std::string(next().before);
    }

  private:
    // --- Tokens ---------------------------------------------------------------------------------

    const Token& next() const { return tokens_[at_]; }
    bool next_is(std::string_view text) const { return next().text == text; }
    const Token& take() { return tokens_[at_++]; }
    const Token& take(std::string_view text) {
        if (!next_is(text)) refuse(fmt::format("`{}` instead of `{}`", next().text, text));
        return take();
    }
    const Token& take_word() {
        if (next().kind != TokenKind::word) refuse(fmt::format("`{}`, no name", next().text));
        return take();
    }
    static std::string as_it_is(const Token& token) {
        return std::string(token.before) + std::string(token.text);
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::invalid_argument(fmt::format("line {} of GLSL: {}", next().line, what));
    }

    // --- Names ----------------------------------------------------------------------------------

    bool is_type(std::string_view word) const {
        return !spelt_type(word, to_).empty() || structures_.contains(std::string(word));
    }
    std::string spelt(std::string_view type) const {
        const std::string_view word = spelt_type(type, to_);
        return std::string(word.empty() ? type : word);
    }
    std::string named(std::string_view name) const { return allowed_name(name, to_); }
    bool has_samplers_apart() const { return to_ != Language::glsl && to_ != Language::godot; }
    static std::string sampler_of(const std::string& texture) { return texture + "_sampler"; }

    Parameter* parameter_named(std::string_view name) {
        const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                        [&](const Parameter& one) { return one.name == name; });
        return found != parameters_.end() ? &*found : nullptr;
    }
    void note_that_it_is_sampled(const std::string& texture) {
        Parameter* const parameter = parameter_named(texture);
        if (parameter == nullptr) refuse(fmt::format("`{}` is no argument", texture));
        parameter->is_sampled = true;
    }

    // --- Expressions ----------------------------------------------------------------------------

    Value expression() {
        Value condition = operation(0);
        if (!next_is("?")) return condition;
        const Token& question = take();
        Value yes = expression();
        const Token& colon = take(":");
        const Value no = expression();
        if (yes.type != no.type) refuse(fmt::format("`{}` or `{}`", yes.type, no.type));
        if (to_ == Language::wgsl) {
            return {condition.before,
                    fmt::format("select({}, {}, {})", no.text, yes.text, condition.text), yes.type};
        }
        return {condition.before,
                condition.text + as_it_is(question) + yes.whole() + as_it_is(colon) + no.whole(),
                yes.type, false};
    }

    // Operators of two sides, those that bind least first.
    Value operation(std::size_t rank) {
        static const std::vector<std::vector<std::string_view>> kRanks = {
            {"||"}, {"&&"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"+", "-"}, {"*", "/"}};
        if (rank == kRanks.size()) return signed_value();
        Value left = operation(rank + 1);
        const auto& marks = kRanks[rank];
        while (std::find(marks.begin(), marks.end(), next().text) != marks.end()) {
            const Token& mark = take();
            const Value right = operation(rank + 1);
            if (scalar_of(left.type) != scalar_of(right.type)) {
                refuse(fmt::format("`{}` {} `{}`", left.type, mark.text, right.type));
            }
            left.text += as_it_is(mark) + right.whole();
            left.binds_tightly = false;
            if (rank < 4) {
                left.type = "bool";
            } else if (components_of(left.type) == 1) {
                left.type = right.type;
            }
        }
        return left;
    }

    Value signed_value() {
        if (!next_is("-") && !next_is("!")) return postfix();
        const Token& mark = take();
        Value value = signed_value();
        value.text = std::string(mark.text) + value.whole();
        value.before = mark.before;
        value.binds_tightly = false;
        return value;
    }

    Value postfix() {
        Value value = primary();
        while (next_is(".")) {
            take();
            const std::string member(take_word().text);
            value.text = value.tight() + "." + member;
            value.binds_tightly = true;
            const auto structure = structures_.find(value.type);
            value.type = structure != structures_.end()
                             ? structure->second.at(member)
                             : vector_of(scalar_of(value.type), static_cast<int>(member.size()));
        }
        return value;
    }

    Value primary() {
        const Token& token = take();
        Value value = {std::string(token.before), std::string(token.text), ""};
        if (token.kind == TokenKind::number) {
            const bool has_point = token.text.find('.') != std::string_view::npos;
            const std::size_t exponent = token.text.find('e');
            value.type = has_point || exponent != std::string_view::npos ? "float" : "int";
            // Godot wants a point in each number that is no integer.
            if (!has_point && value.type == "float") value.text.insert(exponent, ".0");
        } else if (token.text == "(") {
            const Value inner = expression();
            value.text = "(" + inner.whole() + as_it_is(take(")"));
            value.type = inner.type;
        } else if (token.text == "true" || token.text == "false") {
            value.type = "bool";
        } else if (next_is("(")) {
            return call(std::move(value));
        } else {
            const auto variable = variables_.find(value.text);
            if (variable == variables_.end()) refuse(fmt::format("`{}` is unknown", value.text));
            value.type = variable->second;
            value.text = named(value.text);
        }
        return value;
    }

    // --- Calls ----------------------------------------------------------------------------------

    // Of what stands in `callee.text`.
    Value call(Value callee) {
        std::vector<Value> arguments;
        take("(");
        while (!next_is(")")) {
            arguments.push_back(expression());
            if (!next_is(")")) take(",");
        }
        take(")");
        const std::string& name = callee.text;
        if (is_type(name)) return constructed(std::move(callee), std::move(arguments));
        if (name.starts_with("tex")) return texture_call(std::move(callee), arguments);
        const auto own = functions_.find(name);
        if (own != functions_.end()) return own_call(std::move(callee), own->second, arguments);
        return builtin_call(std::move(callee), std::move(arguments));
    }

    static std::string joined(std::span<const Value> arguments) {
        std::string text;
        for (const Value& one : arguments) text += (text.empty() ? "" : ",") + one.whole();
        return text;
    }

    // The value as one of another type with as many components, or a number as a vector.
    Value converted(const Value& value, const std::string& type) const {
        if (value.type == type) return value;
        const bool is_cast = to_ == Language::hlsl && components_of(type) > 1;
        const std::string word = is_cast ? "(" + spelt(type) + ")" : spelt(type);
        return {value.before, fmt::format("{}({})", word, value.text), type, !is_cast};
    }

    // float(i), vec3(1.0), vec3(cells), vec3(texel), vec4(rgb, 1.0)
    Value constructed(Value callee, std::vector<Value> arguments) const {
        const std::string type = callee.text;
        const std::string scalar(scalar_of(type));
        int count = 0;
        for (Value& one : arguments) {
            const int components = components_of(one.type);
            if (arguments.size() == 1 && components > components_of(type)) {
                constexpr std::string_view kNames = "xyzw";
                one.text = fmt::format("{}.{}", one.tight(), kNames.substr(0, components_of(type)));
                one.type = vector_of(scalar_of(one.type), components_of(type));
                one.binds_tightly = true;
            }
            one = converted(one, vector_of(scalar, components_of(one.type)));
            count += components_of(one.type);
        }
        const bool fits = count == components_of(type) || (arguments.size() == 1 && count == 1);
        if (!fits || count == 0) refuse(fmt::format("{} components in `{}`", count, type));
        if (arguments.size() > 1)
            return {callee.before, spelt(type) + "(" + joined(arguments) + ")", type};
        Value only = converted(arguments[0], type);
        only.before = callee.before;
        return only;
    }

    Value texture_call(Value callee, std::span<const Value> arguments) {
        if (arguments.size() < 2) refuse(fmt::format("`{}` of one argument", callee.text));
        const Value& table = arguments[0];
        const bool is_flat = table.type == "sampler2D";
        const std::string place = arguments[1].text;
        std::string type = "vec4";
        std::string_view forms[3];  // of HLSL, of Metal's language and of WGSL
        if (callee.text == "texture") {
            note_that_it_is_sampled(table.text);
            forms[0] = "{0}.SampleLevel({1}, {2}, 0.0)";
            forms[1] = "{0}.sample({1}, {2}, metal::level(0.0))";
            forms[2] = "textureSampleLevel({0}, {1}, {2}, 0.0)";
        } else if (callee.text == "texelFetch" && !is_flat && arguments.size() == 3) {
            forms[0] = "{0}.Load(int4({2}, {3}))";
            forms[1] = "{0}.read(uint3({2}), {3})";
            forms[2] = "textureLoad({0}, {2}, {3})";
        } else if (callee.text == "textureSize") {
            type = is_flat ? "ivec2" : "ivec3";
            uses_size_of_ = true;
            forms[0] = "size_of({0})";
            forms[1] = is_flat ? "int2({0}.get_width(), {0}.get_height())"
                               : "int3({0}.get_width(), {0}.get_height(), {0}.get_depth())";
            forms[2] = is_flat ? "vec2i(textureDimensions({0}, {2}))"
                               : "vec3i(textureDimensions({0}, {2}))";
        } else {
            refuse(fmt::format("`{}`", callee.text));
        }
        if (!has_samplers_apart())
            return {callee.before, callee.text + "(" + joined(arguments) + ")", type};
        const std::string level = arguments.size() == 3 ? arguments[2].text : "";
        const auto form = forms[static_cast<std::size_t>(to_) - 1];
        return {callee.before,
                fmt::format(fmt::runtime(form), table.text, sampler_of(table.text), place, level),
                type};
    }

    Value own_call(Value callee, const Function& function, std::span<const Value> arguments) {
        if (arguments.size() != function.parameters.size()) refuse("another number of arguments");
        std::string text;
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const Value& one = arguments[i];
            const Parameter& parameter = function.parameters[i];
            if (one.type != parameter.type)
                refuse(fmt::format("`{}` for `{}`", one.type, parameter.name));
            text += (i > 0 ? "," : "") + one.whole();
            if (!parameter.is_sampled) continue;
            note_that_it_is_sampled(one.text);
            if (has_samplers_apart()) text += ", " + sampler_of(one.text);
        }
        return {callee.before, named(callee.text) + "(" + text + ")", function.result};
    }

    // Numbers beside vectors become vectors: not every language has mix(vec3, vec3, float).
    Value builtin_call(Value callee, std::vector<Value> arguments) const {
        const DialectFunction function = spelt_function(callee.text, to_);
        if (function.result == FunctionResult::none || arguments.empty()) {
            refuse(fmt::format("the function `{}`", callee.text));
        }
        const auto widest = std::max_element(
            arguments.begin(), arguments.end(), [](const Value& a, const Value& b) {
                return components_of(a.type) < components_of(b.type);
            });
        const std::string type = widest->type;
        for (Value& one : arguments) {
            if (scalar_of(one.type) != scalar_of(type))
                refuse(fmt::format("`{}` of integers", callee.text));
            one = converted(one, type);
        }
        return {callee.before, fmt::format("{}({})", function.word, joined(arguments)),
                function.result == FunctionResult::scalar ? std::string(scalar_of(type)) : type};
    }

    // --- Statements -----------------------------------------------------------------------------

    std::string block() {
        std::string text = as_it_is(take("{"));
        while (!next_is("}")) text += statement();
        return text + as_it_is(take("}"));
    }

    std::string statement() {
        if (next_is("if") || next_is("while")) return branch();
        if (next_is("return")) {
            const Token& word = take();
            const Value value = expression();
            return as_it_is(word) + value.whole() + as_it_is(take(";"));
        }
        return next_is("const") || is_type(next().text) ? declaration() : assignment();
    }

    std::string branch() {
        const Token& word = take();
        std::string text = as_it_is(word);
        text += as_it_is(take("("));
        text += expression().whole();
        text += as_it_is(take(")"));
        text += body();
        if (word.text != "if" || !next_is("else")) return text;
        text += as_it_is(take());
        return text + (next_is("if") ? branch() : body());
    }

    // WGSL wants brackets about each.
    std::string body() {
        if (next_is("{")) return block();
        return to_ == Language::wgsl ? " {" + statement() + " }" : statement();
    }

    // float s = R * mu_s, root;
    std::string declaration() {
        const bool is_constant = next_is("const");
        const Token& first = take();
        const std::string type(is_constant ? take_word().text : first.text);
        const std::string keyword = is_constant ? "let" : "var";
        // In WGSL each variable has a statement of its own, in a line of its own if the first has.
        const std::size_t line = first.before.rfind('\n');
        const std::string between =
            line != std::string_view::npos ? std::string(first.before.substr(line)) : " ";
        std::string text(first.before);
        if (to_ != Language::wgsl) text += (is_constant ? "const " : "") + spelt(type);
        for (bool is_first = true; is_first || next_is(","); is_first = false) {
            if (!is_first)
                text += to_ == Language::wgsl ? (take(), ";" + between) : as_it_is(take());
            const Token& name = take_word();
            if (to_ == Language::wgsl) {
                text += fmt::format("{} {}: {}", keyword, named(name.text), spelt(type));
            } else {
                text += std::string(name.before) + named(name.text);
            }
            if (next_is("=")) {
                text += as_it_is(take());
                const Value value = expression();
                if (value.type != type) refuse(fmt::format("`{}` as `{}`", value.type, type));
                text += value.whole();
            }
            variables_[std::string(name.text)] = type;
        }
        return text + as_it_is(take(";"));
    }

    std::string assignment() {
        const std::string_view name = next().text;
        const Value target = postfix();
        const Token& mark = take();
        if (mark.text.back() != '=' || mark.text == "==") refuse(fmt::format("`{}`", mark.text));
        if (Parameter* const parameter = parameter_named(name)) parameter->is_assigned = true;
        const Value value = expression();
        return target.whole() + as_it_is(mark) + value.whole() + as_it_is(take(";"));
    }

    // --- Functions and structs ------------------------------------------------------------------

    std::string function() {
        const Token& result = take_word();
        const Token& name = take_word();
        if (!is_type(result.text)) refuse(fmt::format("the type `{}`", result.text));
        if (functions_.contains(std::string(name.text))) refuse("a second function of this name");
        take("(");
        parameters_.clear();
        variables_.clear();
        while (!next_is(")")) {
            const Token& type = take_word();
            const Token& own = take_word();
            if (!is_type(type.text)) refuse(fmt::format("the type `{}`", type.text));
            parameters_.push_back({std::string(type.before), std::string(type.text),
                                   std::string(own.before), std::string(own.text)});
            variables_[std::string(own.text)] = std::string(type.text);
            if (!next_is(")")) take(",");
        }
        take(")");
        // Only what stands in it says which textures it samples and which arguments it changes.
        std::string inside = block();
        const std::string head = function_head(std::string(result.text), named(name.text), inside);
        functions_[std::string(name.text)] = {std::string(result.text), parameters_};
        return std::string(result.before) + head + inside;
    }

    std::string function_head(const std::string& result, const std::string& name,
                              std::string& inside) const {
        std::string list;
        for (const Parameter& one : parameters_) {
            const std::string own = named(one.name);
            if (!list.empty()) list += ",";
            list += one.before;
            if (to_ != Language::wgsl) {
                list += spelt(one.type) + one.before_name + own;
            } else if (one.is_assigned) {
                list += fmt::format("{}_given: {}", own, spelt(one.type));
                inside.insert(inside.find('{') + 1, fmt::format(" var {0} = {0}_given;", own));
            } else {
                list += fmt::format("{}: {}", own, spelt(one.type));
            }
            if (one.is_sampled) list += sampler_argument(one.name);
        }
        if (to_ == Language::wgsl) return fmt::format("fn {}({}) -> {}", name, list, spelt(result));
        return fmt::format("{}{} {}({})", to_ == Language::msl ? "inline " : "", spelt(result),
                           name, list);
    }

    std::string sampler_argument(const std::string& texture) const {
        if (!has_samplers_apart()) return "";
        const std::string name = sampler_of(texture);
        if (to_ == Language::wgsl) return fmt::format(", {}: sampler", name);
        return fmt::format(", {} {}", to_ == Language::hlsl ? "SamplerState" : "sampler", name);
    }

    std::string structure() {
        std::string text = as_it_is(take("struct"));
        const Token& name = take_word();
        text += as_it_is(name) + as_it_is(take("{"));
        auto& members = structures_[std::string(name.text)];
        while (!next_is("}")) {
            const Token& type = take_word();
            const Token& member = take_word();
            members[std::string(member.text)] = std::string(type.text);
            text += std::string(type.before);
            text += to_ == Language::wgsl ? fmt::format("{}: {}", member.text, spelt(type.text))
                                          : spelt(type.text) + as_it_is(member);
            const Token& end = take(";");
            text += to_ == Language::wgsl ? std::string(end.before) + "," : as_it_is(end);
        }
        text += as_it_is(take("}"));
        const Token& end = take(";");
        return to_ == Language::wgsl ? text : text + as_it_is(end);
    }

    // What stands before the functions, also where several lookups stand in one file.
    std::string prelude() const {
        if (to_ == Language::msl) return "#include <metal_stdlib>\nusing namespace metal;\n\n";
        if (to_ != Language::hlsl || !uses_size_of_) return "";
        return "#ifndef SKYBAKE_SIZE_OF\n"
               "#define SKYBAKE_SIZE_OF\n"
               "int2 size_of(Texture2D table) {\n"
               "    uint x, y;\n"
               "    table.GetDimensions(x, y);\n"
               "    return int2(x, y);\n"
               "}\n"
               "int3 size_of(Texture3D table) {\n"
               "    uint x, y, z;\n"
               "    table.GetDimensions(x, y, z);\n"
               "    return int3(x, y, z);\n"
               "}\n"
               "#endif\n\n";
    }

    Language to_;
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    bool uses_size_of_ = false;
    std::map<std::string, std::map<std::string, std::string>>
        structures_;  // types of their members
    std::map<std::string, Function> functions_;
    std::vector<Parameter> parameters_;             // of the function that is being read
    std::map<std::string, std::string> variables_;  // their types
};

}  // namespace

std::string translated(std::string_view glsl, ShadingLanguage to) {
    return to == ShadingLanguage::glsl ? std::string(glsl) : Translator(glsl, to).text();
}

}  // namespace skybake
