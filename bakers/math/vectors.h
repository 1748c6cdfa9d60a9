// Vectors of GLM: glm::dvec3 for places and directions, and a packet of four wavelengths.
//
// Only the types and their operators are included here, since GLM's functions take longer to
// compile than most sources that need a vector; glm::dot is in <glm/geometric.hpp>. Each operator
// of GLM is one rounded operation per component, in the order in which it is written. GLM's
// intrinsics stay off (only GLM_FORCE_INTRINSICS turns them on). GLM's exp, log, sin and the like
// are the C library's, which differ between machines: transcendental.h has functions that do not.
// Subscripts of components are std::size_t (GLM_FORCE_SIZE_T_LENGTH, set for every translation
// unit).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>

namespace skybake {

// The largest number of wavelengths that are computed at a time, and of channels of a table.
inline constexpr int kMaxChannels = 4;

// One value for each wavelength of a packet of four. A recipe of fewer wavelengths uses the first ones.
// In the unused ones nothing scatters, absorbs or shines: coefficients, depths and radiances are 0
// there, and transmittances are 1 or 0.
using Spectrum = glm::dvec4;
inline constexpr std::size_t kChannelSlots = 4;  // numbers of a packet in memory

// The components as an array in memory. GLM's own subscript compares the index with each component
// in turn.
inline double* data(Spectrum& packet) { return &packet.x; }
inline const double* data(const Spectrum& packet) { return &packet.x; }

// Returns the packet that is stored at four consecutive values in memory.
inline Spectrum packet_at(const double* values) {
    return {values[0], values[1], values[2], values[3]};
}

// Returns the magnitude of each component.
inline Spectrum absolute(const Spectrum& packet) {
    return {std::fabs(packet.x), std::fabs(packet.y), std::fabs(packet.z), std::fabs(packet.w)};
}

// Return the smaller or the greater of each pair of components, as std::min and std::max do.
inline Spectrum minimum(const Spectrum& a, const Spectrum& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}
inline Spectrum maximum(const Spectrum& a, const Spectrum& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}
inline double largest(const Spectrum& packet) {
    return std::max(std::max(packet.x, packet.y), std::max(packet.z, packet.w));
}

// Returns the quotient of each pair of components, and 0 where the denominator is not positive.
inline Spectrum share_of(const Spectrum& part, const Spectrum& whole) {
    const auto share = [](double a, double b) { return b > 0 ? a / b : 0; };
    return {share(part.x, whole.x), share(part.y, whole.y), share(part.z, whole.z),
            share(part.w, whole.w)};
}

}  // namespace skybake
