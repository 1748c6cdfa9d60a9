// This header says how assets hold more wavelengths than a texture has channels: in packets, one
// after the other in the order of the recipe. All have four wavelengths but the last, which may have
// fewer. An asset holds one packet, and the recipe has an asset for each.
#pragma once

#include <cstddef>

#include "config/sections/parameters.h"

namespace skybake::config {

inline constexpr std::size_t wavelengths_per_packet = 4;

// Returns the number of packets of a recipe: 1 if a texture has a channel for each wavelength.
int packet_count(const Parameters& parameters);

// Returns the place of a packet's first wavelength among those of the recipe, and the number of
// its wavelengths.
struct PacketRange {
    std::size_t first = 0;
    std::size_t count = 0;
};
PacketRange packet_range(const Parameters& parameters, int packet);

// Returns a recipe's parameters at the wavelengths of one packet; of packet 0, all of them.
Parameters packet_of(const Parameters& parameters, int packet);

}  // namespace skybake::config
