#include "bakers/shading/expressions.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skybake::shading {
namespace {

using Language = ShadingLanguage;

std::string joined(std::span<const Value> arguments) {
    std::string text;
    for (const Value& one : arguments) text += (text.empty() ? "" : ",") + one.whole();
    return text;
}

}  // namespace

// --- Tokens -------------------------------------------------------------------------------------

const Token& ExpressionTranslator::take() {
    if (next().kind == TokenKind::end) refuse("it ends here");
    return tokens_[at_++];
}
const Token& ExpressionTranslator::take(std::string_view text) {
    if (!next_is(text)) refuse(fmt::format("`{}` instead of `{}`", next().text, text));
    return take();
}
const Token& ExpressionTranslator::take_word() {
    if (next().kind != TokenKind::word) refuse(fmt::format("`{}` instead of a name", next().text));
    return take();
}
std::string ExpressionTranslator::as_it_is(const Token& token) {
    return std::string(token.before) + std::string(token.text);
}
void ExpressionTranslator::refuse(const std::string& what) const {
    throw std::invalid_argument(fmt::format("line {} of GLSL: {}", next().line, what));
}

// --- Names --------------------------------------------------------------------------------------

bool ExpressionTranslator::is_type(std::string_view word) const {
    return !translated_type(word, to_).empty() || structures_.contains(std::string(word));
}
std::string ExpressionTranslator::type_name(std::string_view type) const {
    const std::string_view word = translated_type(type, to_);
    return std::string(word.empty() ? type : word);
}
bool ExpressionTranslator::has_samplers_apart() const {
    return to_ != Language::glsl && to_ != Language::godot;
}
Parameter* ExpressionTranslator::parameter_named(std::string_view name) {
    const auto found = std::ranges::find(parameters_, name, &Parameter::name);
    return found != parameters_.end() ? &*found : nullptr;
}
void ExpressionTranslator::note_that_it_is_sampled(const std::string& texture) {
    Parameter* const parameter = parameter_named(texture);
    if (parameter == nullptr) refuse(fmt::format("`{}` is no argument", texture));
    parameter->is_sampled = true;
}

// --- Expressions ----------------------------------------------------------------------------

Value ExpressionTranslator::expression() {
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
Value ExpressionTranslator::operation(std::size_t rank) {
    static const std::vector<std::vector<std::string_view>> kRanks = {
        {"||"}, {"&&"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"+", "-"}, {"*", "/"}};
    if (rank == kRanks.size()) return signed_value();
    Value left = operation(rank + 1);
    const auto& marks = kRanks[rank];
    while (std::ranges::find(marks, next().text) != marks.end()) {
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

Value ExpressionTranslator::signed_value() {
    if (!next_is("-") && !next_is("!")) return postfix();
    const Token& mark = take();
    Value value = signed_value();
    value.text = std::string(mark.text) + value.whole();
    value.before = mark.before;
    value.binds_tightly = false;
    return value;
}

Value ExpressionTranslator::postfix() {
    Value value = primary();
    while (next_is(".")) {
        take();
        const std::string member(take_word().text);
        value.text = value.tight() + "." + member;
        value.binds_tightly = true;
        value.type = type_of_member(value.type, member);
    }
    return value;
}

std::string ExpressionTranslator::type_of_member(const std::string& type,
                                                 const std::string& member) {
    const auto structure = structures_.find(type);
    if (structure == structures_.end()) {
        if (components_of(type) < 2 || member.size() > 4)
            refuse(fmt::format("`{}` of `{}`", member, type));
        return vector_of(scalar_of(type), static_cast<int>(member.size()));
    }
    const auto found = structure->second.find(member);
    if (found == structure->second.end()) refuse(fmt::format("`{}` of `{}`", member, type));
    return found->second;
}

Value ExpressionTranslator::primary() {
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

// Translates a call of what stands in `callee.text`.
Value ExpressionTranslator::call(Value callee) {
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

// The value as one of another type with as many components, or a number as a vector.
Value ExpressionTranslator::converted(const Value& value, const std::string& type) const {
    if (value.type == type) return value;
    const bool is_cast = to_ == Language::hlsl && components_of(type) > 1;
    const std::string word = is_cast ? "(" + type_name(type) + ")" : type_name(type);
    return {value.before, fmt::format("{}({})", word, value.text), type, !is_cast};
}

// float(i), vec3(1.0), vec3(cells), vec3(texel), vec4(rgb, 1.0)
Value ExpressionTranslator::constructed(Value callee, std::vector<Value> arguments) const {
    const std::string type = callee.text;
    const std::string scalar(scalar_of(type));
    int count = 0;
    for (Value& one : arguments) {
        const int components = components_of(one.type);
        if (arguments.size() == 1 && components > components_of(type)) {
            constexpr std::string_view kNames = "xyzw";
            one.text = fmt::format("{}.{}", one.tight(),
                                   kNames.substr(0, static_cast<std::size_t>(components_of(type))));
            one.type = vector_of(scalar_of(one.type), components_of(type));
            one.binds_tightly = true;
        }
        one = converted(one, vector_of(scalar, components_of(one.type)));
        count += components_of(one.type);
    }
    const bool fits = count == components_of(type) || (arguments.size() == 1 && count == 1);
    if (!fits || count == 0) refuse(fmt::format("{} components in `{}`", count, type));
    if (arguments.size() > 1)
        return {callee.before, type_name(type) + "(" + joined(arguments) + ")", type};
    Value only = converted(arguments[0], type);
    only.before = callee.before;
    return only;
}

Value ExpressionTranslator::texture_call(Value callee, std::span<const Value> arguments) {
    const TextureFunction function =
        arguments.size() < 2 ? TextureFunction{}
                             : translated_texture_function(callee.text, arguments[0].type, to_);
    if (function.form.empty()) refuse(fmt::format("the function `{}`", callee.text));
    const std::string& table = arguments[0].text;
    if (callee.text == "texture") note_that_it_is_sampled(table);
    const std::string level = arguments.size() > 2 ? arguments[2].text : "";
    return {callee.before,
            fmt::format(fmt::runtime(function.form), table, sampler_of(table), arguments[1].text,
                        level),
            std::string(function.result)};
}

Value ExpressionTranslator::own_call(Value callee, const Function& function,
                                     std::span<const Value> arguments) {
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
Value ExpressionTranslator::builtin_call(Value callee, std::vector<Value> arguments) const {
    const DialectFunction function = translated_function(callee.text, to_);
    if (function.result == FunctionResult::none || arguments.empty()) {
        refuse(fmt::format("the function `{}`", callee.text));
    }
    const auto widest = std::ranges::max_element(arguments, [](const Value& a, const Value& b) {
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

}  // namespace skybake::shading
