// Chooses among measured ways: the front that no other way beats, its knee, and what limits leave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace skybake {

// The costs of a way at run time, and how far its picture is off.
struct WayFigures {
    double error = 0;  // ninth decile, relative
    double fetches = 0;
    double bytes = 0;       // of textures
    double operations = 0;  // of the lookups; those that run at a quarter of the rate count as four
};

struct WayLimits {
    std::optional<double> error, fetches, bytes;
    bool any() const { return error || fetches || bytes; }
};

// Whether the way keeps all limits.
bool keeps(const WayLimits& limits, const WayFigures& way);

// Tells for each way whether none of the others is at least as good in error, fetches, operations and
// bytes and better in one of them. Of equal ways the first is on the front.
std::vector<bool> front_of(std::span<const WayFigures> ways);

// Returns the way that keeps the limits and is least in what has no limit, compared in the order
// error, fetches, operations, bytes; if all have limits, least in error. Without a limit of error, errors that are
// within `noise` of the least count as equal. It is on the front. None keeps them: no way.
std::optional<std::size_t> best_within(const WayLimits& limits, std::span<const WayFigures> ways,
                                       double noise);

// Returns the knee of the front: the way with the least product of its error, the root of its fetches
// and the fourth root of its bytes. Half the error is so worth four times the fetches, as it is of a sum
// of random samples, or sixteen times the bytes, of a table along four axes. Fewer bytes than a first
// cache holds, such as the 128 KiB of a multiprocessor of NVIDIA's GA102, are worth nothing.
inline constexpr double kCachedBytes = 1 << 17;
std::size_t knee_of(std::span<const WayFigures> ways);

}  // namespace skybake
