#include "config/sweep/sweep_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "config/diagnostics/toml_source.h"
#include "config/fields/field_reader.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

constexpr int digits = 12;

// These bounds on the ends are wider than any key's range, so that nothing below overflows.
constexpr double largest_end = 1e100;
constexpr double smallest_log_end = 1e-100;
constexpr double largest_whole_end =
    9007199254740992.0;  // 2^53: doubles have all integers up to it

std::string_view base_unit(Dimension dimension) {
    // In the order of the enumerators.
    static constexpr std::string_view units[] = {"", "", "m", "/m", "/m3", "Pa", "/m2", "rad"};
    return units[static_cast<std::size_t>(dimension)];
}

double as_number(const Value& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
        return static_cast<double>(*integer);
    }
    const auto* number = std::get_if<double>(&value.data);
    return number ? *number : 0;
}

WrittenQuantity as_written(const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    const auto quantity = text ? split_quantity(*text) : std::nullopt;
    return quantity.value_or(WrittenQuantity{as_number(value), ""});
}

Quantity in_base_units(const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (text) {
        const auto parsed = parse_quantity(*text);
        if (const auto* quantity = std::get_if<Quantity>(&parsed)) return *quantity;
    }
    return {as_number(value), Dimension::number};
}

// Sets both ends in the unit that they share, else in the base unit.
void set_ends(const Value& from, const Value& to, SweptRange& range) {
    range.first = sweep_value(from);
    range.last = sweep_value(to);
    const WrittenQuantity first = as_written(from);
    const WrittenQuantity last = as_written(to);
    range.from = first.number;
    range.to = last.number;
    range.unit = first.unit;
    if (first.unit == last.unit) return;
    range.from = in_base_units(from).value;
    range.to = in_base_units(to).value;
    range.unit = base_unit(in_base_units(from).dimension);
}

// Returns the power of ten of a number's first digit.
int leading_power(double value) {
    const std::string text = fmt::format("{:.{}e}", std::fabs(value), digits - 1);
    std::string_view exponent = std::string_view(text).substr(text.find('e') + 1);
    if (exponent.front() == '+') exponent.remove_prefix(1);
    int power = 0;
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
    return power;
}

// Rounds to `digits` significant digits of `scale`.
double round_to_digits(double value, double scale) {
    const int decimals = std::max(0, digits - 1 - leading_power(scale));
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded + 0.0;  // -0 becomes 0
}

// Returns base^exponent for an exponent in [0, 1], computed from the exponent's binary digits by
// repeated square roots. The error is at most about 80 units in the last place, and the bits are
// the same on every machine.
double root_power(double base, double exponent) {
    double power = 1;
    double root = base;
    for (int bit = 0; bit < 53 && exponent > 0; ++bit) {
        if (exponent >= 1) {
            power *= root;
            exponent -= 1;
        }
        root = std::sqrt(root);
        exponent *= 2;
    }
    return power;
}

double value_between(const SweptRange& range, double share) {
    if (range.log) {
        const double value = range.from * root_power(range.to / range.from, share);
        return round_to_digits(value, value);
    }
    const double value = range.from * (1 - share) + range.to * share;
    return round_to_digits(value, std::max(std::fabs(range.from), std::fabs(range.to)));
}

double evenly_spaced(const SweptRange& range, int index, int count) {
    const int last = count - 1;
    if (range.log) return value_between(range, double(index) / last);
    // The products below are exact for short decimals more often than shares would be.
    const double value = (range.from * (last - index) + range.to * index) / last;
    return round_to_digits(value, std::max(std::fabs(range.from), std::fabs(range.to)));
}

SweepValue spelled(const SweptRange& range, double number) {
    if (range.whole) {
        const std::string text = fmt::format("{:.0f}", number);
        return {text, text};
    }
    const std::string text = number_to_string(number);
    if (range.unit.empty()) return {text, text};
    const std::string quantity = text + ' ' + range.unit;
    return {toml_string(quantity), quantity};
}

