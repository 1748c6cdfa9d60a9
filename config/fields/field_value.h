// This header defines the value of a field and its canonical spelling.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "config/text/quantity.h"
#include "config/text/value_tree.h"

namespace skybake::config {

struct Field;

// This is the position of a choice among a field's choices.
struct ChoiceIndex {
    std::size_t index = 0;
};

// Numbers are in base units. A value of a kind that has one number per channel holds one number for
// each channel.
using FieldValue =
    std::variant<bool, double, std::vector<double>, std::string, std::vector<std::string>,
                 std::array<int, 2>, ChoiceIndex, std::vector<DensityPoint>, std::array<int, 3>,
                 std::vector<std::array<int, 3>>, std::array<double, 4>, std::uint64_t,
                 std::vector<ChoiceIndex>, std::array<double, 2>, std::array<double, 3>,
                 std::vector<HeightPoint>, std::vector<std::vector<std::string>>,
                 std::vector<IndexPoint>, std::vector<ComponentNumber>, std::vector<SpectrumPoint>>;

// Spells a value as TOML text in base units. Equal values have equal texts.
std::string canonical_text(const Field& field, const FieldValue& value);

// Says where a value comes from: "earth.toml:14", "preset earth" or "--set `a.b=c`".
std::string origin(const Place& place);

}  // namespace skybake::config
