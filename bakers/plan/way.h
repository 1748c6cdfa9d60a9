// The ways in which a runtime may draw something, each with the assets that it needs, and what was measured
// of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/plan/choose_way.h"

namespace skybake {

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
