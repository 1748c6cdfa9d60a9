#include "config/text/units.h"
#include "config/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <system_error>

namespace skybake::config {
namespace {

// Each unit is a power of ten of its base unit, except the degree and Dobson's unit. Other spellings
// of a unit are read but not listed.
struct Unit {
    std::string_view name;
    Dimension dimension;
    int power_of_ten;
    bool listed = true;
    double factor = 1;
};

constexpr bool alias = false;

constexpr std::array units = {
    Unit{"%", Dimension::fraction, -2},
    Unit{"nm", Dimension::length, -9},
    Unit{"um", Dimension::length, -6},
    Unit{"\u00b5m", Dimension::length, -6, alias},  // micro sign
    Unit{"\u03bcm", Dimension::length, -6, alias},  // Greek mu
    Unit{"mm", Dimension::length, -3},
    Unit{"cm", Dimension::length, -2},
    Unit{"m", Dimension::length, 0},
    Unit{"km", Dimension::length, 3},
    Unit{"/m", Dimension::inverse_length, 0},
    Unit{"/km", Dimension::inverse_length, -3},
    Unit{"/Mm", Dimension::inverse_length, -6},  // of aerosol science
    Unit{"1/m", Dimension::inverse_length, 0, alias},
    Unit{"1/km", Dimension::inverse_length, -3, alias},
    Unit{"1/Mm", Dimension::inverse_length, -6, alias},
    Unit{"m^-1", Dimension::inverse_length, 0, alias},
    Unit{"km^-1", Dimension::inverse_length, -3, alias},
    Unit{"Mm^-1", Dimension::inverse_length, -6, alias},
    Unit{"m-1", Dimension::inverse_length, 0, alias},
    Unit{"km-1", Dimension::inverse_length, -3, alias},
    Unit{"Mm-1", Dimension::inverse_length, -6, alias},
    Unit{"/m3", Dimension::number_density, 0},
    Unit{"/cm3", Dimension::number_density, 6},
    Unit{"1/m3", Dimension::number_density, 0, alias},
    Unit{"1/cm3", Dimension::number_density, 6, alias},
    Unit{"m^-3", Dimension::number_density, 0, alias},
    Unit{"cm^-3", Dimension::number_density, 6, alias},
    Unit{"m-3", Dimension::number_density, 0, alias},
    Unit{"cm-3", Dimension::number_density, 6, alias},
    Unit{"Pa", Dimension::pressure, 0},
    Unit{"hPa", Dimension::pressure, 2},
    Unit{"kPa", Dimension::pressure, 3},
    Unit{"bar", Dimension::pressure, 5},
    Unit{"mbar", Dimension::pressure, 2, alias},
    Unit{"/m2", Dimension::column_density, 0},
    Unit{"/cm2", Dimension::column_density, 4},
    Unit{"DU", Dimension::column_density, 16, true, 26867},       // of Dobson
    Unit{"atm-cm", Dimension::column_density, 19, alias, 26867},  // a thousand of Dobson's
    Unit{"1/m2", Dimension::column_density, 0, alias},
    Unit{"1/cm2", Dimension::column_density, 4, alias},
    Unit{"m^-2", Dimension::column_density, 0, alias},
    Unit{"cm^-2", Dimension::column_density, 4, alias},
    Unit{"m-2", Dimension::column_density, 0, alias},
    Unit{"cm-2", Dimension::column_density, 4, alias},
    Unit{"deg", Dimension::angle, 0, true, std::numbers::pi / 180},
    Unit{"rad", Dimension::angle, 0},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
    while (at < text.size() && is_digit(text[at])) ++at;
    return at;
}

// These are the parts of `[+-]digits[.digits][e[+-]digits]` at the head of a text.
struct Decimal {
    std::string mantissa;  // without '+'
    std::string exponent;  // without '+'
    std::size_t length = 0;
};

std::optional<Decimal> split_decimal(std::string_view text) {
    std::size_t at = 0;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t whole_end = skip_digits(text, at);
    std::size_t end = whole_end;
    if (end < text.size() && text[end] == '.') end = skip_digits(text, end + 1);
    const std::size_t digits = end - at - (end > whole_end ? 1 : 0);
    if (digits == 0) return std::nullopt;

    Decimal decimal;
    decimal.mantissa = text.substr(text[0] == '+' ? 1 : 0, end - (text[0] == '+' ? 1 : 0));
    decimal.length = end;
    if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
        std::size_t start = end + 1;
        if (start < text.size() && (text[start] == '+' || text[start] == '-')) ++start;
        const std::size_t exponent_end = skip_digits(text, start);
        if (exponent_end > start) {
            const std::size_t first = text[end + 1] == '+' ? end + 2 : end + 1;
            decimal.exponent = text.substr(first, exponent_end - first);
            decimal.length = exponent_end;
        }
    }
    return decimal;
}

// Returns the exponent. One that is too long for a long is replaced by one that no double has.
long exponent_value(const std::string& exponent) {
    if (exponent.empty()) return 0;
    constexpr long beyond = 1'000'000'000;
    long value = 0;
    const auto result = std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
    if (result.ec != std::errc() || std::labs(value) > beyond) {
        return exponent.front() == '-' ? -beyond : beyond;
    }
    return value;
}

// Returns the power of ten of the first digit that is not 0, such as 2 for "345.6" and -2 for
// "0.034", or none for zero.
std::optional<long> leading_power(const std::string& mantissa) {
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string::npos) return std::nullopt;
    return static_cast<long>(point) - static_cast<long>(first) - (first < point ? 1 : 0);
}

