// From the keys of an octave series (frequency, octaves, lacunarity, gain) to the list that it
// stands for: one frequency and one gain per octave.
#pragma once

#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/sections/noise.h"

namespace skybake::config {

// The keys of one series of a channel's section.
struct OctaveKeys {
    std::string_view frequency, octaves, lacunarity, frequencies, gain, gains;
};

inline constexpr OctaveKeys plain_octave_keys{"frequency",   "octaves", "lacunarity",
                                              "frequencies", "gain",    "gains"};
inline constexpr OctaveKeys worley_octave_keys{"worley_frequency",  "worley_octaves",
                                               "worley_lacunarity", "worley_frequencies",
                                               "worley_gain",       "worley_gains"};

// Fills in `frequencies` and `gains` of the section, and returns them; nothing where the channel's
// type has no such octaves, or a key is at fault. Errors: a frequency above its range (E0128), as
// many gains as octaves are not given (E0108).
NoiseOctaves resolve_octaves(DecodedSection& channel, const OctaveKeys& keys, Decoder& decoder);

}  // namespace skybake::config
