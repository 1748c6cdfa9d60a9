// This header reads and spells quantities as people write them: "8 km", "5.802e-6 /m", "53 deg",
// "680 nm", "2 %", "0.8".
//
// Reading and spelling do not depend on the locale. They are exact where decimal arithmetic can be:
// a power-of-ten unit is added to the decimal exponent before the one rounding to double, so that
// "8 km" is 8000 and "680 nm" is the double next to 6.8e-7. Base units are metre, 1/m, 1/m3, pascal,
// 1/m2, radian and 1.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace skybake::config {

enum class Dimension {
    number,
    fraction,
    length,
    inverse_length,
    number_density,
    pressure,
    column_density,
    angle
};

struct Quantity {
    double value = 0;                         // finite, in base units; never -0
    Dimension dimension = Dimension::number;  // number: written without a unit; fraction: in %
};

struct QuantityError {
    enum class Kind { not_a_number, unknown_unit, too_large, too_small };
    Kind kind = Kind::not_a_number;
    std::string part;  // the unreadable number or unit
};

// Reads a number, optional blanks and an optional unit. It refuses NaN, infinity, values beyond a
// double's range, and nonzero values that would round to 0.
std::variant<Quantity, QuantityError> parse_quantity(std::string_view text);

// This is a quantity as it is written: its number, and its unit in the same spelling ("" for none).
struct WrittenQuantity {
    double number = 0;
    std::string unit;
};

// Returns none if the text is not a quantity.
std::optional<WrittenQuantity> split_quantity(std::string_view text);

// Returns a dimension's name for messages: "a length", "an angle".
std::string_view dimension_name(Dimension dimension);

// These return a dimension's units sorted by size, such as {"nm", "um", ...}, or an empty list for
// numbers. `unit_spellings` also has the other ways to write them, such as "1/m" for "/m".
std::vector<std::string_view> unit_names(Dimension dimension);
std::vector<std::string_view> unit_spellings(Dimension dimension);

// Returns the unit of which a name differs in nothing but the case or the order of its letters, or none.
// A name with a capital M has none, as mega and milli differ by nine powers of ten.
std::optional<std::string_view> unit_meant(std::string_view name, Dimension dimension);

// These return canonical spellings: the shortest decimal that reads back as the same double, in one
// unit. Equal values have equal spellings. Values must be finite.
std::string number_to_string(double value);                     // "0.8"
std::string length_to_string(double meters);                    // "8000 m"
std::string wavelength_to_string(double meters);                // "680 nm"
std::string inverse_length_to_string(double per_meter);         // "5.802e-06 /m"
std::string number_density_to_string(double per_cubic_meter);   // "1e+08 /m3"
std::string pressure_to_string(double pascals);                 // "101325 Pa"
std::string column_density_to_string(double per_square_meter);  // "8e+22 /m2"
std::string angle_to_string(double radians);                    // "0.925 rad"

}  // namespace skybake::config
