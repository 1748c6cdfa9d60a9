// Expressions of GLSL in another language: the lower half of the parser.
//
// Each rule returns the text of what it has read. Blanks and comments stay before the token that they
// stood before. No sum of texts reads two tokens, as C++ says nothing of the order.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/shading/dialect.h"
#include "bakers/shading/shading_language.h"

namespace skybake::shading {

// It binds tightly if a `.` after it is about all of it.
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

class ExpressionTranslator {
  protected:
    ExpressionTranslator(std::string_view glsl, ShadingLanguage to)
        : to_(to), tokens_(tokens_of(glsl)) {}

    const Token& next() const { return tokens_[at_]; }
    bool next_is(std::string_view text) const { return next().text == text; }
    const Token& take();
    const Token& take(std::string_view text);
    const Token& take_word();
    static std::string as_it_is(const Token& token);
    [[noreturn]] void refuse(const std::string& what) const;

    bool is_type(std::string_view word) const;
    std::string type_name(std::string_view type) const;
    std::string named(std::string_view name) const { return allowed_name(name, to_); }
    bool has_samplers_apart() const;
    static std::string sampler_of(const std::string& texture) { return texture + "_sampler"; }
    Parameter* parameter_named(std::string_view name);
    void note_that_it_is_sampled(const std::string& texture);

    Value expression();
    Value postfix();  // "uv.x"

    ShadingLanguage to_;
    std::map<std::string, std::map<std::string, std::string>>
        structures_;  // types of their members
    std::map<std::string, Function> functions_;
    std::vector<Parameter> parameters_;             // of the function that is being read
    std::map<std::string, std::string> variables_;  // their types

  private:
    Value operation(std::size_t rank);
    Value signed_value();
    Value primary();
    std::string type_of_member(const std::string& type, const std::string& member);

    Value call(Value callee);
    Value converted(const Value& value, const std::string& type) const;
    Value constructed(Value callee, std::vector<Value> arguments) const;
    Value texture_call(Value callee, std::span<const Value> arguments);
    Value own_call(Value callee, const Function& function, std::span<const Value> arguments);
    Value builtin_call(Value callee, std::vector<Value> arguments) const;

    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

}  // namespace skybake::shading
