#include "config/diagnostics/toml_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <span>

#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

constexpr int deepest_nesting = 32;

Place place_of(const toml::source_region& region, const Source* source) {
    Place place{source};
    place.line = static_cast<int>(region.begin.line);
    place.column = static_cast<int>(region.begin.column);
    const bool one_line = region.end.line == region.begin.line;
    place.length = one_line ? static_cast<int>(region.end.column) - place.column : 1;
    if (place.length < 1) place.length = 1;
    return place;
}

Value convert(const toml::node& node, const Source* source);

Table convert_table(const toml::table& table, const Source* source) {
    Table result;
    result.reserve(table.size());
    for (auto&& [key, node] : table) {  // sorted by key, because it is a std::map
        result.push_back(
            {std::string(key.str()), place_of(key.source(), source), convert(node, source)});
    }
    return result;
}

Array convert_array(const toml::array& array, const Source* source) {
    Array result;
    result.reserve(array.size());
    for (const toml::node& node : array) result.push_back(convert(node, source));
    return result;
}

Value convert(const toml::node& node, const Source* source) {
    Value value;
    value.place = place_of(node.source(), source);
    if (const auto* table = node.as_table()) {
        value.data = convert_table(*table, source);
    } else if (const auto* array = node.as_array()) {
        value.data = convert_array(*array, source);
    } else if (const auto* text = node.as_string()) {
        value.data = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.data = integer->get();
    } else if (const auto* floating = node.as_floating_point()) {
        value.data = floating->get();
    } else if (const auto* flag = node.as_boolean()) {
        value.data = flag->get();
    }
    return value;
}

// The library's parser is the only code of this folder that throws.
struct Parsed {
    std::optional<toml::table> table;
    std::string error;
    toml::source_region region;
};

Parsed run_parser(std::string_view text) {
    Parsed parsed;
    try {
        parsed.table = toml::parse(text, std::string_view());
    } catch (const toml::parse_error& error) {
        parsed.error = error.description();
        parsed.region = error.source();
    }
    return parsed;
}

// Whether a value is an integer too large for TOML, which a seed may be.
bool is_huge_integer(std::string_view value) {
    constexpr std::size_t digits_of_int64 = 19;
    const bool all_digits = value.find_first_not_of("0123456789") == std::string_view::npos;
    return all_digits && value.size() >= digits_of_int64;
}

// Returns where a one-line string begins that does not end in its line, or npos if there is none.
std::size_t unclosed_quote(std::string_view line) {
    std::size_t open = std::string_view::npos;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (open == std::string_view::npos) {
            if (line[i] == '#') break;
            if (line[i] == '"' || line[i] == '\'') open = i;
        } else if (line[i] == '\\' && line[open] == '"') {
            ++i;
        } else if (line[i] == line[open]) {
            open = std::string_view::npos;
        }
    }
    const bool is_of_many_lines =
        open != std::string_view::npos && open >= 2 && line[open - 1] == line[open];
    return is_of_many_lines ? std::string_view::npos : open;
}

// Whether the value has a comma as its decimal point: "0,3".
bool has_decimal_comma(std::string_view value) {
    const std::size_t comma = value.find(',');
    if (comma == std::string_view::npos || comma == 0 || comma + 1 == value.size()) return false;
    constexpr std::string_view digits = "0123456789";
    return value.find_first_not_of(digits, comma + 1) == std::string_view::npos &&
           value.substr(0, comma).find_last_not_of(digits) + 1 <=
               (value.find_first_of("+-") == 0 ? 1U : 0U);
}

bool contains_any(std::string_view line, std::span<const std::string_view> parts) {
    return std::ranges::any_of(
        parts, [&](std::string_view part) { return line.find(part) != std::string_view::npos; });
}

constexpr std::array<std::string_view, 8> typographic_quotes = {
    "\u201c", "\u201d", "\u201e", "\u2018", "\u2019", "\u201a", "\u00ab", "\u00bb"};

// Returns words for texts that were written by, or for, other programs, or an empty text.
std::string advice_on_origin(const Source& source, std::string_view line) {
    const std::string_view text = source.text;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && text[first] == '{') {
        return "this looks like JSON; recipes are TOML: preset = \"earth\"";
    }
    for (std::size_t at = text.find('\r'); at != std::string_view::npos;
         at = text.find('\r', at + 1)) {
        if (at + 1 == text.size() || text[at + 1] != '\n') {
            return "lines end with a carriage return alone, as on an old Mac: save with line feeds";
        }
    }
    if (contains_any(line, typographic_quotes))
        return "a typographic quote: write the plain one, \"";
    constexpr std::array<std::string_view, 2> blanks = {"\u00a0", "\u202f"};
    if (contains_any(line, blanks)) return "a no-break space: write a plain one";
    const std::size_t colon = line.find(':');
    if (line.find('=') == std::string_view::npos && colon != std::string_view::npos) {
        return "this looks like YAML; recipes are TOML: preset = \"earth\"";
    }
    return "";
}