bool check_ends(const SweptRange& range, const Value& from, const Value& to,
                const std::string& path, Decoder& decoder) {
    const auto refuse = [&](const Value& at, std::string message, std::string label) {
        decoder.diagnostics.error("E0135", at.place, std::move(message), std::move(label));
        return false;
    };
    const double largest = std::max(std::fabs(range.from), std::fabs(range.to));
    const double most = range.whole ? largest_whole_end : largest_end;
    if (!std::isfinite(range.from) || !std::isfinite(range.to) || largest > most) {
        return refuse(
            to, fmt::format("the range of `{}` goes too far", path),
            fmt::format("at most {} are allowed; list the values instead", number_to_string(most)));
    }
    if (range.from == range.to) {
        return refuse(to, fmt::format("the range of `{}` ends where it begins", path),
                      "give `to` another value, or list the one value: [...]");
    }
    if (range.log && !(std::min(range.from, range.to) >= smallest_log_end)) {
        return refuse(from, fmt::format("the log range of `{}` is not above 0", path),
                      "from and to must be above 0 where scale = \"log\"");
    }
    return true;
}

}  // namespace

SweepValue sweep_value(const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    return {value_to_string(value), text ? *text : value_to_string(value)};
}

bool check_form(const Field& field, const std::string& path, const Value& value, Decoder& decoder) {
    constexpr std::array form_codes = {"E0103", "E0104", "E0106", "E0107", "E0108"};
    DiagnosticList found;
    read_field(field, path, value, decoder.channels, found);
    const std::vector<Diagnostic> diagnostics = found.take();
    const bool at_fault = std::ranges::any_of(diagnostics, [&](const auto& one) {
        return std::ranges::find(form_codes, one.code) != form_codes.end();
    });
    if (at_fault) read_field(field, path, value, decoder.channels, decoder.diagnostics);
    return !at_fault;
}

std::optional<SweptRange> read_range(const Field& field, const std::string& path,
                                     const Entry& entry, Decoder& decoder) {
    if (field.kind.swept == RangeOver::nothing) {
        decoder.diagnostics.error("E0135", entry.key_place,
                                  fmt::format("`{}` cannot vary over a range", path),
                                  fmt::format("list its values, each {}", field.kind.words));
        return std::nullopt;
    }
    const Table& keys = *as_table(entry.value);
    const DecodedSection section =
        decode_section(*find_section("sweep.*"), join_path("sweep", path), entry.key_place, keys,
                       Absent::filled_in, decoder);
    const bool has_unknown_keys = std::ranges::any_of(
        keys, [&](const Entry& key) { return !find_field(*find_section("sweep.*"), key.key); });
    const DecodedField& from = section.at("from");
    const DecodedField& to = section.at("to");
    const auto scale = choice_of<SweepScale>(section.at("scale"));
    const std::optional<int> count = section.whole("count");
    const bool count_at_fault = section.gives("count") && !count;
    if (!from.value || !to.value || !scale || count_at_fault || has_unknown_keys) {
        return std::nullopt;
    }
    const bool from_fits = check_form(field, path, *from.source, decoder);
    const bool to_fits = check_form(field, path, *to.source, decoder);
    if (!from_fits || !to_fits) return std::nullopt;
    SweptRange range;
    set_ends(*from.source, *to.source, range);
    range.whole = field.kind.swept == RangeOver::wholes;
    range.log = scale == SweepScale::log;
    range.count = count;
    if (!check_ends(range, *from.source, *to.source, path, decoder)) return std::nullopt;
    return range;
}

std::optional<std::vector<SweepValue>> range_values(const SweptRange& range,
                                                    const std::string& path, const Entry& entry,
                                                    Decoder& decoder) {
    std::vector<SweepValue> values = {range.first};
    for (int i = 1; i + 1 < *range.count; ++i) {
        const double number = evenly_spaced(range, i, *range.count);
        if (range.whole && number != std::floor(number)) {
            decoder.diagnostics.error("E0135", entry.value.place,
                                      fmt::format("`{}` takes whole numbers, and {} is not one",
                                                  path, number_to_string(number)),
                                      fmt::format("choose a count that divides the range from {} "
                                                  "to {} into whole steps, or list the values",
                                                  range.first.plain, range.last.plain));
            return std::nullopt;
        }
        values.push_back(spelled(range, number));
    }
    values.push_back(range.last);
    return values;
}

SweepValue value_at_share(const SweptRange& range, double share) {
    if (!range.whole) return share == 0 ? range.first : spelled(range, value_between(range, share));
    // The range ends one above the greatest number, so that this number has its share too.
    const double low = std::min(range.from, range.to);
    const double high = std::max(range.from, range.to);
    const double upward = range.from < range.to ? share : 1 - share;
    const double number =
        range.log ? low * root_power((high + 1) / low, upward) : low + upward * (high + 1 - low);
    return spelled(range, std::min(std::floor(number), high));
}

}  // namespace skybake::config
