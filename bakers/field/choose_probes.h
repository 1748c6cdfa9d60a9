// Which places of a texture its probes are taken at: those where a wrong file shows.
//
// Many places are looked at, each with every wrong lookup of wrong_lookups.h. A wrong lookup shows
// at a place where it is off by more than twice the tolerance of a probe there, once for the right
// lookup and once for the wrong one. Probes are taken until each wrong lookup shows at several of
// them; the rest, and those that are preferred among equals, lie where most wrong lookups show by
// far. A wrong lookup that shows nowhere is none: constant noise is the same upside down. Where one
// shows at few places, a small texture is looked at in every texel: if it has no more such places,
// probes lie at those there are. The probes catch the others, and a manifest says which.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/wrong_lookups.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

// A texture as a file holds it.
struct ProbedTexture {
    ReadableTexture texture;
    int dimensions = 3;
    config::PixelType type = config::PixelType::float32;
    std::vector<double> largest;  // per channel: the largest absolute value
};

// The physical coordinates of an error or of a probe: {"altitude_km", 0.5}.
using Place = std::vector<std::pair<std::string, double>>;

// A place that a probe may have.
struct ProbePlace {
    Place at;
    std::vector<ProbeLookup> lookups;
};

// The nearest place that a runtime can ask for to coordinates in [0, 1], whatever an asset counts
// places in.
using ProbePlaces = std::function<ProbePlace(const std::array<double, 3>& wanted)>;

// Places that are to be looked at, in order of preference. A table that is made of several, one
// below the other, has a list for each.
struct ProbeSpace {
    ProbePlaces place;
    std::vector<std::array<double, 3>> wanted;
};

// A probe's value and how far a lookup may be off it: filtering in 1/256 of a texel, rounded or
// truncated, and a few roundings of the pixel type, never nothing.
struct ProbeValue {
    std::vector<double> value;
    std::vector<double> tolerance;
};
ProbeValue probe_value(const ProbedTexture& texture, const std::vector<ProbeLookup>& lookups);

struct TakenProbe {
    ProbePlace place;
    ProbeValue value;
};

Probe as_probe(TakenProbe taken);

struct ProbeSet {
    std::vector<TakenProbe> probes;
    std::vector<std::string> catches;  // names of wrong lookups
    std::vector<std::string> missed;   // wrong lookups that show, but at too few known places
};

// Takes `count` probes or more, of several spaces a share of each.
ProbeSet take_probes(const ProbedTexture& texture, const std::vector<ProbeSpace>& spaces, int count,
                     const BakeOptions& options);

// E0407 where probes miss something.
[[nodiscard]] std::optional<config::Diagnostic> weak_probes(const std::string& asset,
                                                            const ProbeSet& set);

}  // namespace skybake
