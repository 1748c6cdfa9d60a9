#include "config/fields/fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/text.h"

namespace skybake::config {

const Field* find_field(const Section& section, std::string_view key) {
    const auto found = std::ranges::find(section.fields, key, &Field::key);
    return found == section.fields.end() ? nullptr : &*found;
}

std::vector<std::string_view> field_keys(const Section& section) {
    return mapped<std::string_view>(section.fields, &Field::key);
}

std::vector<std::string_view> choice_names(const Field& field) {
    return mapped<std::string_view>(field.choices, &Choice::name);
}

std::vector<std::string_view> path_names(const Section& section) {
    return section.path.empty() ? std::vector<std::string_view>{}
                                : pieces_between(section.path, '.');
}

bool names_fit(std::span<const std::string> names, const Section& section) {
    return std::ranges::equal(names, path_names(section),
                              [](const std::string& name, std::string_view wanted) {
                                  return wanted == "*" || name == wanted;
                              });
}

bool applies(const Field& field, std::string_view selector_value) {
    const Words& values = field.selected_by;
    return field.selector.empty() || std::ranges::find(values, selector_value) != values.end();
}

bool exclude_each_other(const Field& field, const Field& other) {
    const bool same_group =
        !field.exclusive_group.empty() && field.exclusive_group == other.exclusive_group;
    const bool same_side =
        !field.exclusive_side.empty() && field.exclusive_side == other.exclusive_side;
    return same_group && !same_side && field.key != other.key;
}

std::string describe_range(const Field& field) {
    if (!field.kind.scale) return "";
    const auto text = field.kind.scale->bound_to_string;
    const Range& range = field.range;
    if (range.minimum == range.maximum) return text(range.minimum);
    return fmt::format("{}in {}{}, {}{}", range.or_zero ? "0 or " : "",
                       range.open_minimum ? "(" : "[", text(range.minimum), text(range.maximum),
                       range.open_maximum ? ")" : "]");
}

std::string describe_choices(const Field& field) {
    if (field.choices.empty()) return "";
    return fmt::format("one of `{}`", fmt::join(choice_names(field), "`, `"));
}

std::string describe_field(const Field& field) {
    std::string text(field.documentation);
    if (field.range.minimum < field.range.maximum) text += "; " + describe_range(field);
    if (!field.choices.empty())
        text += (field.kind.scale ? "; or " : "; ") + describe_choices(field);
    if (!field.hint.empty()) text += "; " + std::string(field.hint);
    return text;
}

std::string key_of(const ResolvedValue& value) {
    return value.path.substr(value.section.empty() ? 0 : value.section.size() + 1);
}

bool is_read(const ResolvedValue& value, std::span<const Read> reads) {
    return std::ranges::any_of(reads, [&value](const Read& read) {
        if (!read.roles.has(value.role)) return false;
        // The recipe's own section has no name to match.
        if (value.section == read.section) return true;
        return read.section.find('*') != std::string::npos &&
               path_matches(value.section, read.section);
    });
}

}  // namespace skybake::config
