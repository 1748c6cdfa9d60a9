// This header reads a range in [sweep], { from, to, count, scale }, and computes its values.
//
// Values between the ends are rounded to 12 significant digits of the larger end, or of each value
// itself on a log scale, so that 0.30000000000000004 never appears. Values are computed only with
// operations that IEEE 754 rounds correctly, including square roots for the log scale, so that they
// are the same on every machine. The C library's exp and log are not, and rounding would hide most
// of their differences but not all. The ends keep the spelling in which they were given.
#pragma once

#include <optional>
#include <string>

#include "config/fields/section_decoder.h"
#include "config/sweep/sweep.h"

namespace skybake::config {

struct SweptRange {
    double from = 0;
    double to = 0;
    SweepValue first;  // `from` and `to` as given
    SweepValue last;
    std::string unit;    // of from and to; "" if they have none
    bool whole = false;  // the key takes whole numbers
    bool log = false;
    std::optional<int> count;
};

// Reads the range of the key `path`, whose field is given. `entry` is its entry in [sweep]. If the
// range is at fault, it returns no value and reports at least one error: E0135, or the error of any
// value of that key.
std::optional<SweptRange> read_range(const Field& field, const std::string& path,
                                     const Entry& entry, Decoder& decoder);

// Returns the evenly spaced values of a range with a count, including both ends. It returns none
// and reports E0135 if the key takes whole numbers and some values are not whole.
std::optional<std::vector<SweepValue>> range_values(const SweptRange& range,
                                                    const std::string& path, const Entry& entry,
                                                    Decoder& decoder);

// Returns the value at a share of the way from the first end to the last. The share is in [0, 1).
// If the key takes whole numbers, the ends and all whole numbers between them have equal shares.
SweepValue value_at_share(const SweptRange& range, double share);

// Spells a value as --set takes it and as tables show it.
SweepValue sweep_value(const Value& value);

// Checks a value of a key that varies, and reports it if no variant could be made of it because its
// type, dimension, choice or number of values is wrong. The range is checked when the variant is
// read.
bool check_form(const Field& field, const std::string& path, const Value& value, Decoder& decoder);

}  // namespace skybake::config
