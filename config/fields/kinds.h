// This header lists the kinds of values that keys have. For each kind it says in words what the
// kind takes, how it is read and spelt, how the JSON Schema describes it, and whether a sweep can
// range over it. A new kind of value needs one row of `Kind` below, and a reader or a schema if
// none of the existing ones fits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "config/fields/field_value.h"
#include "config/text/units.h"

namespace skybake::config {

struct Field;
struct Reader;

// This says how the numbers of a value are measured and spelt.
struct Scale {
    Dimension dimension = Dimension::number;
    std::string (*to_string)(double) = number_to_string;        // canonical, in a base unit
    std::string (*bound_to_string)(double) = number_to_string;  // spelling in messages
};

enum class RangeOver { nothing, numbers, wholes };

using ReadKind = std::optional<FieldValue>(const Reader& reader, const Value& value);
using KindSchema = nlohmann::ordered_json(const Field& field);

struct ValueKind {
    std::string_view words;  // after "expected": "a length with a unit"; unique to the kind
    // It reports at least one error whenever it returns no value.
    ReadKind* read = nullptr;
    KindSchema* schema = nullptr;
    const Scale* scale = nullptr;          // null if there are no numbers or they have no range
    RangeOver swept = RangeOver::nothing;  // what a range in [sweep] may go over
    int fewest = 0;                        // least number of items of a list
    int most = 0;
    bool one_for_all_axes = false;  // three equal numbers are spelt as one