std::variant<Quantity, QuantityError> evaluate(const Decimal& decimal, const Unit& unit,
                                               std::string_view written) {
    using Kind = QuantityError::Kind;
    const long exponent = exponent_value(decimal.exponent) + unit.power_of_ten;
    const std::string text = decimal.mantissa + 'e' + std::to_string(exponent);
    const std::optional<long> power = leading_power(decimal.mantissa);
    double value = 0;
    if (power) {
        const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
        if (result.ec == std::errc::result_out_of_range) {  // too large or too small
            const bool large = *power + exponent > 0;
            return QuantityError{large ? Kind::too_large : Kind::too_small, std::string(written)};
        }
        if (result.ec != std::errc()) {
            return QuantityError{Kind::not_a_number, std::string(written)};
        }
    }
    value = value * unit.factor + 0.0;  // -0 becomes 0
    if (!std::isfinite(value)) return QuantityError{Kind::too_large, std::string(written)};
    if (value == 0 && power) return QuantityError{Kind::too_small, std::string(written)};
    return Quantity{value, unit.dimension};
}

// This is a positive finite double as its shortest round-trip digits d1d2d3..., where value =
// 0.d1d2d3... * 10^point.
struct ShortestDigits {
    std::string digits;
    int point = 0;
};

ShortestDigits shortest_digits(double value) {
    std::array<char, 64> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::scientific)
                         .ptr;
    const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    const std::size_t mark = text.find('e');
    ShortestDigits result;
    for (const char c : text.substr(0, mark)) {
        if (is_digit(c)) result.digits += c;
    }
    std::string_view exponent = text.substr(mark + 1);
    if (exponent.front() == '+') exponent.remove_prefix(1);
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), result.point);
    result.point += 1;
    return result;
}

// Spells the number in plain notation if that is short, else in scientific notation with at least
// two exponent digits, as std::to_chars does.
std::string digits_to_string(const ShortestDigits& number) {
    const int count = static_cast<int>(number.digits.size());
    const int point = number.point;
    if (point > 0 && point <= 9) {
        if (count <= point) {
            return number.digits + std::string(static_cast<std::size_t>(point - count), '0');
        }
        const auto split = static_cast<std::size_t>(point);
        return number.digits.substr(0, split) + '.' + number.digits.substr(split);
    }
    if (point <= 0 && point > -4) {
        return fmt::format("0.{}{}", std::string(static_cast<std::size_t>(-point), '0'),
                           number.digits);
    }
    const int exponent = point - 1;
    std::string text = number.digits.substr(0, 1);
    if (count > 1) text += '.' + number.digits.substr(1);
    const std::string size = std::to_string(std::abs(exponent));
    return text + (exponent < 0 ? "e-" : "e+") + (size.size() < 2 ? "0" : "") + size;
}

