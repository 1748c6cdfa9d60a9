#include "config/field_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "config/key_path.h"
#include "config/suggest.h"
#include "config/toml_source.h"
#include "config/units.h"

namespace skybake::config {
namespace {

// One field's value while it is read: what every helper below needs for its messages.
struct Reader {
    const Field& field;
    std::string_view path;
    DiagnosticList& diagnostics;

    void error(std::string code, const Value& value, std::string message, std::string label) const {
        diagnostics.error(std::move(code), value.place, std::move(message), std::move(label));
    }
};

std::string written(const Value& value) { return shorten(spell_value(value)); }

std::string_view describe_value(const Value& value) {
    constexpr std::array<std::string_view, 7> names = {
        "a date or time", "true or false", "a number", "a number", "text", "a list", "a table"};
    return names[value.data.index()];
}

void report_type(const Reader& reader, const Value& value, std::string_view wanted) {
    reader.error("E0103", value,
                 fmt::format("`{}` is {}: {}", reader.path, describe_value(value), written(value)),
                 fmt::format("wanted: {}", wanted));
}

std::string with_hint(const std::string& text, const Field& field) {
    return field.hint.empty() ? text : text + "; " + std::string(field.hint);
}

// NaN fails every comparison, so it is never within.
bool within(const Range& range, double value) {
    const bool above = range.open_minimum ? value > range.minimum : value >= range.minimum;
    const bool below = range.open_maximum ? value < range.maximum : value <= range.maximum;
    return above && below;
}

std::optional<double> check_range(const Reader& reader, const Value& value, double number) {
    if (within(reader.field.range, number)) return number;
    const bool ordinary = reader.field.range_code == "E0110";
    std::string what = std::isfinite(number) ? "out of range" : "not a finite number";
    if (!ordinary) what = "not one that this release reads";
    reader.error(std::string(reader.field.range_code), value,
                 fmt::format("`{}` is {}: {}", reader.path, what, written(value)),
                 with_hint("must be " + describe_range(reader.field), reader.field));
    return std::nullopt;
}

Dimension wanted_dimension(Kind kind) {
    switch (kind) {
        case Kind::fraction:
        case Kind::fractions:
            return Dimension::fraction;
        case Kind::length:
        case Kind::wavelengths:
            return Dimension::length;
        case Kind::coefficients:
            return Dimension::inverse_length;
        default:
            return Dimension::number;
    }
}

std::string list_units(Dimension dimension) {
    std::string text;
    for (const std::string_view name : unit_names(dimension)) {
        if (!text.empty()) text += ", ";
        text += name;
    }
    return text;
}

void report_quantity(const Reader& reader, const Value& value, const QuantityError& error,
                     Dimension wanted) {
    using ErrorKind = QuantityError::Kind;
    const std::string part = shorten(error.part);
    std::string message;
    std::string label = fmt::format("wanted: {}", describe_kind(reader.field.kind));
    switch (error.kind) {
        case ErrorKind::not_a_number:
            message =
                fmt::format("`{}` does not start with a number: {}", reader.path, written(value));
            break;
        case ErrorKind::unknown_unit: {
            message = fmt::format("`{}` has an unknown unit: `{}`", reader.path, part);
            const std::vector<std::string_view> names = unit_names(wanted);
            label = did_you_mean(error.part, names);
            if (label.empty() && !names.empty()) label = "units here: " + list_units(wanted);
            if (label.empty()) label = "wanted: a number without a unit";
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
                                  ? fmt::format("give it with its unit: {}", list_units(wanted))
                                  : fmt::format("wanted: {}", describe_kind(reader.field.kind));
    reader.error(
        "E0107", value,
        fmt::format("`{}`: {} is wanted here, not {}", reader.path, dimension_name(wanted), what),
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
        reader.error("E0103", value, fmt::format("`{}` is text: {}", reader.path, written(value)),
                     "a number without a unit stands without quotes");
        return std::nullopt;
    }
    if (quantity.dimension != wanted) {
        report_dimension(reader, value, wanted, quantity.dimension);
        return std::nullopt;
    }
    return check_range(reader, value, quantity.value);
}

std::optional<double> read_number(const Reader& reader, const Value& value) {
    const Dimension wanted = wanted_dimension(reader.field.kind);
    if (const auto* text = std::get_if<std::string>(&value.data)) {
        return read_quantity_text(reader, value, *text, wanted);
    }
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    const auto* floating = std::get_if<double>(&value.data);
    if (!integer && !floating) {
        report_type(reader, value, describe_kind(reader.field.kind));
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

// Each of a list's values, or the one value; none if one of them is at fault.
std::optional<std::vector<double>> read_numbers(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    std::vector<double> numbers;
    bool valid = true;
    const auto read_one = [&](const Value& item) {
        const std::optional<double> number = read_number(reader, item);
        valid = valid && number;
        if (number) numbers.push_back(*number);
    };
    if (array) {
        for (const Value& item : *array) read_one(item);
    } else {
        read_one(value);
    }
    if (!valid) return std::nullopt;
    return numbers;
}

void report_count(const Reader& reader, const Value& value, std::size_t count, std::string label) {
    reader.error("E0108", value,
                 fmt::format("`{}` has {} value{}", reader.path, count, count == 1 ? "" : "s"),
                 std::move(label));
}

std::optional<FieldValue> read_wavelengths(const Reader& reader, const Value& value) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    if (numbers->size() != 1 && numbers->size() != 3) {
        report_count(reader, value, numbers->size(), "wanted: one wavelength, or three");
        return std::nullopt;
    }
    return std::move(*numbers);
}

std::optional<FieldValue> read_channels(const Reader& reader, const Value& value,
                                        std::optional<int> channels) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    const std::size_t count = channels ? static_cast<std::size_t>(*channels) : numbers->size();
    if (numbers->empty() || (numbers->size() != 1 && numbers->size() != count)) {
        const std::string label = count > 1
                                      ? fmt::format("one value, or {}: one per wavelength", count)
                                      : "wanted: one value";
        report_count(reader, value, numbers->size(), label);
        return std::nullopt;
    }
    if (numbers->size() == 1) numbers->resize(count, numbers->front());
    return std::move(*numbers);
}

std::optional<FieldValue> read_size(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) {
        report_type(reader, value, describe_kind(Kind::size));
        return std::nullopt;
    }
    if (array->size() != 2) {
        report_count(reader, value, array->size(), "two whole numbers: width and height");
        return std::nullopt;
    }
    const std::optional<double> width = read_integer(reader, (*array)[0]);
    const std::optional<double> height = read_integer(reader, (*array)[1]);
    if (!width || !height) return std::nullopt;
    return std::array<int, 2>{static_cast<int>(*width), static_cast<int>(*height)};
}

std::optional<FieldValue> read_choice(const Reader& reader, const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (!text) {
        report_type(reader, value, describe_choices(reader.field));
        return std::nullopt;
    }
    const std::vector<std::string_view> names = choice_names(reader.field);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == *text) return ChoiceIndex{i};
    }
    std::string label = did_you_mean(*text, names);
    if (label.empty()) label = "must be " + describe_choices(reader.field);
    reader.error("E0104", value, fmt::format("`{}` cannot be {}", reader.path, written(value)),
                 std::move(label));
    return std::nullopt;
}

std::optional<FieldValue> read_text(const Reader& reader, const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
    report_type(reader, value, describe_kind(Kind::text));
    return std::nullopt;
}

std::optional<FieldValue> read_text_list(const Reader& reader, const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value.data)) return std::vector{*text};
    const auto* array = std::get_if<Array>(&value.data);
    std::vector<std::string> texts;
    bool valid = array != nullptr;
    for (std::size_t i = 0; valid && i < array->size(); ++i) {
        const auto* text = std::get_if<std::string>(&(*array)[i].data);
        valid = text != nullptr;
        if (text) texts.push_back(*text);
    }
    if (valid) return texts;
    report_type(reader, value, describe_kind(Kind::text_list));
    return std::nullopt;
}

