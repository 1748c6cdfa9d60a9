#include "config/field_value.h"

#include <fmt/format.h>

#include "config/key_path.h"
#include "config/units.h"

namespace skybake::config {
namespace {

template <class T, class Spell>
std::string spell_list(const std::vector<T>& items, Spell spell) {
    std::string text = "[";
    for (const T& item : items) {
        if (text.size() > 1) text += ", ";
        text += spell(item);
    }
    return text + "]";
}

std::string quoted_length(double meters) { return toml_string(spell_length(meters)); }

std::string spell_one(Kind kind, double value) {
    switch (kind) {
        case Kind::length:
            return quoted_length(value);
        case Kind::wavelengths:
            return toml_string(spell_wavelength(value));
        case Kind::coefficients:
            return toml_string(spell_inverse_length(value));
        default:
            return spell_number(value);
    }
}

// Spells each alternative of a FieldValue.
struct Speller {
    const Field& field;

    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(double number) const { return spell_one(field.kind, number); }
    std::string operator()(const std::vector<double>& numbers) const {
        return spell_list(numbers, [&](double number) { return spell_one(field.kind, number); });
    }
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(const std::vector<std::string>& texts) const {
        return spell_list(texts, [](const std::string& text) { return toml_string(text); });
    }
    std::string operator()(const std::array<int, 2>& size) const {
        return fmt::format("[{}, {}]", size[0], size[1]);
    }
    std::string operator()(const ChoiceIndex& choice) const {
        return toml_string(field.choices[choice.index].name);
    }
    std::string operator()(const std::vector<DensityPoint>& table) const {
        return spell_list(table, [](const DensityPoint& point) {
            return fmt::format("[{}, {}]", quoted_length(point.altitude.meters),
                               spell_number(point.density));
        });
    }
};

}  // namespace

std::string canonical_text(const Field& field, const FieldValue& value) {
    return std::visit(Speller{field}, value);
}

std::string origin(const Place& place) {
    if (!place.source) return "";
    if (place.source->kind != Source::Kind::file) return place.source->name;
    return fmt::format("{}:{}", place.source->name, place.line);
}

}  // namespace skybake::config