// Spells `value` times 10^shift by moving the point, so there is no second rounding.
std::string shifted_to_string(double value, int shift) {
    if (value == 0) return "0";
    ShortestDigits number = shortest_digits(std::fabs(value));
    number.point += shift;
    return fmt::format("{}{}", value < 0 ? "-" : "", digits_to_string(number));
}

// Letters in lower case, in the order of the alphabet.
std::string letters_of(std::string_view name) {
    std::string letters = lower_case(name);
    std::ranges::sort(letters);
    return letters;
}

}  // namespace

std::variant<Quantity, QuantityError> parse_quantity(std::string_view text) {
    text = trim(text);
    const std::optional<Decimal> decimal = split_decimal(text);
    if (!decimal) return QuantityError{QuantityError::Kind::not_a_number, std::string(text)};
    const std::string_view name = trim(text.substr(decimal->length));
    if (name.empty()) return evaluate(*decimal, Unit{"", Dimension::number, 0}, text);
    for (const Unit& unit : units) {
        if (unit.name == name) return evaluate(*decimal, unit, text);
    }
    return QuantityError{QuantityError::Kind::unknown_unit, std::string(name)};
}

std::optional<WrittenQuantity> split_quantity(std::string_view text) {
    text = trim(text);
    const std::optional<Decimal> decimal = split_decimal(text);
    if (!decimal || !std::holds_alternative<Quantity>(parse_quantity(text))) return std::nullopt;
    const auto number = parse_quantity(text.substr(0, decimal->length));
    const auto* quantity = std::get_if<Quantity>(&number);
    if (!quantity) return std::nullopt;
    return WrittenQuantity{quantity->value, std::string(trim(text.substr(decimal->length)))};
}

std::string_view dimension_name(Dimension dimension) {
    // In the order of the enumerators.
    static constexpr std::string_view names[] = {"a plain number",
                                                 "a fraction",
                                                 "a length",
                                                 "a coefficient (1/length)",
                                                 "a number of particles per volume",
                                                 "a pressure",
                                                 "a number of molecules per area",
                                                 "an angle"};
    return names[static_cast<std::size_t>(dimension)];
}

std::vector<std::string_view> unit_names(Dimension dimension) {
    std::vector<std::string_view> names;
    for (const Unit& unit : units) {
        if (unit.dimension == dimension && unit.listed) names.push_back(unit.name);
    }
    return names;
}

std::vector<std::string_view> unit_spellings(Dimension dimension) {
    std::vector<std::string_view> names;
    for (const Unit& unit : units) {
        if (unit.dimension == dimension) names.push_back(unit.name);
    }
    return names;
}

std::optional<std::string_view> unit_meant(std::string_view name, Dimension dimension) {
    // M is mega, and m is milli: they differ by nine powers of ten.
    if (name.find('M') != std::string_view::npos) return std::nullopt;
    for (const std::string_view unit : unit_spellings(dimension)) {
        if (unit.find('M') == std::string_view::npos && letters_of(unit) == letters_of(name)) {
            return unit;
        }
    }
    return std::nullopt;
}

std::string number_to_string(double value) { return shifted_to_string(value, 0); }

std::string length_to_string(double meters) { return number_to_string(meters) + " m"; }

std::string wavelength_to_string(double meters) { return shifted_to_string(meters, 9) + " nm"; }

std::string inverse_length_to_string(double per_meter) {
    return number_to_string(per_meter) + " /m";
}

std::string number_density_to_string(double per_cubic_meter) {
    return number_to_string(per_cubic_meter) + " /m3";
}

std::string pressure_to_string(double pascals) { return number_to_string(pascals) + " Pa"; }

std::string column_density_to_string(double per_square_meter) {
    return number_to_string(per_square_meter) + " /m2";
}

std::string angle_to_string(double radians) { return number_to_string(radians) + " rad"; }

}  // namespace skybake::config
