#include "config/fields/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "config/text/units.h"

namespace skybake::config {
namespace {

std::string spell_bound(const Field& field, double value) {
    switch (field.kind) {
        case Kind::length:
        case Kind::lengths:
        case Kind::length_bounds:
            return spell_length(value);
        case Kind::wavelengths:
            return spell_wavelength(value);
        case Kind::coefficient:
        case Kind::coefficients:
            return spell_inverse_length(value);
        case Kind::number_density:
            return spell_number_density(value);
        case Kind::angle:
        case Kind::angles:
        case Kind::angle_bounds:
            return fmt::format("{:.6g} deg", value * (180 / std::numbers::pi));
        default:
            return spell_number(value);
    }
}

bool has_range(Kind kind) {
    switch (kind) {
        case Kind::flag:
        case Kind::text:
        case Kind::text_list:
        case Kind::choice:
        case Kind::choice_list:
        case Kind::seed:
        case Kind::path_groups:
        case Kind::swept:
            return false;
        default:
            return true;
    }
}

}  // namespace

const Field* find_field(const Section& section, std::string_view key) {
    for (const Field& field : section.fields) {
        if (field.key == key) return &field;
    }
    return nullptr;
}

std::vector<std::string_view> field_keys(const Section& section) {
    std::vector<std::string_view> keys;
    for (const Field& field : section.fields) keys.push_back(field.key);
    return keys;
}

std::vector<std::string_view> choice_names(const Field& field) {
    std::vector<std::string_view> names;
    for (const Choice& choice : field.choices) names.push_back(choice.name);
    return names;
}

std::vector<std::string_view> path_names(const Section& section) {
    std::vector<std::string_view> names;
    std::string_view rest = section.path;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('.'), rest.size());
        names.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
}

bool applies(const Field& field, std::string_view selector_value) {
    if (field.selector.empty()) return true;
    for (const std::string_view value : field.selected_by) {
        if (value == selector_value) return true;
    }
    return false;
}

bool exclude_each_other(const Field& field, const Field& other) {
    const bool same_group =
        !field.exclusive_group.empty() && field.exclusive_group == other.exclusive_group;
    const bool same_side =
        !field.exclusive_side.empty() && field.exclusive_side == other.exclusive_side;
    return same_group && !same_side && field.key != other.key;
}

std::string describe_range(const Field& field) {
    if (!has_range(field.kind)) return "";
    const Range& range = field.range;
    if (range.minimum == range.maximum) return spell_bound(field, range.minimum);
    return std::string(range.or_zero ? "0 or in " : "in ") + (range.open_minimum ? "(" : "[") +
           spell_bound(field, range.minimum) + ", " + spell_bound(field, range.maximum) +
           (range.open_maximum ? ")" : "]");
}

std::string describe_choices(const Field& field) {
    std::string text;
    for (const Choice& choice : field.choices) {
        if (!text.empty()) text += ", ";
        text += '`' + std::string(choice.name) + '`';
    }
    return text.empty() ? "" : "one of " + text;
}

std::string describe_field(const Field& field) {
    std::string text(field.documentation);
    if (!field.choices.empty()) text += "; " + describe_choices(field);
    if (field.range.minimum < field.range.maximum) text += "; " + describe_range(field);
    if (!field.hint.empty()) text += "; " + std::string(field.hint);
    return text;
}

std::string_view describe_kind(Kind kind) {
    switch (kind) {
        case Kind::flag:
            return "true or false";
        case Kind::integer:
            return "a whole number";
        case Kind::number:
            return "a number without a unit";
        case Kind::fraction:
            return "a fraction, such as 0.002 or \"0.2 %\"";
        case Kind::text:
            return "a string in quotes";
        case Kind::text_list:
            return "a list of strings";
        case Kind::choice:
            return "a name in quotes";
        case Kind::length:
            return "a length with a unit, such as \"8 km\"";
        case Kind::wavelengths:
            return "a list of wavelengths, such as [\"680 nm\", \"550 nm\", \"440 nm\"]";
        case Kind::coefficients:
            return "a coefficient with a unit, such as \"4e-6 /m\", or a list of one per channel";
        case Kind::fractions:
            return "a fraction, such as 0.3 or \"30 %\", or a list of one per channel";
        case Kind::size:
            return "two whole numbers, such as [256, 64]";
        case Kind::density_table:
            return "a list of pairs, such as [[\"0 km\", 1.0], [\"10 km\", 0.5]]";
        case Kind::choice_list:
            return "a name in quotes, or a list of them";
        case Kind::voxels:
            return "three whole numbers, such as [128, 128, 128]";
        case Kind::seed:
            return "a whole number from 0 up, above 2^63 - 1 in quotes: \"0xffffffffffffffff\"";
        case Kind::frequency:
            return "a whole number, such as 4, or one per axis: [4, 4, 8]";
        case Kind::frequencies:
            return "a list of one frequency per octave, such as [8, 32, 56]";
        case Kind::gains:
            return "a list of one number per octave, such as [0.625, 0.25, 0.125]";
        case Kind::remap:
            return "four numbers, [in_low, in_high, out_low, out_high]";
        case Kind::edges:
            return "two numbers, the first below the second, such as [0.8, 1.4]";
        case Kind::clamp:
            return "true, false or two numbers, the lower one first, such as [0, 1]";
        case Kind::levels:
            return "a whole number, or \"all\"";
        case Kind::angle:
            return "an angle with a unit, such as \"30 deg\"";
        case Kind::angles:
            return "a list of angles, such as [\"30 deg\", \"5 deg\"]";
        case Kind::angle_bounds:
            return "two angles, the lower one first, such as [\"-10 deg\", \"90 deg\"]";
        case Kind::length_bounds:
            return "two lengths, the smaller one first, such as [\"0 km\", \"3 km\"]";
        case Kind::coefficient:
            return "a coefficient with a unit, such as \"40 /km\"";
        case Kind::number_density:
            return "a number per volume, such as \"300 /cm3\"";
        case Kind::lengths:
            return "three lengths, such as [\"6 km\", \"6 km\", \"1.5 km\"]";
        case Kind::pair:
            return "two numbers, such as [0.2, 0.35]";
        case Kind::bounds:
            return "two numbers, the lower one first, such as [0.02, 0.05]";
        case Kind::height_table:
            return "a list of pairs, such as [[0, 0.0], [0.2, 1.0], [1, 0.0]]";
        case Kind::power_of_two:
            return "a power of two, such as 4";
        case Kind::path_groups:
            return "a list of paths in quotes, or a list of such lists";
        case Kind::swept:
            return "one number, or a quantity in quotes";
    }
    return "";
}

}  // namespace skybake::config
