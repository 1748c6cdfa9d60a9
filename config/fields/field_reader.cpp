#include "config/fields/field_reader.h"

#include <fmt/format.h>

#include "config/diagnostics/toml_source.h"
#include "config/fields/cloud_value_reader.h"
#include "config/fields/noise_value_reader.h"
#include "config/fields/number_reader.h"
#include "config/fields/table_reader.h"
#include "config/text/suggest.h"

namespace skybake::config {
namespace {

std::optional<FieldValue> read_wavelengths(const Reader& reader, const Value& value) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    if (numbers->size() != 1 && numbers->size() != 3) {
        report_count(reader, value, numbers->size(), "expected one wavelength, or three");
        return std::nullopt;
    }
    return std::move(*numbers);
}

std::optional<FieldValue> read_angles(const Reader& reader, const Value& value) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    if (numbers->empty() || numbers->size() > std::size_t{most_angles}) {
        report_count(reader, value, numbers->size(),
                     fmt::format("expected one angle, or up to {}", most_angles));
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
        const std::string label =
            count > 1 ? fmt::format("expected one value, or {}: one per wavelength", count)
                      : "expected one value";
        report_count(reader, value, numbers->size(), label);
        return std::nullopt;
    }
    if (numbers->size() == 1) numbers->resize(count, numbers->front());
    return std::move(*numbers);
}

// As many whole numbers as `Count` says; `label` names them.
template <std::size_t Count>
std::optional<FieldValue> read_size(const Reader& reader, const Value& value, std::string label) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array) {
        report_type(reader, value, describe_kind(reader.field.kind));
        return std::nullopt;
    }
    if (array->size() != Count) {
        report_count(reader, value, array->size(), std::move(label));
        return std::nullopt;
    }
    std::array<int, Count> size{};
    bool valid = true;
    for (std::size_t i = 0; i < Count; ++i) {
        const std::optional<double> number = read_integer(reader, (*array)[i]);
        valid = valid && number;
        if (number) size[i] = static_cast<int>(*number);
    }
    if (!valid) return std::nullopt;
    return size;
}

std::optional<ChoiceIndex> read_choice(const Reader& reader, const Value& value) {
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

// The choice of `item` joins those of the list, unless it is there already.
bool add_choice(const Reader& reader, const Value& item, std::vector<ChoiceIndex>& choices) {
    const std::optional<ChoiceIndex> choice = read_choice(reader, item);
    if (!choice) return false;
    for (const ChoiceIndex earlier : choices) {
        if (earlier.index != choice->index) continue;
        reader.error("E0108", item, fmt::format("`{}` names {} twice", reader.path, written(item)),
                     "name it once");
        return false;
    }
    choices.push_back(*choice);
    return true;
}

std::optional<FieldValue> read_choice_list(const Reader& reader, const Value& value) {
    std::vector<ChoiceIndex> choices;
    bool valid = true;
    if (const auto* array = std::get_if<Array>(&value.data)) {
        for (const Value& item : *array) valid = add_choice(reader, item, choices) && valid;
        if (array->empty()) {
            report_count(reader, value, 0,
                         fmt::format("expected at least {}", describe_choices(reader.field)));
            valid = false;
        }
    } else {
        valid = add_choice(reader, value, choices);
    }
    if (!valid) return std::nullopt;
    return choices;
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

// Lists of texts; a list of texts alone is one group.
std::optional<FieldValue> read_path_groups(const Reader& reader, const Value& value) {
    using Texts = std::vector<std::string>;
    const auto* array = std::get_if<Array>(&value.data);
    const bool nested = array && !array->empty() && std::holds_alternative<Array>((*array)[0].data);
    std::vector<Texts> groups;
    for (const Value& item : nested ? *array : Array{value}) {
        const std::optional<FieldValue> texts = read_text_list(reader, item);
        if (!texts) return std::nullopt;
        groups.push_back(std::get<Texts>(*texts));
    }
    return groups;
}

// As it is spelled: what it means is for the key that varies to say.
std::optional<FieldValue> read_swept(const Reader& reader, const Value& value) {
    const bool is_number = std::holds_alternative<std::int64_t>(value.data) ||
                           std::holds_alternative<double>(value.data);
    if (is_number || std::holds_alternative<std::string>(value.data)) return spell_value(value);
    report_type(reader, value, describe_kind(Kind::swept));
    return std::nullopt;
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
        case Kind::angle:
        case Kind::coefficient:
        case Kind::number_density:
            return as_field_value(read_number(reader, value));
        case Kind::text:
            return read_text(reader, value);
        case Kind::text_list:
            return read_text_list(reader, value);
        case Kind::choice:
            return as_field_value(read_choice(reader, value));
        case Kind::choice_list:
            return read_choice_list(reader, value);
        case Kind::wavelengths:
            return read_wavelengths(reader, value);
        case Kind::coefficients:
        case Kind::fractions:
            return read_channels(reader, value, channels);
        case Kind::size:
            return read_size<2>(reader, value, "expected two whole numbers, width and height");
        case Kind::voxels:
            return read_size<3>(reader, value, "expected three whole numbers, along x, y and z");
        case Kind::density_table:
            return as_field_value(read_density_table(reader, value));
        case Kind::height_table:
            return as_field_value(read_height_table(reader, value));
        case Kind::seed:
            return as_field_value(read_seed(reader, value));
        case Kind::frequency:
            return as_field_value(read_frequency(reader, value));
        case Kind::frequencies:
            return as_field_value(read_frequencies(reader, value));
        case Kind::gains:
            return as_field_value(read_gains(reader, value));
        case Kind::remap:
            return as_field_value(read_remap(reader, value));
        case Kind::edges:
            return as_field_value(read_edges(reader, value));
        case Kind::clamp:
            return as_field_value(read_clamp(reader, value));
        case Kind::levels:
            return as_field_value(read_levels(reader, value));
        case Kind::lengths:
            return as_field_value(read_lengths(reader, value));
        case Kind::pair:
            return as_field_value(read_pair(reader, value));
        case Kind::bounds:
        case Kind::length_bounds:
        case Kind::angle_bounds:
            return as_field_value(read_bounds(reader, value));
        case Kind::angles:
            return read_angles(reader, value);
        case Kind::power_of_two:
            return as_field_value(read_power_of_two(reader, value));
        case Kind::path_groups:
            return read_path_groups(reader, value);
        case Kind::swept:
            return read_swept(reader, value);
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
