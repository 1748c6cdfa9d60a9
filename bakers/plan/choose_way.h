// Chooses among measured ways: the front that no other way beats, its knee, and what limits leave.
//
// The ways in which a runtime may draw something, each with the assets that it needs, and what was measured
// of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/conventions.h"

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

// One asset of a way, as a recipe has it.
struct WayAsset {
    std::string name;                                       // of its section in a written recipe
    std::vector<std::pair<std::string, std::string>> keys;  // and their values as TOML
    bool operator==(const WayAsset&) const = default;
};

struct Way {
    std::string by;        // the kind of drawing: "march", "fetch", "picture"
    std::string family;    // "moments of degree 4"
    std::string name;      // what it differs in from others of the family: "32x32, half, 16 steps"
    std::string baseline;  // whose published method it is; or empty
    std::vector<WayAsset> assets;  // `of` names one before it
    int steps = 0;                 // of a march whose steps the runtime chooses
};

// A way as it was measured.
struct MeasuredWay {
    Way way;
    SkyError error;
    WayFigures figures;
    double bake_s = 0;  // wall time of its assets on all threads, light included that others share
    bool on_front = false;
};

// The figures of all ways, and the sheet of their pictures as a PNG.
struct MeasuredWays {
    std::vector<MeasuredWay> ways;
    std::string sheet;
};

}  // namespace skybake
