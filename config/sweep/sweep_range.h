// A range in [sweep], { from, to, count, scale }, and the values in it.
//
// Values between the ends are rounded to 12 significant digits of the larger end (each of its own
// on a log scale), so that 0.30000000000000004 never shows. Only operations that IEEE 754 rounds
// correctly are used, square roots for the log scale too, so that they are the same on every
// machine; the C library's exp and log are not, and rounding would hide most of their differences,
// not all. The ends are spelled as they were given.
#pragma once

#include <cstdint>
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
    std::string unit;    // of from and to, "" for none
    bool whole = false;  // the key takes whole numbers
    bool log = false;
    std::optional<int> count;
};

// Reads the range of the key `path`, whose field is given; `entry` is the one of [sweep]. No value,
// and at least one error, if it is at fault: E0135, or as any value of that key.
std::optional<SweptRange> read_range(const Field& field, const std::string& path,
                                     const Entry& entry, Decoder& decoder);

// The values of a range with a count, evenly spaced, both ends among them. None, and E0135, if the
// key takes whole numbers and not all are.
std::optional<std::vector<SweepValue>> range_values(const SweptRange& range,
                                                    const std::string& path, const Entry& entry,
                                                    Decoder& decoder);

// The value at a share of the way, in [0, 1). Whole numbers from both ends and all between have
// equal shares.
SweepValue value_at_share(const SweptRange& range, double share);

// The value as --set takes it and as tables show it.
SweepValue sweep_value(const Value& value);

// Reads a value of a key that varies, and reports it if no variant could be made of it: another
// type, dimension, choice or number of values. Whether it is in range is for the variant to say.
bool check_form(const Field& field, const std::string& path, const Value& value, Decoder& decoder);

}  // namespace skybake::config
