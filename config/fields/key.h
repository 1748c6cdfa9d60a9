// This header says a key in one statement: its name, its kind, and in any order what else there is to say,
// each in a type of its own.
//
//   key("gain", Kind::number, "weight of an octave over that of the one before", gain_range,
//       Default{"0.5"}, Exclusive{"gains"}, When{"type", "perlin"}, Cited{musgrave_1994})
#pragma once

#include <span>
#include <string_view>

#include "config/fields/fields.h"

namespace skybake::config {

// The default as TOML text; empty: none.
struct Default {
    std::string_view toml;
};

// Typical values, where the range says too little.
struct Hint {
    std::string_view text;
};

// The source of the default or of the meaning.
struct Cited {
    std::string_view source;
};

// Keys of a group exclude each other, except those on the same side.
struct Exclusive {
    std::string_view group;
    std::string_view side = {};
};

// The key applies only where another key of the table has one of these values.
struct When {
    std::string_view selector;
    Words values;
};

// The key applies only where this text of the table is not empty.
struct Needs {
    std::string_view text;
};

// The diagnostic for a value out of range.
struct RangeCode {
    std::string_view code;
};

enum class KeyFlag {
    required,   // wherever the key applies
    only_shown  // the key says where values come from; files do not carry it
};

constexpr void say(Field& field, std::string_view documentation) {
    field.documentation = documentation;
}
constexpr void say(Field& field, const Range& range) { field.range = range; }
constexpr void say(Field& field, std::span<const Choice> choices) { field.choices = choices; }
constexpr void say(Field& field, Default given) { field.fallback = given.toml; }
constexpr void say(Field& field, Hint given) { field.hint = given.text; }
constexpr void say(Field& field, Cited given) { field.citation = given.source; }
constexpr void say(Field& field, Exclusive given) {
    field.exclusive_group = given.group;
    field.exclusive_side = given.side;
}
constexpr void say(Field& field, When given) {
    field.selector = given.selector;
    field.selected_by = given.values;
}
constexpr void say(Field& field, Needs given) { field.needs = given.text; }
constexpr void say(Field& field, RangeCode given) { field.range_code = given.code; }
constexpr void say(Field& field, KeyFlag flag) {
    (flag == KeyFlag::required ? field.required : field.only_shown) = true;
}
constexpr void say(Field& field, Role role) { field.role = role; }

template <class... Parts>
constexpr Field key(std::string_view name, const ValueKind& kind, const Parts&... parts) {
    Field field{.key = name, .kind = kind};
    (say(field, parts), ...);
    return field;
}

}  // namespace skybake::config
