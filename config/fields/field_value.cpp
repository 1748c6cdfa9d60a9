#include "config/fields/field_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "config/fields/fields.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

// Spells a seed. TOML's integers end at 2^63 - 1, so a larger seed is written as text.
std::string seed_to_string(std::uint64_t seed) {
    const bool is_toml_integer = seed <= std::uint64_t{std::numeric_limits<std::int64_t>::max()};
    return is_toml_integer ? fmt::format("{}", seed) : fmt::format("\"{}\"", seed);
}

std::string quoted_wavelength(Length wavelength) {
    return toml_string(wavelength_to_string(wavelength.meters));
}

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
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(const std::array<int, 2>& size) const {
        return fmt::format("[{}, {}]", size[0], size[1]);
    }
    // Spells one number if it is the same on all axes of a kind that takes one for all.
    std::string operator()(const std::array<int, 3>& numbers) const {
        const auto [x, y, z] = numbers;
        if (field.kind.one_for_all_axes && x == y && y == z) return fmt::format("{}", x);
        return fmt::format("[{}, {}, {}]", x, y, z);
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
    std::string operator()(const DensityPoint& point) const {
        return fmt::format("[{}, {}]", toml_string(length_to_string(point.altitude.meters)),
                           number_to_string(point.density));
    }
    std::string operator()(const IndexPoint& point) const {
        return fmt::format("[{}, {}, {}]", quoted_wavelength(point.wavelength),
                           number_to_string(point.real), number_to_string(point.imaginary));
    }
    std::string operator()(const SpectrumPoint& point) const {
        return fmt::format("[{}, {}]", quoted_wavelength(point.wavelength),
                           number_to_string(point.value));
    }
    std::string operator()(const ComponentNumber& one) const {
        const double per_m3 = one.number_density.per_cubic_meter;
        return fmt::format("[{}, {}]", toml_string(one.component),
                           toml_string(number_density_to_string(per_m3)));
    }
    std::string operator()(const HeightPoint& point) const {
        return fmt::format("[{}, {}]", number_to_string(point.height),
                           number_to_string(point.value));
    }
    template <class T>
    std::string operator()(const std::vector<T>& items) const {
        return fmt::format("[{}]", fmt::join(mapped<std::string>(items, *this), ", "));
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
