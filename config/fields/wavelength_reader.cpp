#include "config/fields/wavelength_reader.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "config/fields/number_reader.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

constexpr std::array best_3 = {451.0, 541.0, 618.0};
constexpr std::array best_4 = {446.0, 525.0, 576.0, 637.0};
constexpr std::array best_8 = {410.0, 438.0, 465.0, 502.0, 543.0, 582.0, 620.0, 662.0};
constexpr std::array best_16 = {395.0, 409.0, 424.0, 440.0, 455.0, 470.0, 488.0, 508.0,
                                528.0, 549.0, 570.0, 591.0, 612.0, 634.0, 660.0, 693.0};

constexpr std::string_view best = "best ";

// Reads one end or the step of a range.
std::optional<double> read_part(const Reader& reader, const Value& whole, std::string_view text) {
    Value part = whole;
    part.data = std::string(trim(text));
    return read_number(reader, part);
}

// Reads the step of a range, which is a length above 0.
std::optional<double> read_step(const Reader& reader, const Value& whole, std::string_view text) {
    const auto parsed = parse_quantity(text);
    const Quantity* step = std::get_if<Quantity>(&parsed);
    if (step && step->dimension == Dimension::length && step->value > 0) return step->value;
    reader.error("E0106", whole,
                 fmt::format("`{}` has a step that is no length above 0: {}", reader.path,
                             shorten(trim(text))),
                 "write a range as \"380 nm..780 nm by 5 nm\"");
    return std::nullopt;
}

// Steps may miss the last wavelength by rounding.
constexpr double rounding = 1e-9;

std::optional<FieldValue> read_range(const Reader& reader, const Value& value,
                                     const std::string& text, std::size_t dots) {
    const std::size_t by = text.find(" by ", dots);
    if (by == std::string::npos) {
        reader.error("E0103", value, fmt::format("`{}` has no step: {}", reader.path, text),
                     "write a range as \"380 nm..780 nm by 5 nm\"");
        return std::nullopt;
    }
    const std::string_view all = text;
    const auto first = read_part(reader, value, all.substr(0, dots));
    const auto last = read_part(reader, value, all.substr(dots + 2, by - dots - 2));
    const auto step = read_step(reader, value, all.substr(by + 4));
    if (!first || !last || !step) return std::nullopt;
    const double steps = std::floor((*last - *first) / *step + rounding);
    if (!(steps >= 0 && steps < most_wavelengths)) {
        reader.error("E0108", value,
                     fmt::format("`{}` is a range of no use: {}", reader.path, text),
                     fmt::format("give the shorter wavelength first, and at most {} of them",
                                 most_wavelengths));
        return std::nullopt;
    }
    std::vector<double> wavelengths;
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        // Rounded to a millionth of a nm, so that files say 385 nm and not 385.00000000000006 nm.
        const double nm = std::round((*first + i * *step) * 1e15) / 1e6;
        wavelengths.push_back(nm / 1e9);
    }
    return wavelengths;
}

std::optional<FieldValue> read_best(const Reader& reader, const Value& value,
                                    std::string_view count_text) {
    int count = 0;
    const std::string_view digits = trim(count_text);
    const auto end = digits.data() + digits.size();
    const bool is_number = std::from_chars(digits.data(), end, count).ptr == end;
    const std::span<const double> found = best_wavelengths_nm(is_number ? count : 0);
    if (found.empty()) {
        reader.error("E0104", value, fmt::format("`{}` cannot be {}", reader.path, written(value)),
                     "it is \"best 3\", \"best 4\", \"best 8\" or \"best 16\"");
        return std::nullopt;
    }
    std::vector<double> wavelengths;
    // The double next to the decimal, as parse_quantity gives it: 446e-9 is not 446 * 1e-9.
    for (const double nm : found) wavelengths.push_back(nm / 1e9);
    return wavelengths;
}

}  // namespace

std::span<const double> best_wavelengths_nm(int count) {
    switch (count) {
        case 3:
            return best_3;
        case 4:
            return best_4;
        case 8:
            return best_8;
        case 16:
            return best_16;
        default:
            return {};
    }
}

std::string best_wavelength_counts() { return "3|4|8|16"; }

bool asks_for_best_wavelengths(const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    return text && text->starts_with(best);
}

std::optional<FieldValue> read_wavelengths(const Reader& reader, const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value.data)) {
        if (text->starts_with(best)) {
            return read_best(reader, value, std::string_view(*text).substr(best.size()));
        }
        const std::size_t dots = text->find("..");
        if (dots != std::string::npos) return read_range(reader, value, *text, dots);
    }
    std::optional<std::vector<double>> numbers = read_numbers(reader, value);
    if (!numbers) return std::nullopt;
    if (numbers->empty() || numbers->size() > std::size_t{most_wavelengths}) {
        report_count(reader, value, numbers->size(),
                     fmt::format("expected one wavelength, or up to {}", most_wavelengths));
        return std::nullopt;
    }
    return std::move(*numbers);
}

}  // namespace skybake::config
