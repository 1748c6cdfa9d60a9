#include "bakers/math/facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <charconv>

namespace skybake {
namespace {

double number_of(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

struct FactWriter {
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::vector<double>& numbers) const {
        return fmt::format("{}", fmt::join(numbers, ", "));
    }
};

const FactValue* find_fact(const Facts& facts, const std::string& name) {
    const auto found = std::ranges::find(facts, name, &Facts::value_type::first);
    return found == facts.end() ? nullptr : &found->second;
}

}  // namespace

std::string fact_text(const FactValue& value) { return std::visit(FactWriter{}, value); }

std::string fact_named(const Facts& facts, const std::string& name) {
    const FactValue* fact = find_fact(facts, name);
    return fact == nullptr ? std::string() : fact_text(*fact);
}

std::optional<double> number_named(const Facts& facts, const std::string& name) {
    const FactValue* fact = find_fact(facts, name);
    const auto* number = fact == nullptr ? nullptr : std::get_if<double>(fact);
    return number == nullptr ? std::nullopt : std::optional(*number);
}

std::vector<double> numbers_named(const Facts& facts, const std::string& name) {
    const FactValue* fact = find_fact(facts, name);
    const auto* numbers = fact == nullptr ? nullptr : std::get_if<std::vector<double>>(fact);
    return numbers == nullptr ? std::vector<double>() : *numbers;
}

double to_digits(double value, int digits) {
    assert(digits >= 1);
    return number_of(fmt::format("{:.{}g}", value, digits));
}

std::vector<double> to_digits(std::vector<double> values, int digits) {
    for (double& value : values) value = to_digits(value, digits);
    return values;
}

double to_shortest(float value) { return number_of(fmt::format("{}", value)); }

}  // namespace skybake
