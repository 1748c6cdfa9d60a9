#include "config/fields/number_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "config/diagnostics/toml_source.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

std::string_view describe_value(const Value& value) {
    constexpr std::array<std::string_view, 7> names = {
        "a date or time", "true or false", "a number", "a number", "a string", "a list", "a table"};
    return names[value.data.index()];
}

std::string with_hint(const std::string& text, const Field& field) {
    return field.hint.empty() ? text : text + "; " + std::string(field.hint);
}

// Whether the value lies within the range. NaN fails every comparison, so it is never within.
bool within(const Range& range, double value) {
    if (range.or_zero && value == 0) return true;
    const bool above = range.open_minimum ? value > range.minimum : value >= range.minimum;
    const bool below = range.open_maximum ? value < range.maximum : value <= range.maximum;
    return above && below;
}

Dimension dimension_of(const Reader& reader) { return reader.field.kind.scale->dimension; }

std::optional<double> check_range(const Reader& reader, const Value& value, double number) {
    if (within(reader.field.range, number)) return number;
    const bool is_fraction = dimension_of(reader) == Dimension::fraction;
    // A whole number above 1 was most likely meant as a percentage.
    const bool is_percent = is_fraction && number > 1 && within(reader.field.range, number / 100);
    std::string label = with_hint("must be " + describe_range(reader.field), reader.field);
    if (is_percent && !std::holds_alternative<std::string>(value.data)) {
        label = fmt::format("{0} is {1} %: write \"{0} %\" for {0} per cent; ",
                            number_to_string(number), number_to_string(100 * number)) +
                label;
    }
    report_range(reader, value, std::isfinite(number), std::move(label));
    return std::nullopt;
}

std::string list_units(Dimension dimension) {
    return fmt::format("{}", fmt::join(unit_names(dimension), ", "));
}

// Says what to write in place of a unit that there is not.
std::string words_for_unit(std::string_view name, Dimension wanted) {
    if (name.starts_with(',')) return "write a decimal point, not a comma";
    if (name.starts_with("..")) return "a range is written FIRST:LAST:COUNT, such as 0.1:0.5:5";
    if (const auto meant = unit_meant(name, wanted)) {
        return fmt::format("units are case sensitive: write `{}`", *meant);
    }
    const std::string list = list_units(wanted);
    return list.empty() ? "expected a number without a unit" : "the units here are " + list;
}

void report_quantity(const Reader& reader, const Value& value, const QuantityError& error,
                     Dimension wanted) {
    using ErrorKind = QuantityError::Kind;
    const std::string part = shorten(error.part);
    std::string message;
    std::string label = fmt::format("expected {}", reader.field.kind.words);
    switch (error.kind) {
        case ErrorKind::not_a_number:
            message =
                fmt::format("`{}` does not start with a number: {}", reader.path, written(value));
            break;
        case ErrorKind::unknown_unit: {
            message = fmt::format("`{}` has an unknown unit: `{}`", reader.path, part);
            label = words_for_unit(error.part, wanted);
            break;
        }
        case ErrorKind::too_large:
            message = fmt::format("`{}` is too large for a number: {}", reader.path, part);
            break;
        case ErrorKind::too_small:
            message =
                fmt::format("`{}` is too small for a number, but not 0: {}", reader.path, part);
            break;
    }
    reader.error("E0106", value, std::move(message), std::move(label));
}

void report_dimension(const Reader& reader, const Value& value, Dimension wanted, Dimension found) {
    const bool unit_missing = found == Dimension::number;
    const std::string what = unit_missing ? "a bare number" : std::string(dimension_name(found));
    const std::string label = unit_missing && wanted != Dimension::fraction
                                  ? fmt::format("expected a unit: {}", list_units(wanted))
                                  : fmt::format("expected {}", reader.field.kind.words);
    reader.error("E0107", value,
                 fmt::format("`{}`: expected {}{}, not {}", reader.path, dimension_name(wanted),
                             wanted == Dimension::number ? "" : " with a unit", what),
                 label);
}

