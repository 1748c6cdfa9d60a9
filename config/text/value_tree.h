// A parsed TOML document as plain data, each key and value with its place. It stands between the
// TOML library, which one translation unit knows, and everything that gives the values a meaning.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace skybake::config {

// One text that values come from: a recipe, an included file, a preset or a --set.
struct Source {
    enum class Kind { file, preset, setting };
    Kind kind = Kind::file;
    int order = 0;                      // later sources override earlier ones
    std::string name;                   // "earth.toml", "preset earth", "--set `a.b=c`"
    std::string text;                   // empty for a setting, which has no lines
    std::filesystem::path folder = {};  // where files that it names are looked for
};

// Columns and lengths count code points; lines and columns count from 1, 0 means not known.
struct Place {
    const Source* source = nullptr;
    int line = 0;
    int column = 0;
    int length = 0;
};

struct Value;
struct Entry;
using Array = std::vector<Value>;
using Table = std::vector<Entry>;  // sorted by key, keys unique

// std::monostate stands for a TOML date or time, which no key of a recipe takes.
struct Value {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
    Place place;
    bool replaces =
        false;  // of a table: it was written as an array, which replaces earlier sources'
};

struct Entry {
    std::string key;
    Place key_place;
    Value value;
};

inline const Table* as_table(const Value& value) { return std::get_if<Table>(&value.data); }

// The entry of that key, or null.
inline const Entry* find_entry(const Table& table, std::string_view key) {
    const auto before = [](const Entry& entry, std::string_view name) { return entry.key < name; };
    const auto entry = std::lower_bound(table.begin(), table.end(), key, before);
    return entry != table.end() && entry->key == key ? &*entry : nullptr;
}

inline Entry* find_entry(Table& table, std::string_view key) {
    return const_cast<Entry*>(find_entry(static_cast<const Table&>(table), key));
}

}  // namespace skybake::config
