// The upper half of the parser: statements, functions and structs.
#include <fmt/format.h>

#include "bakers/shading/expressions.h"
#include "bakers/shading/shading_language.h"

namespace skybake {
namespace shading {
namespace {

using Language = ShadingLanguage;

class Translator : private ExpressionTranslator {
  public:
    Translator(std::string_view glsl, Language to) : ExpressionTranslator(glsl, to) {}

    std::string text() {
        std::string text =
            to_ == Language::msl ? "#include <metal_stdlib>\nusing namespace metal;\n\n" : "";
        while (next().kind != TokenKind::end) {
            text += next_is("struct") ? structure() : function();
        }
        return text + std::string(next().before);
    }

  private:
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
        if (to_ != Language::wgsl) text += (is_constant ? "const " : "") + type_name(type);
        for (bool is_first = true; is_first || next_is(","); is_first = false) {
            if (!is_first)
                text += to_ == Language::wgsl ? (take(), ";" + between) : as_it_is(take());
            const Token& name = take_word();
            if (to_ == Language::wgsl) {
                text += fmt::format("{} {}: {}", keyword, named(name.text), type_name(type));
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
                list += type_name(one.type) + one.before_name + own;
            } else if (one.is_assigned) {
                list += fmt::format("{}_given: {}", own, type_name(one.type));
                inside.insert(inside.find('{') + 1, fmt::format(" var {0} = {0}_given;", own));
            } else {
                list += fmt::format("{}: {}", own, type_name(one.type));
            }
            if (one.is_sampled) list += sampler_argument(one.name);
        }
        if (to_ == Language::wgsl)
            return fmt::format("fn {}({}) -> {}", name, list, type_name(result));
        return fmt::format("{}{} {}({})", to_ == Language::msl ? "inline " : "", type_name(result),
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
            text += to_ == Language::wgsl ? fmt::format("{}: {}", member.text, type_name(type.text))
                                          : type_name(type.text) + as_it_is(member);
            const Token& end = take(";");
            text += to_ == Language::wgsl ? std::string(end.before) + "," : as_it_is(end);
        }
        text += as_it_is(take("}"));
        const Token& end = take(";");
        return to_ == Language::wgsl ? text : text + as_it_is(end);
    }
};

}  // namespace
}  // namespace shading

std::string translated(std::string_view glsl, ShadingLanguage to) {
    return to == ShadingLanguage::glsl ? std::string(glsl) : shading::Translator(glsl, to).text();
}

}  // namespace skybake
