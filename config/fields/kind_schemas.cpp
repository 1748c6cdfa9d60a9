// This file makes the JSON Schemas of the kinds of values.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "config/fields/fields.h"
#include "config/fields/wavelength_reader.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

using Json = nlohmann::ordered_json;

// Describes a number followed by one of a dimension's units, as units.h reads it.
Json quantity(Dimension dimension) {
    const std::string names =
        replaced(fmt::format("{}", fmt::join(unit_spellings(dimension), "|")), {{'^', "\\^"}});
    const std::string number = R"([+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";
    return {{"type", "string"},
            {"pattern", fmt::format("^[ \t]*{}[ \t]*({})[ \t]*$", number, names)}};
}

Json bare_number(const Range& range) {
    Json schema = {{"type", "number"}};
    schema[range.open_minimum ? "exclusiveMinimum" : "minimum"] = range.minimum;
    schema[range.open_maximum ? "exclusiveMaximum" : "maximum"] = range.maximum;
    if (range.or_zero) return {{"anyOf", {{{"const", 0}}, schema}}};
    return schema;
}

Json list_of(const Json& item, int fewest, int most) {
    return {{"type", "array"}, {"items", item}, {"minItems", fewest}, {"maxItems", most}};
}

Json one_or_list(const Json& item, int fewest, int most) {
    return {{"anyOf", {item, list_of(item, fewest, most)}}};
}

Json texts() { return {{"type", "array"}, {"items", {{"type", "string"}}}}; }

// Describes a list of exactly these items.
Json tuple_of(const std::vector<Json>& items) {
    const std::size_t count = items.size();
    return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

Json table_of(const std::vector<Json>& columns, int fewest) {
    return {{"type", "array"}, {"items", tuple_of(columns)}, {"minItems", fewest}};
}

}  // namespace

Json flag_schema(const Field&) { return {{"type", "boolean"}}; }

Json whole_schema(const Field& field) {
    return {{"type", "integer"},
            {"minimum", static_cast<int>(field.range.minimum)},
            {"maximum", static_cast<int>(field.range.maximum)}};
}

Json number_schema(const Field& field) {
    const Dimension dimension = field.kind.scale->dimension;
    if (dimension == Dimension::number) return bare_number(field.range);
    if (dimension != Dimension::fraction) return quantity(dimension);
    return {{"anyOf", {bare_number(field.range), quantity(dimension)}}};
}

Json numbers_schema(const Field& field) {
    return list_of(number_schema(field), field.kind.fewest, field.kind.most);
}

Json one_or_numbers_schema(const Field& field) {
    return one_or_list(number_schema(field), field.kind.fewest, field.kind.most);
}

Json wavelengths_schema(const Field& field) {
    Json schema = one_or_numbers_schema(field);
    const std::string best = "^best (" + best_wavelength_counts() + ")$";
    schema["anyOf"].push_back({{"type", "string"}, {"pattern", best}});
    schema["anyOf"].push_back({{"type", "string"}, {"pattern", "^.+\\.\\..+ by .+$"}});
    return schema;
}

Json wholes_schema(const Field& field) {
    return list_of(whole_schema(field), field.kind.fewest, field.kind.most);
}

Json text_schema(const Field&) { return {{"type", "string"}}; }

Json text_list_schema(const Field& field) { return {{"anyOf", {text_schema(field), texts()}}}; }

Json path_groups_schema(const Field&) {
    return {{"anyOf", {texts(), {{"type", "array"}, {"items", texts()}}}}};
}

Json choice_schema(const Field& field) { return {{"enum", choice_names(field)}}; }

Json choice_list_schema(const Field& field) {
    Json list = list_of(choice_schema(field), 1, static_cast<int>(field.choices.size()));
    list["uniqueItems"] = true;
    return {{"anyOf", {choice_schema(field), list}}};
}

Json frequency_schema(const Field& field) { return one_or_list(whole_schema(field), 3, 3); }

Json frequencies_schema(const Field& field) {
    return list_of(frequency_schema(field), field.kind.fewest, field.kind.most);
}

Json clamp_schema(const Field& field) {
    return {{"anyOf", {flag_schema(field), numbers_schema(field)}}};
}

Json levels_schema(const Field& field) {
    return {{"anyOf", {whole_schema(field), {{"const", "all"}}}}};
}

Json power_of_two_schema(const Field& field) {
    Json powers = Json::array();
    for (int power = 1; power <= field.range.maximum; power *= 2) powers.push_back(power);
    return {{"enum", powers}};
}

Json seed_schema(const Field&) {
    const Json integer = {{"type", "integer"}, {"minimum", 0}};
    const Json text = {{"type", "string"}, {"pattern", "^(0[xX][0-9a-fA-F]+|[0-9]+)$"}};
    return {{"anyOf", {integer, text}}};
}

Json density_table_schema(const Field& field) {
    const Json text = {{"type", "string"}};
    const Json table = table_of({quantity(Dimension::length), bare_number(field.range)}, 2);
    return {{"anyOf", {table, text, tuple_of({text, text})}}};
}

Json height_table_schema(const Field& field) {
    return table_of({bare_number(unit_range), bare_number(field.range)}, 1);
}

Json index_table_schema(const Field& field) {
    const Json number = bare_number(field.range);
    return table_of({quantity(Dimension::length), number, number}, 1);
}

Json components_schema(const Field&) {
    return table_of({{{"type", "string"}}, quantity(Dimension::number_density)}, 1);
}

Json albedo_schema(const Field& field) {
    Json schema = one_or_numbers_schema(field);
    schema["anyOf"].push_back(table_of({quantity(Dimension::length), number_schema(field)}, 2));
    schema["anyOf"].push_back(choice_schema(field));
    return schema;
}

Json swept_schema(const Field&) { return {{"type", {"number", "string"}}}; }

}  // namespace skybake::config
