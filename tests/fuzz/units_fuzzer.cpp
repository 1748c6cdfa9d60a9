// Quantities: what is read is finite, and its canonical spelling reads back to the same double.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "config/text/units.h"
#include "tests/fuzz/properties.h"

namespace {

using namespace skybake::config;
using fuzzing::require;

std::string to_string(const Quantity& quantity) {
    switch (quantity.dimension) {
        case Dimension::length:
            return length_to_string(quantity.value);
        case Dimension::inverse_length:
            return inverse_length_to_string(quantity.value);
        case Dimension::angle:
            return angle_to_string(quantity.value);
        default:
            return number_to_string(quantity.value);
    }
}

void check_reads_back(const std::string& text, double value) {
    const auto parsed = parse_quantity(text);
    const auto* quantity = std::get_if<Quantity>(&parsed);
    require(quantity != nullptr, "a canonical spelling is a quantity");
    require(quantity->value == value, "and reads back to the same value");
    require(to_string(*quantity) == text || text.ends_with(" nm"), "and is stable");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto parsed = parse_quantity(std::string_view(reinterpret_cast<const char*>(data), size));
    const auto* quantity = std::get_if<Quantity>(&parsed);
    if (!quantity) return 0;
    require(std::isfinite(quantity->value), "finite");
    require(quantity->value != 0 || !std::signbit(quantity->value), "no negative zero");
    check_reads_back(to_string(*quantity), quantity->value);
    if (quantity->dimension == Dimension::length) {
        check_reads_back(wavelength_to_string(quantity->value), quantity->value);
    }
    return 0;
}
