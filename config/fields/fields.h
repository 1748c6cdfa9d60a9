// This header defines the rows that describe every key of a recipe: its kind, range, default,
// documentation, source and role, and the struct member that it fills. The decoder and its checks,
// explain, init, the JSON Schema, show, the keys of caches and the metadata in baked files are all
// generated from these rows. No key is listed elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields/kinds.h"
#include "config/fields/roles.h"

namespace skybake::config {

// A range is in base units: metres, 1/m, radians or 1.
struct Range {
    double minimum = 0;
    double maximum = 0;
    bool open_minimum = false;  // the bound itself is not allowed
    bool open_maximum = false;
    bool or_zero = false;  // 0 is allowed too
};

// This is a word that a key may have, and the enumerator that it stands for.
struct Choice {
    std::string_view name;
    std::string_view documentation;
    int enumerator = 0;

    template <class Enum>
    constexpr Choice(Enum value, std::string_view word, std::string_view what)
        : name(word), documentation(what), enumerator(static_cast<int>(value)) {}

    template <class Enum>
    constexpr bool is(Enum value) const {
        return enumerator == static_cast<int>(value);
    }
};

// A few words, which stand in the row of a key: "tent", or {"ozone", "oxygen"}.
class Words {
  public:
    constexpr Words(const char* only) : Words({std::string_view(only)}) {}
    constexpr Words(std::initializer_list<std::string_view> words) : count_(words.size()) {
        std::ranges::copy(words, words_.begin());
    }
    constexpr auto begin() const { return words_.begin(); }
    constexpr auto end() const { return words_.begin() + count_; }

  private:
    std::array<std::string_view, 7> words_{};
    std::size_t count_ = 0;
};

struct Field {
    std::string_view key;
    ValueKind kind = Kind::text;
    Range range = {};                       // of every number in the value
    std::span<const Choice> choices = {};   // Kind::choice, Kind::choice_list
    std::string_view fallback = {};         // the default as TOML text; empty: none
    bool required = false;                  // required wherever the key applies
    std::string_view documentation = {};    // one line
    std::string_view hint = {};             // typical values, where the range says too little
    std::string_view citation = {};         // the source of the default or the meaning
    std::string_view exclusive_group = {};  // keys of a group exclude each other ...
    std::string_view exclusive_side = {};   // ... except those on the same side
    std::string_view selector = {};         // the key applies only where this key of the table ...
    Words selected_by = {};                 // ... has one of these values
    std::string_view needs = {};  // the key applies only where this text of the table is not empty
    std::string_view range_code = "E0110";  // the diagnostic for a value out of range
    bool only_shown = false;  // the key says where values come from; files do not carry it
    Role role = Role::content;
};

// This is a table of a recipe. In its path a `*` stands for a name that the user gives.
struct Section {
    std::string_view
        path;  // "", "atmosphere", "atmosphere.layers.*", "clouds.*.towers.*", "bake.*"
    std::string_view asset;  // bake sections: what they bake; else empty
    std::string_view documentation;
    std::vector<Field> fields;
};

// Returns all sections, in the order of a recipe. recipe/recipe_decoder.cpp collects them from the
// folders of config.
std::span<const Section> sections();

// Returns the section at a path pattern. For a bake section, `asset` says which one. Returns null
// if there is none.
const Section* find_section(std::string_view path, std::string_view asset = "");

const Field* find_field(const Section& section, std::string_view key);

// These list the keys of a section and the names of a field's choices.
std::vector<std::string_view> field_keys(const Section& section);
std::vector<std::string_view> choice_names(const Field& field);

// Returns the word that stands for an enumerator, or an empty text if none does.
template <class Enum>
std::string_view choice_name(const Field& field, Enum value) {
    for (const Choice& choice : field.choices) {
        if (choice.is(value)) return choice.name;
    }
    return "";
}

// Returns the names of all assets. Each has one bake section.
std::vector<std::string_view> asset_names();

// Returns the names of the tables within the table at a path: {"atmosphere", "scene", "noise",
// "clouds" ...} for "".
std::vector<std::string_view> subtables(std::string_view path);

// Returns the names that make up a section's path, `*` among them.
std::vector<std::string_view> path_names(const Section& section);

// Whether these names make up the section's path; its `*` stands for any name.
bool names_fit(std::span<const std::string> names, const Section& section);

// Whether the field applies where its selector has this value.
bool applies(const Field& field, std::string_view selector_value);

// Whether two keys of a section say the same thing, so that only one of them may be given.
bool exclude_each_other(const Field& field, const Field& other);

// These say in words what a value may be: "in [1 m, 1e+12 m]", "one of `zip`, `none`".
// `describe_range` returns an empty text for kinds without numbers.
std::string describe_range(const Field& field);
std::string describe_choices(const Field& field);

// Returns documentation, range or choices, and typical values, in one line.
std::string describe_field(const Field& field);

// The field tables of several sections share these ranges and sources.
inline constexpr Range unit_range{0, 1};
inline constexpr Range coefficient_range{0, 1e6};  // per metre
inline constexpr Range texel_range{1, 16384};      // along an axis of a table, an image or a volume
inline constexpr Range lookup_error_range{1e-7, 1};
inline constexpr Range texel_error_range{1e-5, 1};
inline constexpr Range turn_range{-2 * std::numbers::pi, 2 * std::numbers::pi};
inline constexpr Range elevation_range{-std::numbers::pi / 2, std::numbers::pi / 2};
inline constexpr Range camera_altitude_range{0, 1e12};
inline constexpr Range view_distance_range{1e-3, 1e12};

inline constexpr std::string_view hillaire_2020 =
    "Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique";
inline constexpr std::string_view bruneton_2008 =
    "Bruneton and Neyret 2008, Precomputed Atmospheric Scattering";
inline constexpr std::string_view bruneton_2017 =
    "Bruneton 2017, Precomputed Atmospheric Scattering: a New Implementation";
inline constexpr std::string_view olajos_2016 =
    "Olajos 2016, Real-Time Rendering of Volumetric Clouds";
inline constexpr std::string_view schneider_2015 =
    "Schneider and Vos 2015, The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn";

}  // namespace skybake::config
