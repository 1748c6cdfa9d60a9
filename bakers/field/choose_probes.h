// Chooses the places of a texture's probes so that a wrong file is detected.
//
// Each of many candidate places is tried with every wrong lookup of wrong_lookups.h. A wrong lookup
// shows at a place if it is off by more than twice the tolerance of a probe there: once for the
// right lookup and once for the wrong one. Probes are taken until each wrong lookup shows at
// several of them. Further probes are placed where most wrong lookups show most clearly, and such
// places are also preferred among equals. A wrong lookup that shows nowhere is ignored: constant
// noise is the same upside down. If a wrong lookup shows at few places and the texture is not large,
// every texel is tried; if it still shows at few places, probes take those that exist. The probes
// catch all other wrong lookups, and the manifest lists which ones.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/field/wrong_lookups.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// A texture as a file holds it.
struct ProbedTexture {
    ReadableTexture texture;
    int dimensions = 3;
    PixelType type = PixelType::float32;
    std::vector<double> largest;  // per channel: the largest absolute value
};

// The physical coordinates of an error or of a probe: {"altitude_km", 0.5}.
using Place = std::vector<std::pair<std::string, double>>;

// A place that a probe may have.
struct ProbePlace {
    Place at;
    std::vector<ProbeLookup> lookups;
};

// Returns the place nearest to the coordinates `wanted`, in [0, 1], that a runtime can look up. The
// asset decides what the coordinates mean.
using ProbePlaces = std::function<ProbePlace(const std::array<double, 3>& wanted)>;

// Candidate places in order of preference. A table that consists of several tables, one below the
// other, has one list for each of them.
struct ProbeSpace {
    ProbePlaces place;
    std::vector<std::array<double, 3>> wanted;
};

// A probe's value and the largest allowed error of a lookup. The tolerance allows for filtering in
// steps of 1/256 texel, rounded or truncated, and for a few roundings of the pixel type. It is
// never 0.
struct ProbeValue {
    std::vector<double> value;
    std::vector<double> tolerance;
};
ProbeValue probe_value(const ProbedTexture& texture, const std::vector<ProbeLookup>& lookups);

struct TakenProbe {
    ProbePlace place;
    ProbeValue value;
};

struct ProbeSet {
    std::vector<TakenProbe> probes;
    std::vector<std::string> catches;  // names of wrong lookups
    std::vector<std::string> missed;   // wrong lookups that show, but at too few known places
};

// Takes at least `count` probes, an equal share from each space.
ProbeSet take_probes(const ProbedTexture& texture, const std::vector<ProbeSpace>& spaces, int count,
                     const BakeOptions& options);

// Returns E0407 if the probes miss a wrong lookup.
[[nodiscard]] std::optional<Diagnostic> weak_probes(const std::string& asset, const ProbeSet& set);

// Returns a level as its file holds it. The level has been surveyed.
ProbedTexture probed_texture(const Level& level, int dimensions, PixelType type);

// Takes probes for a level, or returns E0407.
[[nodiscard]] std::optional<Diagnostic> set_probes(const std::string& asset,
                                                   const ProbedTexture& texture,
                                                   const std::vector<ProbeSpace>& spaces, int count,
                                                   const BakeOptions& options, Level& level);

}  // namespace skybake
