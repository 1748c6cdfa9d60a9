// Passes over the values of a volume, for vectors. No result depends on the instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace skybake {

// Returns true if all values are +0. A -0 does not count, because it is stored as -0.
bool are_zeros(const float* values, std::size_t count);

// Returns true if low <= value <= high holds for all values. It does not for a NaN.
bool are_within(const float* values, std::size_t count, float low, float high);

// Counts the values that are not 0 and whose magnitude is below `bound`.
long count_below(const float* values, std::size_t count, float bound);

// The extremes and the sum of values, in eight lanes: value i after the beginning belongs to lane
// i mod 8. The order of additions is fixed, and no addition waits for the one before.
struct LaneSummary {
    static constexpr std::size_t kLanes = 8;
    static constexpr std::array<double, kLanes> all(double value) {
        std::array<double, kLanes> lanes;
        lanes.fill(value);
        return lanes;
    }

    std::array<double, kLanes> least = all(std::numeric_limits<double>::infinity());
    std::array<double, kLanes> most = all(-std::numeric_limits<double>::infinity());
    std::array<double, kLanes> sums{};
};

// Adds values, none of which is NaN. Only the last call for a summary may add a count that is not a
// multiple of eight.
void add_values(const float* values, std::size_t count, LaneSummary& summary);

// Writes the bin of each value, floor((value - low) * scale) but at most bins - 1; `bins` itself
// for a value outside [low, high] and for a NaN.
void find_bins(const float* values, std::size_t count, const std::array<double, 2>& range,
               double scale, int bins, std::int32_t* out);

// Converts as half_of_float and float_of_half do (math/half_conversion.h).
void halves_of_floats(const float* values, std::size_t count, std::uint16_t* out);
void floats_of_halves(const std::uint16_t* halves, std::size_t count, float* out);

// Writes floor(255 value + 1/2) of values in [0, 1]. The product is exact in double.
void bytes_of_floats(const float* values, std::size_t count, std::uint8_t* out);

}  // namespace skybake
