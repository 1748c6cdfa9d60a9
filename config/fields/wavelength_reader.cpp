#include "config/fields/wavelength_reader.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "config/fields/number_reader.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

// These are minima of
//
//   sum over airs of (median / bar)^2 + (ninth decile / bar)^2 + (largest error of the disc / bar)^2
//
// where the errors are those of ColorSkies (bakers/light/sky_colors.h): colours of skies under suns
// from 60 to -5 degrees, and of the sun's disc at 5 and 1 degrees, by weights that are fitted to
// other suns of the same air. The bars are 0.5, 1.5 and 2 % of four, 0.1, 0.3 and 0.5 % of eight, and
// 0.01, 0.05 and 0.1 % of sixteen. The airs of the search were the preset earth, the preset
// earth_clear_mountain, earth with ozone of 150 DU, and earth with haze of optical depth 0.4, Angstrom
// exponent 1 and single-scattering albedo 0.9 over a ground of albedo 0.3, in which the sun counts at 5
// degrees alone. It went down by steps of 8, 4, 2 and 1 nm in each wavelength, from random beginnings
// around the best one so far. The sets of 3, 8 and 16 come from earlier searches of the same kind, on air
// that falls off exponentially.
constexpr std::array best_3 = {451.0, 541.0, 618.0};
constexpr std::array best_4 = {446.0, 524.0, 577.0, 642.0};
constexpr std::array best_8 = {427.0, 467.0, 520.0, 532.0, 565.0, 580.0, 616.0, 665.0};
constexpr std::array best_16 = {395.0, 400.0, 428.0, 454.0, 463.0, 482.0, 488.0, 520.0,
                                530.0, 546.0, 576.0, 591.0, 612.0, 640.0, 663.0, 681.0};

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
    // The double next to the decimal, as parse_quantity gives it: 445e-9 need not be 445 * 1e-9.
    for (const double nm : found) wavelengths.push_back(nm / 1e9);
    return wavelengths;
}

}  // namespace

std::span<const double> best_wavelengths_nm(int count) {
    if (count == 3) return best_3;
    if (count == 4) return best_4;
    if (count == 8) return best_8;
    if (count == 16) return best_16;
    return {};
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
    return read_one_or_more(reader, value, "wavelength");
}

}  // namespace skybake::config
