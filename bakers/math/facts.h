// Facts for programs: values under names, as files and manifests carry them.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace skybake {

using FactValue = std::variant<std::string, double, std::vector<double>>;

// In the order in which they are shown.
using Facts = std::vector<std::pair<std::string, FactValue>>;

// The value in words: a number in its shortest form that reads back equal, a list with commas.
std::string fact_text(const FactValue& value);

// The value of that name in words, or an empty text.
std::string fact_named(const Facts& facts, const std::string& name);

// The number of at most so many significant decimal digits that is nearest: files state figures
// to the digits that mean something.
double to_digits(double value, int digits);
std::vector<double> to_digits(std::vector<double> values, int digits);

// The number whose shortest form is that of the float: 0.3 of 0.3f.
double to_shortest(float value);

}  // namespace skybake
