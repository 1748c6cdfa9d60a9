// Facts are named values that output files and manifests state for other programs to read.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace skybake {

using FactValue = std::variant<std::string, double, std::vector<double>>;

// The facts in the order in which they are shown.
using Facts = std::vector<std::pair<std::string, FactValue>>;

// Formats the value as text: a number in its shortest form that reads back equal, a list separated
// by commas.
std::string fact_text(const FactValue& value);

// Returns the value of that name as text, or an empty text if there is none.
std::string fact_named(const Facts& facts, const std::string& name);

// Returns the number of that name, or none if there is none.
std::optional<double> number_named(const Facts& facts, const std::string& name);

// Returns the numbers of the list of that name, or none if there is none.
std::vector<double> numbers_named(const Facts& facts, const std::string& name);

// Rounds to the nearest number of at most `digits` significant decimal digits. Files state figures
// to the digits that are meaningful.
double to_digits(double value, int digits);
std::vector<double> to_digits(std::vector<double> values, int digits);

// Returns the double whose shortest decimal form is that of the float: 0.3 for 0.3f.
double to_shortest(float value);

}  // namespace skybake
