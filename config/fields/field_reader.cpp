#include "config/fields/field_reader.h"

#include <fmt/format.h>

#include "config/diagnostics/toml_source.h"
#include "config/fields/number_reader.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

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

// Adds the choice of `item` to the list, unless it is there already.
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

}  // namespace

std::optional<FieldValue> read_flag(const Reader& reader, const Value& value) {
    if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
    report_type(reader, value, reader.field.kind.words);
    return std::nullopt;
}

std::optional<FieldValue> read_whole(const Reader& reader, const Value& value) {
    return read_integer(reader, value);
}

std::optional<FieldValue> read_quantity(const Reader& reader, const Value& value) {
    return read_number(reader, value);
}

std::optional<FieldValue> read_one_choice(const Reader& reader, const Value& value) {
    return read_choice(reader, value);
}

std::optional<FieldValue> read_angles(const Reader& reader, const Value& value) {
    return read_one_or_more(reader, value, "angle");
}

std::optional<FieldValue> read_channels(const Reader& reader, const Value& value) {
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    const std::size_t count =
        reader.channels ? static_cast<std::size_t>(*reader.channels) : numbers->size();
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

std::optional<FieldValue> read_choice_list(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    std::vector<ChoiceIndex> choices;
    bool valid = true;
    for (const Value& item : array ? *array : Array{value}) {
        valid = add_choice(reader, item, choices) && valid;
    }
    if (array && array->empty()) {
        report_count(reader, value, 0,
                     fmt::format("expected at least {}", describe_choices(reader.field)));
        return std::nullopt;
    }
    if (!valid) return std::nullopt;
    return choices;
}

std::optional<FieldValue> read_text(const Reader& reader, const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
    report_type(reader, value, Kind::text.words);
    return std::nullopt;
}

std::optional<FieldValue> read_text_list(const Reader& reader, const Value& value) {
    const auto* array = std::get_if<Array>(&value.data);
    std::vector<std::string> texts;
    for (const Value& item : array ? *array : Array{value}) {
        const auto* text = std::get_if<std::string>(&item.data);
        if (!text) {
            report_type(reader, value, Kind::text_list.words);
            return std::nullopt;
        }
        texts.push_back(*text);
    }
    return texts;
}

// Reads lists of texts. A plain list of texts counts as one group.
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

// Reads the value as it is spelled. The key that varies gives it its meaning.
std::optional<FieldValue> read_swept(const Reader& reader, const Value& value) {
    const bool is_number = std::holds_alternative<std::int64_t>(value.data) ||
                           std::holds_alternative<double>(value.data);
    if (is_number || std::holds_alternative<std::string>(value.data)) return value_to_string(value);
    report_type(reader, value, Kind::swept.words);
    return std::nullopt;
}

std::optional<FieldValue> read_field(const Field& field, std::string_view path, const Value& value,
                                     std::optional<int> channels, DiagnosticList& diagnostics) {
    return field.kind.read({field, path, diagnostics, channels}, value);
}

std::optional<FieldValue> default_value(const Field& field, std::optional<int> channels) {
    if (field.fallback.empty()) return std::nullopt;
    const std::optional<Value> value = parse_toml_value(field.fallback);
    if (!value) return std::nullopt;
    DiagnosticList none_expected;
    return read_field(field, field.key, *value, channels, none_expected);
}

}  // namespace skybake::config
