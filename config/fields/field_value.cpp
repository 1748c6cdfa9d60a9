#include "config/fields/field_value.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "config/fields/fields.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

template <class T, class ItemText>
std::string list_to_string(const std::vector<T>& items, ItemText item_text) {
    std::string text = "[";
    for (const T& item : items) {
        if (text.size() > 1) text += ", ";
        text += item_text(item);
    }
    return text + "]";
}

// Spells one number if it is the same on all axes, else one per axis.
std::string frequency_to_string(const std::array<int, 3>& frequency) {
    const bool isotropic = frequency[0] == frequency[1] && frequency[1] == frequency[2];
    return isotropic ? fmt::format("{}", frequency[0])
                     : fmt::format("[{}, {}, {}]", frequency[0], frequency[1], frequency[2]);
}

// Spells a seed. TOML's integers end at 2^63 - 1, so a larger seed is written as text.
std::string seed_to_string(std::uint64_t seed) {
    const bool is_toml_integer = seed <= std::uint64_t{std::numeric_limits<std::int64_t>::max()};
    return is_toml_integer ? fmt::format("{}", seed) : fmt::format("\"{}\"", seed);
}

std::string quoted_length(double meters) { return toml_string(length_to_string(meters)); }

// Spells one number. A number with a unit is written as text.
std::string one_to_string(const ValueKind& kind, double value) {
    const Scale& scale = kind.scale ? *kind.scale : Scales::plain;
    const bool bare =
        scale.dimension == Dimension::number || scale.dimension == Dimension::fraction;
    return bare ? scale.to_string(value) : toml_string(scale.to_string(value));
}

// Returns the text of each alternative of a FieldValue.
struct ToText {
    const Field& field;

    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(double number) const { return one_to_string(field.kind, number); }
    std::string operator()(const std::vector<double>& numbers) const {
        return list_to_string(numbers,
                              [&](double number) { return one_to_string(field.kind, number); });
    }
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(const std::vector<std::string>& texts) const {
        return list_to_string(texts, [](const std::string& text) { return toml_string(text); });
    }
    std::string operator()(const std::vector<std::vector<std::string>>& groups) const {
        return list_to_string(groups, *this);
    }
    std::string operator()(const std::array<int, 2>& size) const {
        return fmt::format("[{}, {}]", size[0], size[1]);
    }
    std::string operator()(const std::array<int, 3>& numbers) const {
        if (field.kind.one_for_all_axes) return frequency_to_string(numbers);
        return fmt::format("[{}, {}, {}]", numbers[0], numbers[1], numbers[2]);
    }
    std::string operator()(const std::vector<std::array<int, 3>>& frequencies) const {
        return list_to_string(frequencies, frequency_to_string);
    }
    template <std::size_t count>
    std::string operator()(const std::array<double, count>& numbers) const {
        if (std::isinf(numbers[0])) return "false";  // no bounds
        return (*this)(std::vector<double>(numbers.begin(), numbers.end()));
    }
    std::string operator()(std::uint64_t seed) const { return seed_to_string(seed); }
    std::string operator()(const ChoiceIndex& choice) const {
        return toml_string(field.choices[choice.index].name);
    }
    std::string operator()(const std::vector<ChoiceIndex>& choices) const {
        return list_to_string(choices, *this);
    }
    std::string operator()(const std::vector<DensityPoint>& table) const {
        return list_to_string(table, [](const DensityPoint& point) {
            return fmt::format("[{}, {}]", quoted_length(point.altitude.meters),
                               number_to_string(point.density));
        });
    }
    std::string operator()(const std::vector<IndexPoint>& table) const {
        return list_to_string(table, [](const IndexPoint& point) {
            return fmt::format("[{}, {}, {}]",
                               toml_string(wavelength_to_string(point.wavelength.meters)),
                               number_to_string(point.real), number_to_string(point.imaginary));
        });
    }
    std::string operator()(const std::vector<SpectrumPoint>& spectrum) const {
        return list_to_string(spectrum, [](const SpectrumPoint& point) {
            return fmt::format("[{}, {}]",
                               toml_string(wavelength_to_string(point.wavelength.meters)),
                               number_to_string(point.value));
        });
    }
    std::string operator()(const std::vector<ComponentNumber>& list) const {
        return list_to_string(list, [](const ComponentNumber& one) {
            return fmt::format(
                "[{}, {}]", toml_string(one.component),
                toml_string(number_density_to_string(one.number_density.per_cubic_meter)));
        });
    }
    std::string operator()(const std::vector<HeightPoint>& table) const {
        return list_to_string(table, [](const HeightPoint& point) {
            return fmt::format("[{}, {}]", number_to_string(point.height),
                               number_to_string(point.value));
        });
    }
};

}  // namespace

std::string degrees_to_string(double radians) {
    return fmt::format("{:.6g} deg", radians * (180 / std::numbers::pi));
}

std::string level_count_to_string(double levels) {
    return levels > 0 ? number_to_string(levels) : toml_string("all");
}

std::string canonical_text(const Field& field, const FieldValue& value) {
    return std::visit(ToText{field}, value);
}

std::string origin(const Place& place) {
    if (!place.source) return "";
    if (place.source->kind != Source::Kind::file) return place.source->name;
    return fmt::format("{}:{}", place.source->name, place.line);
}

}  // namespace skybake::config
