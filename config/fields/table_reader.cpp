// This file reads tables of pairs: density over altitude, and a cloud's profile over height.
#include <fmt/format.h>

#include <array>
#include <string>

#include "config/fields/number_reader.h"
#include "config/text/quantity.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

using Pair = std::array<double, 2>;

// This is what differs between the two kinds of tables.
struct Columns {
    Field first;              // key, kind and range of the first column
    std::string_view plural;  // "altitudes"
    std::string_view second;  // "density"
    std::string_view example;
    std::size_t fewest;
    std::string_view too_few;
    std::string (*to_string)(double);
};

// A table begins at the ground, so a negative altitude is a mistake.
constexpr Columns density_columns{
    {.key = "altitude", .kind = Kind::length, .range = {0, 1e12}},
    "altitudes",
    "density",
    "[\"10 km\", 0.5]",
    2,
    "fewer than two entries",
    length_to_string,
};

constexpr Columns height_columns{
    {.key = "height", .kind = Kind::number, .range = {0, 1}},
    "heights",
    "value",
    "[0.2, 1.0]",
    1,
    "no entries",
    number_to_string,
};

std::string pair_words(const Columns& columns) {
    return fmt::format("[{}, {}]", columns.first.key, columns.second);
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
    const Field second_field{
        .key = columns.second, .kind = Kind::number, .range = reader.field.range};
    const auto first =
        read_number(Reader{columns.first, reader.path, reader.diagnostics}, (*pair)[0]);
    const auto second =
        read_number(Reader{second_field, reader.path, reader.diagnostics}, (*pair)[1]);
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

std::optional<std::vector<Pair>> read_table(const Reader& reader, const Columns& columns,
                                            const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) {
        report_type(reader, value, reader.field.kind.words);
        return std::nullopt;
    }
    if (array->size() < columns.fewest) {
        reader.error("E0114", value, fmt::format("`{}` has {}", reader.path, columns.too_few),
                     fmt::format("give at least {} {} pair{}", columns.fewest == 1 ? "one" : "two",
                                 pair_words(columns), columns.fewest == 1 ? "" : "s"));
        return std::nullopt;
    }
    std::vector<Pair> table;
    bool valid = true;
    for (const Value& item : *array) {
        const std::optional<Pair> pair = read_entry(reader, columns, item);
        valid = valid && pair;
        if (!pair) continue;
        const bool increases =
            table.empty() || check_order(reader, columns, item, (*pair)[0], table.back()[0]);
        valid = valid && increases;
        table.push_back(*pair);
    }
    if (!valid) return std::nullopt;
    return table;
}

}  // namespace

std::optional<FieldValue> read_density_table(const Reader& reader, const Value& value) {
    const auto pairs = read_table(reader, density_columns, value);
    if (!pairs) return std::nullopt;
    std::vector<DensityPoint> table;
    for (const Pair& pair : *pairs) table.push_back({{pair[0]}, pair[1]});
    return table;
}

std::optional<FieldValue> read_height_table(const Reader& reader, const Value& value) {
    const auto pairs = read_table(reader, height_columns, value);
    if (!pairs) return std::nullopt;
    std::vector<HeightPoint> table;
    for (const Pair& pair : *pairs) table.push_back({pair[0], pair[1]});
    return table;
}

}  // namespace skybake::config
