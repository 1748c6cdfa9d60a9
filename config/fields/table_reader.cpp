// This file reads tables: density over altitude, a cloud's profile over height, albedo and
// refractive indices over wavelength, and lists of components.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "config/fields/key.h"
#include "config/fields/number_reader.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/quantity.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

using Pair = std::array<double, 2>;

// This is what differs between the kinds of tables of pairs.
struct Columns {
    Field first;              // key, kind and range of the first column
    std::string_view plural;  // "altitudes"
    std::string_view second;  // "density"
    std::string_view example;
    std::size_t fewest;
    std::string (*to_string)(double);  // of the first column
    ValueKind second_kind;
};

// A table begins at the ground, so a negative altitude is a mistake.
constexpr Columns density_columns{key("altitude", Kind::length, Range{0, 1e12}),
                                  "altitudes",
                                  "density",
                                  "[\"10 km\", 0.5]",
                                  2,
                                  length_to_string,
                                  Kind::number};
constexpr Columns height_columns{key("height", Kind::number, unit_range),
                                 "heights",
                                 "value",
                                 "[0.2, 1.0]",
                                 1,
                                 number_to_string,
                                 Kind::number};
constexpr Field wavelength_field = key("wavelength", Kind::length, Range{1e-8, 1e-3});
constexpr Columns spectrum_columns{
    wavelength_field,     "wavelengths", "albedo", "[\"450 nm\", 0.07]", 2,
    wavelength_to_string, Kind::fraction};

std::string pair_words(const Columns& columns) {
    return fmt::format("[{}, {}]", columns.first.key, columns.second);
}

std::optional<double> read_item(const Reader& reader, const Field& field, const Value& value) {
    return read_number(Reader{field, reader.path, reader.diagnostics}, value);
}

std::optional<Pair> read_entry(const Reader& reader, const Columns& columns, const Value& value) {
    const auto* pair = std::get_if<Array>(&value.data);
    if (!pair || pair->size() != 2) {
        reader.error(
            "E0114", value,
            fmt::format("`{}` has an entry that is not a pair: {}", reader.path, written(value)),
            fmt::format("each entry is {}, such as {}", pair_words(columns), columns.example));
        return std::nullopt;
    }
    const Field second_field = key(columns.second, columns.second_kind, reader.field.range);
    const auto first = read_item(reader, columns.first, (*pair)[0]);
    const auto second = read_item(reader, second_field, (*pair)[1]);
    if (!first || !second) return std::nullopt;
    return Pair{*first, *second};
}

bool check_order(const Reader& reader, const Columns& columns, const Value& item, double first,
                 double before) {
    if (first > before) return true;
    reader.error("E0114", item,
                 fmt::format("`{}` has {} that do not increase: {} after {}", reader.path,
                             columns.plural, columns.to_string(first), columns.to_string(before)),
                 fmt::format("each {} must be above the one before", columns.first.key));
    return false;
}

// Returns an entry's items, of which there must be `count`, or null if it has
// others, which is reported. `words` says what an entry is.
const Array* entry_items(const Reader& reader, const Value& value, std::size_t count,
                         std::string_view words) {
    const auto* items = std::get_if<Array>(&value.data);
    if (items && items->size() == count) return items;
    reader.error(
        "E0114", value,
        fmt::format("`{}` has an entry that is not {}: {}", reader.path, words, written(value)),
        fmt::format("give {}", reader.field.kind.words));
    return nullptr;
}

// Reads the entries of a list. `fits(before, entry, value)` reports an entry that does not go with those
// before it, and returns whether it does.
template <class T, class ReadEntry, class Fits>
std::optional<std::vector<T>> read_entries(const Reader& reader, const Array& array,
                                           const ReadEntry& read, const Fits& fits) {
    std::vector<T> list;
    bool valid = true;
    for (const Value& entry : array) {
        std::optional<T> one = read(reader, entry);
        valid = (!one || fits(list, *one, entry)) && one && valid;
        if (one) list.push_back(std::move(*one));
    }
    if (!valid) return std::nullopt;
    return list;
}

// Returns the items of a list that must not be empty, or null, which is reported.
const Array* some_entries(const Reader& reader, const Value& value) {
    const Array* array = list_of(reader, value);
    if (!array || !array->empty()) return array;
    reader.error("E0114", value, fmt::format("`{}` has no entries", reader.path),
                 fmt::format("give {}", reader.field.kind.words));
    return nullptr;
}