    constexpr bool operator==(const ValueKind& other) const { return words == other.words; }
};

// --- Readers ------------------------------------------------------------------------------------

ReadKind read_flag, read_whole, read_quantity, read_text, read_text_list, read_path_groups;
ReadKind read_one_choice, read_choice_list;
// These take, in this order, wavelengths (wavelength_reader.cpp), one number per channel, and up to
// most_angles angles.
ReadKind read_wavelengths, read_channels, read_angles;
ReadKind read_size, read_voxels;  // two whole numbers; three whole numbers
ReadKind read_pair, read_triple;  // two numbers; three numbers
ReadKind read_bounds;             // two numbers, the first not above the second
ReadKind read_density_table;      // pairs whose altitudes increase, from 0 up
ReadKind read_height_table;       // pairs whose heights increase within [0, 1]
ReadKind read_index_table;        // wavelengths that increase, each with n and k of n + i k
ReadKind read_albedo;             // as read_channels, a spectrum, or one of the field's choices
ReadKind read_components;         // names, each with a number density, none of them twice
ReadKind read_seed;               // an integer, or a text with a decimal or 0x number
ReadKind read_frequency;          // lattice cells per tile along x, y and z: one or three integers
ReadKind read_frequencies;        // one to most_octaves frequencies
ReadKind read_gains;              // one to most_octaves numbers, at least one of them above 0
ReadKind read_remap;              // four numbers with a slope that is finite in single precision
ReadKind read_edges;              // two numbers, the second above the first by at least 1e-6
ReadKind read_clamp;              // true is [0, 1], false is [-infinity, infinity]
ReadKind read_levels;             // "all" is 0
ReadKind read_power_of_two;       // 1, 2, 4 ...
ReadKind read_swept;              // any value; the key that varies decides what it means

// --- JSON Schemas -------------------------------------------------------------------------------

KindSchema flag_schema, whole_schema, number_schema, text_schema, text_list_schema;
KindSchema path_groups_schema, choice_schema, choice_list_schema, seed_schema, swept_schema;
KindSchema numbers_schema;         // a list of `fewest` to `most` numbers
KindSchema one_or_numbers_schema;  // a number, or a list of `fewest` to `most` numbers
KindSchema wholes_schema;          // a list of `fewest` to `most` whole numbers
KindSchema wavelengths_schema;     // one_or_numbers_schema, or a text
KindSchema frequency_schema, frequencies_schema, clamp_schema, levels_schema, power_of_two_schema;
KindSchema density_table_schema, height_table_schema, index_table_schema, components_schema;
KindSchema albedo_schema;

// --- Scales -------------------------------------------------------------------------------------

std::string degrees_to_string(double radians);     // "53 deg"
std::string level_count_to_string(double levels);  // "4", or "all" in quotes for 0

struct Scales {
    static constexpr Scale plain{};
    static constexpr Scale fraction{Dimension::fraction};
    static constexpr Scale level_count{Dimension::number, level_count_to_string};
    static constexpr Scale length{Dimension::length, length_to_string, length_to_string};
    static constexpr Scale wavelength{Dimension::length, wavelength_to_string,
                                      wavelength_to_string};
    static constexpr Scale inverse_length{Dimension::inverse_length, inverse_length_to_string,
                                          inverse_length_to_string};
    static constexpr Scale number_density{Dimension::number_density, number_density_to_string,
                                          number_density_to_string};
    static constexpr Scale pressure{Dimension::pressure, pressure_to_string, pressure_to_string};
    static constexpr Scale column_density{Dimension::column_density, column_density_to_string,
                                          column_density_to_string};
    static constexpr Scale angle{Dimension::angle, angle_to_string, degrees_to_string};
};

// --- Kinds --------------------------------------------------------------------------------------

inline constexpr int most_angles = 64;
inline constexpr int most_octaves = 16;
inline constexpr int most_wavelengths = 512;

constexpr ValueKind list_kind(std::string_view words, ReadKind* read, KindSchema* schema,
                              const Scale* scale, int fewest, int most,
                              RangeOver swept = RangeOver::nothing) {
    return {words, read, schema, scale, swept, fewest, most};
}

struct Kind {
    using S = Scales;
    static constexpr ValueKind flag{"true or false", read_flag, flag_schema};
    static constexpr ValueKind integer{"a whole number", read_whole, whole_schema, &S::plain,
                                       RangeOver::wholes};
    static constexpr ValueKind number{"a number without a unit", read_quantity, number_schema,
                                      &S::plain, RangeOver::numbers};
    static constexpr ValueKind fraction{"a fraction, such as 0.002 or \"0.2 %\"", read_quantity,
                                        number_schema, &S::fraction, RangeOver::numbers};
    static constexpr ValueKind text{"a string in quotes", read_text, text_schema};
    static constexpr ValueKind text_list{"a list of strings", read_text_list, text_list_schema};
    static constexpr ValueKind choice{"a name in quotes", read_one_choice, choice_schema};
    static constexpr ValueKind choice_list{"a name in quotes, or a list of them", read_choice_list,
                                           choice_list_schema};
    static constexpr ValueKind length{"a length with a unit, such as \"8 km\"", read_quantity,
                                      number_schema, &S::length, RangeOver::numbers};
    static constexpr ValueKind lengths =
        list_kind("three lengths, such as [\"6 km\", \"6 km\", \"1.5 km\"]", read_triple,
                  numbers_schema, &S::length, 3, 3);
    static constexpr ValueKind two_lengths = list_kind(
        "two lengths, such as [\"120 m\", \"-50 m\"]", read_pair, numbers_schema, &S::length, 2, 2);
    static constexpr ValueKind length_bounds =
        list_kind("two lengths, the smaller one first, such as [\"1 km\", \"3 km\"]", read_bounds,
                  numbers_schema, &S::length, 2, 2);
    static constexpr ValueKind wavelengths = list_kind(
        "a list of wavelengths, such as [\"680 nm\", \"550 nm\", \"440 nm\"], \"best 4\", or a "
        "range, such as \"380 nm..780 nm by 5 nm\"",
        read_wavelengths, wavelengths_schema, &S::wavelength, 1, most_wavelengths,
        RangeOver::numbers);
    static constexpr ValueKind coefficient{"a coefficient with a unit, such as \"40 /km\"",
                                           read_quantity, number_schema, &S::inverse_length,
                                           RangeOver::numbers};
    static constexpr ValueKind coefficients =
        list_kind("a coefficient with a unit, such as \"4e-6 /m\", or a list of one per channel",
                  read_channels, one_or_numbers_schema, &S::inverse_length, 1, most_wavelengths,
                  RangeOver::numbers);
    static constexpr ValueKind fractions = list_kind(
        "a fraction, such as 0.3 or \"30 %\", or a list of one per channel", read_channels,
        one_or_numbers_schema, &S::fraction, 1, most_wavelengths, RangeOver::numbers);
    static constexpr ValueKind albedo = list_kind(
        "a fraction, such as 0.3 or \"30 %\", a list of one per channel, pairs of wavelength and "
        "fraction, such as [[\"450 nm\", 0.07], [\"650 nm\", 0.25]], or a measured ground, such as "
        "\"sand\"",
        read_albedo, albedo_schema, &S::fraction, 1, most_wavelengths, RangeOver::numbers);
    static constexpr ValueKind number_density{"a number per volume, such as \"300 /cm3\"",
                                              read_quantity, number_schema, &S::number_density,
                                              RangeOver::numbers};
    static constexpr ValueKind pressure{"a pressure with a unit, such as \"1013.25 hPa\"",
                                        read_quantity, number_schema, &S::pressure,
                                        RangeOver::numbers};
    static constexpr ValueKind column_density{
        "a number of molecules per area, such as \"300 DU\" or \"4e26 /m2\"", read_quantity,
        number_schema, &S::column_density, RangeOver::numbers};
    static constexpr ValueKind angle{"an angle with a unit, such as \"30 deg\"", read_quantity,
                                     number_schema, &S::angle, RangeOver::numbers};
    static constexpr ValueKind angles =
        list_kind("a list of angles, such as [\"30 deg\", \"5 deg\"]", read_angles,
                  one_or_numbers_schema, &S::angle, 1, most_angles);
    static constexpr ValueKind angle_bounds =
        list_kind("two angles, the lower one first, such as [\"-10 deg\", \"90 deg\"]", read_bounds,
                  numbers_schema, &S::angle, 2, 2);
    static constexpr ValueKind pair =
        list_kind("two numbers, such as [0.2, 0.35]", read_pair, numbers_schema, &S::plain, 2, 2);
    static constexpr ValueKind bounds =
        list_kind("two numbers, the lower one first, such as [0.02, 0.05]", read_bounds,
                  numbers_schema, &S::plain, 2, 2);
    static constexpr ValueKind edges =
        list_kind("two numbers, the first below the second, such as [0.8, 1.4]", read_edges,
                  numbers_schema, &S::plain, 2, 2);
    static constexpr ValueKind clamp =
        list_kind("true, false or two numbers, the lower one first, such as [0, 1]", read_clamp,
                  clamp_schema, &S::plain, 2, 2);
    static constexpr ValueKind remap =
        list_kind("four numbers, [in_low, in_high, out_low, out_high]", read_remap, numbers_schema,
                  &S::plain, 4, 4);
    static constexpr ValueKind gains =
        list_kind("a list of one number per octave, such as [0.625, 0.25, 0.125]", read_gains,
                  numbers_schema, &S::plain, 1, most_octaves);
    static constexpr ValueKind size = list_kind("two whole numbers, such as [256, 64]", read_size,
                                                wholes_schema, &S::plain, 2, 2);
    static constexpr ValueKind voxels = list_kind("three whole numbers, such as [128, 128, 128]",
                                                  read_voxels, wholes_schema, &S::plain, 3, 3);
    static constexpr ValueKind frequency{"a whole number, such as 4, or one per axis: [4, 4, 8]",
                                         read_frequency,
                                         frequency_schema,
                                         &S::plain,
                                         RangeOver::wholes,
                                         3,
                                         3,
                                         true};
    static constexpr ValueKind frequencies{
        "a list of one frequency per octave, such as [8, 32, 56]",
        read_frequencies,
        frequencies_schema,
        &S::plain,
        RangeOver::nothing,
        1,
        most_octaves,
        true};
    static constexpr ValueKind levels{"a whole number, or \"all\"", read_levels, levels_schema,
                                      &S::level_count, RangeOver::wholes};
    static constexpr ValueKind power_of_two{"a power of two, such as 4", read_power_of_two,
                                            power_of_two_schema, &S::plain, RangeOver::wholes};
    static constexpr ValueKind seed{
        "a whole number from 0 up, above 2^63 - 1 in quotes: \"0xffffffffffffffff\"", read_seed,
        seed_schema, nullptr, RangeOver::wholes};
    static constexpr ValueKind density_table{
        "a list of pairs, such as [[\"0 km\", 1.0], [\"10 km\", 0.5]], or a file of them, such as "
        "\"ozone.csv\" or [\"afglus.dat\", \"o3\"]",
        read_density_table, density_table_schema, &S::plain};
    static constexpr ValueKind height_table{
        "a list of pairs, such as [[0, 0.0], [0.2, 1.0], [1, 0.0]]", read_height_table,
        height_table_schema, &S::plain};
    static constexpr ValueKind index_table{
        "a list of a wavelength and two numbers each, such as [[\"400 nm\", 1.5, 0.01], [\"700 "
        "nm\", 1.5, 0.003]]",
        read_index_table, index_table_schema, &S::plain};
    static constexpr ValueKind components{
        "a list of pairs, such as [[\"water_soluble\", \"7000 /cm3\"], [\"soot\", \"8300 /cm3\"]]",
        read_components, components_schema, &S::number_density};
    static constexpr ValueKind path_groups{"a list of paths in quotes, or a list of such lists",
                                           read_path_groups, path_groups_schema};
    static constexpr ValueKind swept{"one number, or a quantity in quotes", read_swept,
                                     swept_schema};
};

}  // namespace skybake::config
