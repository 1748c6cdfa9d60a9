// This file reads values of more than one number, and the values of noises and their volumes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "config/fields/number_reader.h"

namespace skybake::config {
namespace {

// Reads `count` numbers. `label` names them.
template <std::size_t count>
std::optional<std::array<double, count>> read_some(const Reader& reader, const Value& value,
                                                   std::string label) {
    if (!read_items(reader, value, count, std::move(label))) return std::nullopt;
    const std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    std::array<double, count> result{};
    std::ranges::copy(*numbers, result.begin());
    return result;
}

// Reads `count` whole numbers.
template <std::size_t count>
std::optional<FieldValue> read_wholes(const Reader& reader, const Value& value, std::string label) {
    const Array* items = read_items(reader, value, count, std::move(label));
    if (!items) return std::nullopt;
    std::array<int, count> numbers{};
    bool valid = true;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<double> number = read_integer(reader, (*items)[i]);
        valid = valid && number;
        if (number) numbers[i] = static_cast<int>(*number);
    }
    if (!valid) return std::nullopt;
    return numbers;
}

bool is_power_of_two(int number) { return (number & (number - 1)) == 0; }

// This is the least difference of two numbers that a division uses, so that the slope is finite in
// single precision.
constexpr double least_difference = 1e-6;

// Reads digits, or 0x and hexadecimal digits, and nothing else. Returns what is wrong, or no error.
std::errc parse_seed(std::string_view text, std::uint64_t& seed) {
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    if (hexadecimal) text.remove_prefix(2);
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, seed, hexadecimal ? 16 : 10);
    return last == end ? error : std::errc::invalid_argument;
}

// Returns the items of a list of one to most_octaves values. Returns null and reports an error if
// the value is not such a list.
const Array* octave_list(const Reader& reader, const Value& value) {
    const Array* array = list_of(reader, value);
    if (!array || (!array->empty() && array->size() <= std::size_t{most_octaves})) return array;
    report_count(reader, value, array->size(), fmt::format("give one to {} octaves", most_octaves));
    return nullptr;
}

// Reads one number for all axes, or one per axis.
std::optional<std::array<int, 3>> read_axes(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array && !std::holds_alternative<std::int64_t>(value.data)) {
        report_type(reader, value, Kind::frequency.words);
        return std::nullopt;
    }
    if (array && array->size() != 3) {
        report_count(reader, value, array->size(),
                     "expected one whole number, or three: along x, y and z");
        return std::nullopt;
    }
    std::array<int, 3> frequency{};
    bool valid = true;
    for (std::size_t axis = 0; axis < 3 && (array || axis == 0); ++axis) {
        const auto number = read_integer(reader, array ? (*array)[axis] : value);
        valid = valid && number;
        if (number) frequency[axis] = static_cast<int>(*number);
    }
    if (!valid) return std::nullopt;
    if (!array) frequency.fill(frequency[0]);
    return frequency;
}

}  // namespace

std::optional<FieldValue> read_seed(const Reader& reader, const Value& value) {
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    if (integer && *integer >= 0) return static_cast<std::uint64_t>(*integer);
    const auto* text = std::get_if<std::string>(&value.data);
    std::uint64_t seed = 0;
    const std::errc error = text ? parse_seed(*text, seed) : std::errc::invalid_argument;
    if (error == std::errc()) return seed;
    if (integer || error == std::errc::result_out_of_range) {
        report_range(reader, value, true, "must be from 0 to 18446744073709551615 (2^64 - 1)");
    } else {
        report_type(reader, value, Kind::seed.words);
    }
    return std::nullopt;
}

std::optional<FieldValue> read_frequency(const Reader& reader, const Value& value) {
    return read_axes(reader, value);
}

std::optional<FieldValue> read_frequencies(const Reader& reader, const Value& value) {
    const Array* array = octave_list(reader, value);
    if (!array) return std::nullopt;
    std::vector<std::array<int, 3>> frequencies;
    for (const Value& item : *array) {
        const auto frequency = read_axes(reader, item);
        if (frequency) frequencies.push_back(*frequency);
    }
    if (frequencies.size() != array->size()) return std::nullopt;
    return frequencies;
}

std::optional<FieldValue> read_gains(const Reader& reader, const Value& value) {
    if (!octave_list(reader, value)) return std::nullopt;
    std::optional<std::vector<double>> gains = read_numbers(reader, value);
    if (!gains) return std::nullopt;
    if (std::ranges::any_of(*gains, [](double gain) { return gain != 0; })) return gains;
    report_range(reader, value, true, "at least one gain must be above 0");
    return std::nullopt;
}

std::optional<FieldValue> read_remap(const Reader& reader, const Value& value) {
    const auto remap =
        read_some<4>(reader, value, "expected four numbers: [in_low, in_high, out_low, out_high]");
    if (!remap || std::fabs((*remap)[1] - (*remap)[0]) >= least_difference) return remap;
    report_range(reader, value, true, "in_low and in_high must differ by 1e-6 or more");
    return std::nullopt;
}

std::optional<FieldValue> read_pair(const Reader& reader, const Value& value) {
    return read_some<2>(reader, value, "expected two numbers");
}

std::optional<FieldValue> read_triple(const Reader& reader, const Value& value) {
    return read_some<3>(reader, value, "expected three lengths, along x, y and z");
}

std::optional<FieldValue> read_edges(const Reader& reader, const Value& value) {
    const auto edges = read_some<2>(reader, value, "expected two numbers");
    if (!edges || (*edges)[1] - (*edges)[0] >= least_difference) return edges;
    report_range(reader, value, true, "the second edge must be above the first by 1e-6 or more");
    return std::nullopt;
}

std::optional<FieldValue> read_bounds(const Reader& reader, const Value& value) {
    const auto bounds = read_some<2>(reader, value, "expected two numbers, from and to");
    if (!bounds || (*bounds)[0] <= (*bounds)[1]) return bounds;
    reader.error(
        "E0113", value,
        fmt::format("`{}` has its bounds in the wrong order: {}", reader.path, written(value)),
        "write the lower one first");
    return std::nullopt;
}

std::optional<FieldValue> read_clamp(const Reader& reader, const Value& value) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    const auto* flag = std::get_if<bool>(&value.data);
    if (!flag) return read_bounds(reader, value);
    return *flag ? std::array<double, 2>{0, 1} : std::array<double, 2>{-unbounded, unbounded};
}

std::optional<FieldValue> read_size(const Reader& reader, const Value& value) {
    return read_wholes<2>(reader, value, "expected two whole numbers, width and height");
}

std::optional<FieldValue> read_voxels(const Reader& reader, const Value& value) {
    return read_wholes<3>(reader, value, "expected three whole numbers, along x, y and z");
}

std::optional<FieldValue> read_levels(const Reader& reader, const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (text && *text == "all") return 0.0;
    if (std::holds_alternative<std::int64_t>(value.data)) return read_integer(reader, value);
    report_type(reader, value, Kind::levels.words);
    return std::nullopt;
}

std::optional<FieldValue> read_power_of_two(const Reader& reader, const Value& value) {
    const std::optional<double> number = read_integer(reader, value);
    if (!number || is_power_of_two(static_cast<int>(*number))) return number;
    std::vector<int> allowed;
    for (int power = 1; power <= reader.field.range.maximum; power *= 2) allowed.push_back(power);
    report_range(reader, value, true, fmt::format("must be one of {}", fmt::join(allowed, ", ")));
    return std::nullopt;
}

}  // namespace skybake::config