std::optional<double> read_quantity_text(const Reader& reader, const Value& value,
                                         const std::string& text, Dimension wanted) {
    const auto parsed = parse_quantity(text);
    if (const auto* error = std::get_if<QuantityError>(&parsed)) {
        report_quantity(reader, value, *error, wanted);
        return std::nullopt;
    }
    const Quantity quantity = std::get<Quantity>(parsed);
    const bool bare = quantity.dimension == Dimension::number;
    if (bare && (wanted == Dimension::number || wanted == Dimension::fraction)) {
        reader.error("E0103", value,
                     fmt::format("`{}` is a string: {}", reader.path, written(value)),
                     "write a number without a unit without quotes");
        return std::nullopt;
    }
    if (quantity.dimension != wanted) {
        report_dimension(reader, value, wanted, quantity.dimension);
        return std::nullopt;
    }
    return check_range(reader, value, quantity.value);
}

}  // namespace

std::string written(const Value& value) { return shorten(value_to_string(value)); }

void report_type(const Reader& reader, const Value& value, std::string_view wanted) {
    reader.error("E0103", value,
                 fmt::format("`{}` is {}: {}", reader.path, describe_value(value), written(value)),
                 fmt::format("expected {}", wanted));
}

void report_range(const Reader& reader, const Value& value, bool finite, std::string label) {
    const bool ordinary = reader.field.range_code == "E0110";
    std::string what = finite ? "out of range" : "not a finite number";
    if (!ordinary) what = "not one that this release reads";
    reader.error(std::string(reader.field.range_code), value,
                 fmt::format("`{}` is {}: {}", reader.path, what, written(value)),
                 std::move(label));
}

std::optional<double> read_number(const Reader& reader, const Value& value) {
    const Dimension wanted = dimension_of(reader);
    if (const auto* text = std::get_if<std::string>(&value.data)) {
        return read_quantity_text(reader, value, *text, wanted);
    }
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    const auto* floating = std::get_if<double>(&value.data);
    if (!integer && !floating) {
        report_type(reader, value, reader.field.kind.words);
        return std::nullopt;
    }
    const double number = integer ? static_cast<double>(*integer) : *floating;
    if (std::isfinite(number) && wanted != Dimension::number && wanted != Dimension::fraction) {
        report_dimension(reader, value, wanted, Dimension::number);
        return std::nullopt;
    }
    const std::optional<double> checked = check_range(reader, value, number);
    if (!checked) return std::nullopt;
    return *checked + 0.0;  // -0 becomes 0
}

std::optional<double> read_integer(const Reader& reader, const Value& value) {
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    if (!integer) {
        report_type(reader, value, "a whole number");
        return std::nullopt;
    }
    return check_range(reader, value, static_cast<double>(*integer));
}

const Array* list_of(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) report_type(reader, value, reader.field.kind.words);
    return array;
}

const Array* read_items(const Reader& reader, const Value& value, std::size_t count,
                        std::string label) {
    const Array* array = list_of(reader, value);
    if (!array || array->size() == count) return array;
    report_count(reader, value, array->size(), std::move(label));
    return nullptr;
}

std::optional<std::vector<double>> read_numbers(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    std::vector<double> numbers;
    bool valid = true;
    for (const Value& item : array ? *array : Array{value}) {
        const std::optional<double> number = read_number(reader, item);
        valid = valid && number;
        if (number) numbers.push_back(*number);
    }
    if (!valid) return std::nullopt;
    return numbers;
}

std::optional<FieldValue> read_one_or_more(const Reader& reader, const Value& value,
                                           std::string_view noun) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    const int most = reader.field.kind.most;
    if (!numbers->empty() && numbers->size() <= static_cast<std::size_t>(most)) {
        return std::move(*numbers);
    }
    report_count(reader, value, numbers->size(),
                 fmt::format("expected one {}, or up to {}", noun, most));
    return std::nullopt;
}

void report_count(const Reader& reader, const Value& value, std::size_t count, std::string label) {
    reader.error("E0108", value,
                 fmt::format("`{}` has {} value{}", reader.path, count, count == 1 ? "" : "s"),
                 std::move(label));
}

}  // namespace skybake::config