// The altitudes of a table; its densities have the range of the table's field. A table stands on
// the ground, so a negative altitude is a slip.
constexpr Field table_altitude{.key = "altitude", .kind = Kind::length, .range = {0, 1e12}};

std::optional<DensityPoint> read_point(const Reader& reader, const Value& value) {
    const auto* pair = std::get_if<Array>(&value.data);
    if (!pair || pair->size() != 2) {
        reader.error(
            "E0114", value,
            fmt::format("`{}` has an entry that is no pair: {}", reader.path, written(value)),
            "each entry is [altitude, density], such as [\"10 km\", 0.5]");
        return std::nullopt;
    }
    const Field density_field{.key = "density", .kind = Kind::number, .range = reader.field.range};
    const auto altitude =
        read_number(Reader{table_altitude, reader.path, reader.diagnostics}, (*pair)[0]);
    const auto density =
        read_number(Reader{density_field, reader.path, reader.diagnostics}, (*pair)[1]);
    if (!altitude || !density) return std::nullopt;
    return DensityPoint{{*altitude}, *density};
}

std::optional<FieldValue> read_density_table(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) {
        report_type(reader, value, describe_kind(Kind::density_table));
        return std::nullopt;
    }
    if (array->size() < 2) {
        reader.error("E0114", value, fmt::format("`{}` has fewer than two entries", reader.path),
                     "at least two [altitude, density] pairs");
        return std::nullopt;
    }
    std::vector<DensityPoint> table;
    bool valid = true;
    for (const Value& item : *array) {
        const std::optional<DensityPoint> point = read_point(reader, item);
        valid = valid && point;
        if (!point) continue;
        if (!table.empty() && !(point->altitude.meters > table.back().altitude.meters)) {
            reader.error("E0114", item,
                         fmt::format("`{}` has altitudes that do not increase: {} after {}",
                                     reader.path, spell_length(point->altitude.meters),
                                     spell_length(table.back().altitude.meters)),
                         "each altitude must be above the one before");
            valid = false;
        }
        table.push_back(*point);
    }
    if (!valid) return std::nullopt;
    return table;
}

