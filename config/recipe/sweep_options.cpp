#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/diagnostics/toml_source.h"
#include "config/recipe/recipe.h"
#include "config/recipe/recipe_sources.h"
#include "config/sections/particles.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

// Returns the pieces between separators that are not in quotes or brackets.
std::vector<std::string_view> split_outside(std::string_view text, char separator) {
    std::vector<std::string_view> pieces;
    std::size_t start = 0;
    int depth = 0;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != 0) {
            if (c == '\\' && quote == '"') ++i;
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == separator && depth == 0) {
            pieces.push_back(trim(text.substr(start, i - start)));
            start = i + 1;
        }
    }
    pieces.push_back(trim(text.substr(std::min(start, text.size()))));
    return pieces;
}

// Reads a value. A text that is not TOML counts as a string, as in --set.
Value value_of(std::string_view text) {
    std::optional<Value> value = parse_toml_value(text);
    return value ? std::move(*value) : Value{std::string(text), {}};
}

Entry entry_of(std::string key, Value value) { return {std::move(key), {}, std::move(value)}; }

// Whether a text begins as a number. Then it is a number too large for TOML or a misspelt one, not
// the name of a scale.
bool begins_as_number(std::string_view text) {
    return std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos;
}

// Reads FROM:TO, then a count or a scale or both. Returns none if there are more pieces, or an
// empty one.
std::optional<Value> range_of(const std::vector<std::string_view>& pieces) {
    constexpr std::size_t most_pieces = 4;
    if (pieces.size() > most_pieces) return std::nullopt;
    std::optional<Entry> count;
    std::optional<Entry> scale;
    for (std::size_t i = 2; i < pieces.size(); ++i) {
        Value value = value_of(pieces[i]);
        const bool is_text =
            std::holds_alternative<std::string>(value.data) && !begins_as_number(pieces[i]);
        std::optional<Entry>& place = is_text ? scale : count;
        if (place) return std::nullopt;
        place = entry_of(is_text ? "scale" : "count", std::move(value));
    }
    Table table;  // sorted by key
    if (count) table.push_back(std::move(*count));
    table.push_back(entry_of("from", value_of(pieces[0])));
    if (scale) table.push_back(std::move(*scale));
    table.push_back(entry_of("to", value_of(pieces[1])));
    return Value{std::move(table), {}, true};
}

std::optional<Value> list_of(const std::vector<std::string_view>& pieces) {
    Value first = value_of(pieces[0]);
    const bool is_list = pieces.size() == 1 && std::holds_alternative<Array>(first.data);
    if (is_list) return first;
    Array list;
    for (const std::string_view piece : pieces) list.push_back(value_of(piece));
    return Value{std::move(list), {}};
}

std::optional<Value> swept_values(std::string_view text) {
    const std::vector<std::string_view> listed = split_outside(text, ',');
    const std::vector<std::string_view> ranged = split_outside(text, ':');
    const bool is_range = listed.size() == 1 && ranged.size() > 1;
    const auto& pieces = is_range ? ranged : listed;
    const bool has_gap =
        std::ranges::any_of(pieces, [](std::string_view piece) { return piece.empty(); });
    if (has_gap) return std::nullopt;
    return is_range ? range_of(pieces) : list_of(pieces);
}

// Returns the entry of [sweep] that one --vary stands for.
std::optional<Entry> varied_entry(const std::string& option) {
    const std::string_view text = option;
    const std::size_t equals = find_equals(text);
    if (equals == std::string_view::npos) return std::nullopt;
    const std::optional<std::string> key = parse_toml_key(trim(text.substr(0, equals)));
    std::optional<Value> values = swept_values(text.substr(equals + 1));
    if (!key || !values) return std::nullopt;
    return entry_of(*key, std::move(*values));
}

Value groups_of(const std::vector<std::string>& options) {
    Array groups;
    for (const std::string& option : options) {
        Array paths;
        for (const std::string_view path : split_outside(option, ',')) {
            paths.push_back({std::string(path), {}});
        }
        groups.push_back({std::move(paths), {}});
    }
    return {std::move(groups), {}};
}

Table in_sweep(Entry entry) {
    Table sweep;
    sweep.push_back(std::move(entry));
    Table root;
    root.push_back(entry_of("sweep", {std::move(sweep), {}}));
    return root;
}

}  // namespace

void add_sweep_options(const SweepOptions& options, RecipeSources& sources,
                       DiagnosticList& diagnostics) {
    for (const std::string& option : options.vary) {
        Source& source = add_setting(sources, fmt::format("--vary `{}`", shorten(option)));
        std::optional<Entry> entry = varied_entry(option);
        if (entry) {
            add_setting_tree(sources, source, in_sweep(std::move(*entry)));
            continue;
        }
        diagnostics.error("E0122", {&source}, "--vary takes KEY=FROM:TO:COUNT or KEY=VALUE,VALUE",
                          "for example --vary clouds.cumulus.cover=0.2:0.8:4");
    }
    if (!options.zip.empty()) {
        Source& source = add_setting(
            sources,
            fmt::format("--zip `{}`", shorten(fmt::format("{}", fmt::join(options.zip, " ")))));
        add_setting_tree(sources, source, in_sweep(entry_of("zip", groups_of(options.zip))));
    }
    if (options.sobol) {
        Source& source = add_setting(sources, fmt::format("--sobol `{}`", shorten(*options.sobol)));
        add_setting_tree(sources, source, in_sweep(entry_of("sobol", value_of(*options.sobol))));
    }
}

}  // namespace skybake::config
