#include "config/fields/cloud_value_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

namespace skybake::config {
namespace {

// As many numbers as `count` says; `label` names them.
template <std::size_t count>
std::optional<std::array<double, count>> read_some(const Reader& reader, const Value& value,
                                                   std::string label) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) {
        report_type(reader, value, describe_kind(reader.field.kind));
        return std::nullopt;
    }
    if (array->size() != count) {
        report_count(reader, value, array->size(), std::move(label));
        return std::nullopt;
    }
    const std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    std::array<double, count> result{};
    std::copy(numbers->begin(), numbers->end(), result.begin());
    return result;
}

bool is_power_of_two(int number) { return (number & (number - 1)) == 0; }

}  // namespace

std::optional<std::array<double, 2>> read_pair(const Reader& reader, const Value& value) {
    return read_some<2>(reader, value, "expected two numbers");
}

std::optional<std::array<double, 2>> read_bounds(const Reader& reader, const Value& value) {
    const auto bounds = read_some<2>(reader, value, "expected two numbers, from and to");
    if (!bounds || (*bounds)[0] <= (*bounds)[1]) return bounds;
    reader.error(
        "E0113", value,
        fmt::format("`{}` has its bounds in the wrong order: {}", reader.path, written(value)),
        "write the lower one first");
    return std::nullopt;
}

std::optional<std::array<double, 3>> read_lengths(const Reader& reader, const Value& value) {
    return read_some<3>(reader, value, "expected three lengths, along x, y and z");
}

std::optional<double> read_power_of_two(const Reader& reader, const Value& value) {
    const std::optional<double> number = read_integer(reader, value);
    if (!number || is_power_of_two(static_cast<int>(*number))) return number;
    std::vector<int> allowed;
    for (int power = 1; power <= reader.field.range.maximum; power *= 2) allowed.push_back(power);
    report_range(reader, value, true, fmt::format("must be one of {}", fmt::join(allowed, ", ")));
    return std::nullopt;
}

}  // namespace skybake::config