// Returns better words than the parser's for the most common mistakes: text of another kind, a
// quantity without its quotes, a comma as a decimal point, and an integer that is too large for TOML.
std::string advice(const Place& place) {
    const std::string line = source_range(place).line_text;
    const std::string origin = advice_on_origin(*place.source, line);
    const std::size_t equals = line.find('=');
    if (!origin.empty() || equals == std::string::npos) return origin;
    std::string_view value = std::string_view(line).substr(equals + 1);
    value = trim(value.substr(0, value.find('#')));
    if (has_decimal_comma(value)) return "write a decimal point, not a comma";
    if (is_huge_integer(value)) return "write a number above 2^63 - 1 in quotes";
    const auto parsed = parse_quantity(value);
    const auto* quantity = std::get_if<Quantity>(&parsed);
    if (!quantity || quantity->dimension == Dimension::number) return "";
    return "write a quantity with a unit in quotes: " + toml_string(value);
}

Place place_at(const Source& source, std::string_view text, std::size_t offset) {
    const TextPosition position = text_position(text, offset);
    return {&source, position.line, position.column, 1};
}

bool check_encoding(const Source& source, std::string_view text, DiagnosticList& diagnostics) {
    const std::optional<std::size_t> invalid = find_invalid_utf8(text);
    if (!invalid) return true;
    diagnostics.error("E0100", place_at(source, text, *invalid),
                      fmt::format("`{}` is not UTF-8 text: byte 0x{:02x} at offset {}", source.name,
                                  static_cast<unsigned char>(text[*invalid]), *invalid),
                      "a recipe is TOML text: save it as UTF-8 in your editor");
    return false;
}

std::string double_to_string(double value) {
    if (value != value) return "nan";
    if (value - value != 0) return value > 0 ? "inf" : "-inf";
    return number_to_string(value);
}

// Spells each alternative of a value. Its recursion is not deeper than the text's own nesting, which
// parse_toml has bounded.
struct Spelling {
    std::string operator()(std::monostate) const { return "a date or time"; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return std::to_string(integer); }
    std::string operator()(double number) const { return double_to_string(number); }
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(const Array& array) const {
        return fmt::format("[{}]", fmt::join(mapped<std::string>(array, value_to_string), ", "));
    }
    std::string operator()(const Table& table) const {
        const auto entries = mapped<std::string>(table, [](const Entry& entry) {
            return key_to_string(entry.key) + " = " + value_to_string(entry.value);
        });
        return fmt::format("{{ {} }}", fmt::join(entries, ", "));
    }
};

}  // namespace

std::optional<Table> parse_toml(const Source& source, DiagnosticList& diagnostics) {
    const std::string_view text = source.text;
    if (!check_encoding(source, text, diagnostics)) return std::nullopt;
    if (const auto deep = find_deep_nesting(text, deepest_nesting)) {
        diagnostics.error("E0121", {&source, deep->line, deep->column, 1},
                          "keys, arrays or tables are nested too deeply",
                          "at most " + std::to_string(deepest_nesting) + " levels");
        return std::nullopt;
    }
    const Parsed parsed = run_parser(text);
    if (!parsed.table) {
        Place place = place_of(parsed.region, &source);
        const std::string line = source_range(place).line_text;
        if (const std::size_t open = unclosed_quote(line); open != std::string::npos) {
            place.column = text_position(line, open).column;
            place.length = 1;
            diagnostics.error("E0101", place, "not TOML: the quote that opens here is not closed",
                              "close it on the same line");
            return std::nullopt;
        }
        diagnostics.error("E0101", place, "not TOML: " + printable(parsed.error), advice(place));
        return std::nullopt;
    }
    return convert_table(*parsed.table, &source);
}

std::optional<Value> parse_toml_value(std::string_view text) {
    const std::string line = "value = " + std::string(text);
    if (find_invalid_utf8(line) || find_deep_nesting(line, deepest_nesting)) return std::nullopt;
    const Parsed parsed = run_parser(line);
    if (!parsed.table || parsed.table->size() != 1) return std::nullopt;
    return convert(*parsed.table->get("value"), nullptr);
}

std::optional<std::string> parse_toml_key(std::string_view text) {
    if (text.find_first_of("\r\n") != std::string_view::npos) return std::nullopt;
    const std::string line = std::string(text) + " = 0";
    if (find_invalid_utf8(line) || find_deep_nesting(line, deepest_nesting)) return std::nullopt;
    const Parsed parsed = run_parser(line);
    if (!parsed.table) return std::nullopt;
    std::string path;
    const toml::node* node = &*parsed.table;
    while (const toml::table* table = node->as_table()) {
        if (table->size() != 1) return std::nullopt;
        path = join_path(path, table->begin()->first.str());
        node = &table->begin()->second;
    }
    return path;
}

std::string value_to_string(const Value& value) { return std::visit(Spelling{}, value.data); }

}  // namespace skybake::config
