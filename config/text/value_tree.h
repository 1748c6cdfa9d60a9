// This header holds a parsed TOML document as plain data. Each key and value has its place. Only
// one source file knows the TOML library; everything else works with this tree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace skybake::config {

// A source is one text that values come from: a recipe, an included file, a preset or a --set.
struct Source {
    enum class Kind { file, preset, setting };
    Kind kind = Kind::file;
    int order = 0;                      // later sources override earlier ones
    std::string name;                   // "earth.toml", "preset earth", "--set `a.b=c`"
    std::string text;                   // empty for a setting, which has no lines
    std::filesystem::path folder = {};  // files that the text names are looked for here
};

// Columns and lengths count code points. Lines and columns count from 1, and 0 means not known.
struct Place {
    const Source* source = nullptr;
    int line = 0;
    int column = 0;
    int length = 0;
};

// Returns what sorts places as people read them: by source, line and column.
inline auto reading_order(const Place& place) {
    return std::tuple(place.source ? place.source->order : -1, place.line, place.column);
}

struct Value;
struct Entry;
using Array = std::vector<Value>;
using Table = std::vector<Entry>;  // sorted by key, keys unique

// This is a value and its place. std::monostate stands for a TOML date or time, which no key of a
// recipe takes.
struct Value {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
    Place place;
    bool replaces =
        false;  // a table that was written as an array, which replaces those of earlier sources
};

struct Entry {
    std::string key;
    Place key_place;
    Value value;
};

inline const Table* as_table(const Value& value) { return std::get_if<Table>(&value.data); }

// Returns the entry of that key, or null.
inline const Entry* find_entry(const Table& table, std::string_view key) {
    const auto before = [](const Entry& entry, std::string_view name) { return entry.key < name; };
    const auto entry = std::lower_bound(table.begin(), table.end(), key, before);
    return entry != table.end() && entry->key == key ? &*entry : nullptr;
}

// Returns the text, or the table, of that key; null if there is none.
inline const std::string* find_text(const Table& table, std::string_view key) {
    const Entry* entry = find_entry(table, key);
    return entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
}

inline const Table* find_table(const Table& table, std::string_view key) {
    const Entry* entry = find_entry(table, key);
    return entry ? as_table(entry->value) : nullptr;
}

inline Entry* find_entry(Table& table, std::string_view key) {
    return const_cast<Entry*>(find_entry(static_cast<const Table&>(table), key));
}

}  // namespace skybake::config
