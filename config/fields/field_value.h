// One value of a recipe as its field has it, and its canonical spelling.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "config/text/quantity.h"
#include "config/text/value_tree.h"

namespace skybake::config {

struct Field;

// Which of a field's choices.
struct ChoiceIndex {
    std::size_t index = 0;
};

// In base units. Kinds with one value per channel hold one per channel here.
using FieldValue =
    std::variant<bool, double, std::vector<double>, std::string, std::vector<std::string>,
                 std::array<int, 2>, ChoiceIndex, std::vector<DensityPoint>, std::array<int, 3>,
                 std::vector<std::array<int, 3>>, std::array<double, 4>, std::uint64_t,
                 std::vector<ChoiceIndex>, std::array<double, 2>, std::array<double, 3>,
                 std::vector<HeightPoint>, std::vector<std::vector<std::string>>>;

// TOML text in base units, equal for equal values.
std::string canonical_text(const Field& field, const FieldValue& value);

// "earth.toml:14", "preset earth", "--set `a.b=c`".
std::string origin(const Place& place);

}  // namespace skybake::config