template <class T>
std::optional<FieldValue> as_field_value(const std::optional<T>& value) {
    if (!value) return std::nullopt;
    return *value;
}

}  // namespace

std::optional<FieldValue> read_field(const Field& field, std::string_view path, const Value& value,
                                     std::optional<int> channels, DiagnosticList& diagnostics) {
    const Reader reader{field, path, diagnostics};
    switch (field.kind) {
        case Kind::flag:
            if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
            report_type(reader, value, describe_kind(field.kind));
            return std::nullopt;
        case Kind::integer:
            return as_field_value(read_integer(reader, value));
        case Kind::number:
        case Kind::fraction:
        case Kind::length:
            return as_field_value(read_number(reader, value));
        case Kind::text:
            return read_text(reader, value);
        case Kind::text_list:
            return read_text_list(reader, value);
        case Kind::choice:
            return read_choice(reader, value);
        case Kind::wavelengths:
            return read_wavelengths(reader, value);
        case Kind::coefficients:
        case Kind::fractions:
            return read_channels(reader, value, channels);
        case Kind::size:
            return read_size(reader, value);
        case Kind::density_table:
            return read_density_table(reader, value);
    }
    return std::nullopt;
}

std::optional<FieldValue> default_value(const Field& field, std::optional<int> channels) {
    if (field.fallback.empty()) return std::nullopt;
    const std::optional<Value> value = parse_toml_value(field.fallback);
    if (!value) return std::nullopt;
    DiagnosticList none_expected;
    return read_field(field, field.key, *value, channels, none_expected);
}

}  // namespace skybake::config