std::optional<std::vector<Pair>> read_table(const Reader& reader, const Columns& columns,
                                            const Value& value) {
    const Array* array = list_of(reader, value);
    if (!array) return std::nullopt;
    if (array->size() < columns.fewest) {
        const bool is_one = columns.fewest == 1;
        reader.error("E0114", value,
                     fmt::format("`{}` has {}", reader.path,
                                 is_one ? "no entries" : "fewer than two entries"),
                     fmt::format("give at least {} {} pair{}", is_one ? "one" : "two",
                                 pair_words(columns), is_one ? "" : "s"));
        return std::nullopt;
    }
    return read_entries<Pair>(
        reader, *array,
        [&](const Reader& of, const Value& entry) { return read_entry(of, columns, entry); },
        [&](const std::vector<Pair>& table, const Pair& pair, const Value& entry) {
            return table.empty() || check_order(reader, columns, entry, pair[0], table.back()[0]);
        });
}

template <class Point>
std::optional<FieldValue> points_of(const std::optional<std::vector<Pair>>& pairs) {
    if (!pairs) return std::nullopt;
    return mapped<Point>(*pairs, [](const Pair& pair) { return Point{{pair[0]}, pair[1]}; });
}

std::optional<IndexPoint> read_index(const Reader& reader, const Value& value) {
    constexpr Field real = key("n", Kind::number, Range{0.01, 100});
    const Field imaginary = key("k", Kind::number, reader.field.range);
    const Array* items = entry_items(reader, value, 3, "[wavelength, n, k]");
    if (!items) return std::nullopt;
    const auto at = read_item(reader, wavelength_field, (*items)[0]);
    const auto n = read_item(reader, real, (*items)[1]);
    const auto k = read_item(reader, imaginary, (*items)[2]);
    if (!at || !n || !k) return std::nullopt;
    return IndexPoint{{*at}, *n, *k};
}

std::optional<ComponentNumber> read_component(const Reader& reader, const Value& value) {
    const Field number = key("number", Kind::number_density, reader.field.range);
    const Array* items = entry_items(reader, value, 2, "[component, number density]");
    if (!items) return std::nullopt;
    const auto* name = std::get_if<std::string>(&(*items)[0].data);
    if (!name) report_type(reader, (*items)[0], "the name of a component");
    const auto density = read_item(reader, number, (*items)[1]);
    if (!name || !density) return std::nullopt;
    return ComponentNumber{*name, {*density}};
}

}  // namespace

std::optional<FieldValue> read_density_table(const Reader& reader, const Value& value) {
    return points_of<DensityPoint>(read_table(reader, density_columns, value));
}

std::optional<FieldValue> read_height_table(const Reader& reader, const Value& value) {
    return points_of<HeightPoint>(read_table(reader, height_columns, value));
}

std::optional<FieldValue> read_albedo(const Reader& reader, const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    const char first = text && !text->empty() ? text->front() : '0';
    if ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z')) {
        return read_one_choice(reader, value);
    }
    const auto* array = std::get_if<Array>(&value.data);
    const bool nested =
        array && !array->empty() && std::holds_alternative<Array>(array->front().data);
    if (!nested) return read_channels(reader, value);
    return points_of<SpectrumPoint>(read_table(reader, spectrum_columns, value));
}

std::optional<FieldValue> read_index_table(const Reader& reader, const Value& value) {
    const Array* array = some_entries(reader, value);
    if (!array) return std::nullopt;
    return read_entries<IndexPoint>(
        reader, *array, read_index,
        [&](const std::vector<IndexPoint>& table, const IndexPoint& point, const Value& entry) {
            const double before = table.empty() ? 0 : table.back().wavelength.meters;
            if (point.wavelength.meters > before) return true;
            reader.error("E0114", entry,
                         fmt::format("`{}` has wavelengths that do not increase: {} after {}",
                                     reader.path, wavelength_to_string(point.wavelength.meters),
                                     wavelength_to_string(before)),
                         "sort the entries by wavelength and give each one once");
            return false;
        });
}

std::optional<FieldValue> read_components(const Reader& reader, const Value& value) {
    const Array* array = some_entries(reader, value);
    if (!array) return std::nullopt;
    return read_entries<ComponentNumber>(
        reader, *array, read_component,
        [&](const std::vector<ComponentNumber>& list, const ComponentNumber& one,
            const Value& entry) {
            const auto is_same = [&](const ComponentNumber& other) {
                return other.component == one.component;
            };
            if (std::ranges::none_of(list, is_same)) return true;
            reader.error("E0114", entry,
                         fmt::format("`{}` names {} twice", reader.path, shorten(one.component)),
                         "give its numbers together");
            return false;
        });
}

}  // namespace skybake::config
