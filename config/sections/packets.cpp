#include "config/sections/packets.h"

#include <algorithm>
#include <iterator>

#include "config/sections/spectral_air.h"

namespace skybake::config {

int packet_count(const Parameters& parameters) {
    const std::size_t count = parameters.wavelengths.size();
    return static_cast<int>((count + wavelengths_per_packet - 1) / wavelengths_per_packet);
}

PacketRange packet_range(const Parameters& parameters, int packet) {
    const std::size_t all = parameters.wavelengths.size();
    if (packet == 0) return {0, all};
    const std::size_t first = wavelengths_per_packet * static_cast<std::size_t>(packet - 1);
    return {first, std::min(wavelengths_per_packet, all - first)};
}

Parameters packet_of(const Parameters& parameters, int packet) {
    if (packet == 0) return parameters;
    const PacketRange range = packet_range(parameters, packet);
    Parameters part = parameters;
    const auto begin = std::next(parameters.wavelengths.begin(), static_cast<long>(range.first));
    part.wavelengths = {begin, std::next(begin, static_cast<long>(range.count))};
    part.atmosphere = channels_of(parameters.atmosphere, range.first, range.count);
    return part;
}

}  // namespace skybake::config
