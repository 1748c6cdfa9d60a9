// Vectors of GLM: glm::dvec3 for places and directions, and a packet of four wavelengths.
//
// Only the types and their operators are included here, since GLM's functions take longer to
// compile than most sources that need a vector; glm::dot is in <glm/geometric.hpp>. GLM's operators
// are one rounded operation on each component, in the order in which they are written, and its
// intrinsics stay off (they are asked for by GLM_FORCE_INTRINSICS alone). GLM's exp, log, sin and
// the like are the C library's and differ between machines: transcendental.h has those that do not.
// Components are subscripted by std::size_t (GLM_FORCE_SIZE_T_LENGTH, set for all units alike).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>

namespace skybake {

// The colour channels that a recipe has at most.
inline constexpr int kMaxChannels = 3;

// A value of each wavelength of a packet of four. A recipe uses the first one to three of them; in
// the others nothing scatters, absorbs or shines: coefficients, depths and radiances are 0 there,
// and transmittances are 1 or 0.
using Spectrum = glm::dvec4;
inline constexpr std::size_t kChannelSlots = 4;  // of a packet in memory

// Its components in memory: GLM's own subscript compares the index with each in turn.
inline double* data(Spectrum& packet) { return &packet.x; }
inline const double* data(const Spectrum& packet) { return &packet.x; }

// The packet that stands at four values in memory.
inline Spectrum packet_at(const double* values) {
    return {values[0], values[1], values[2], values[3]};
}

// The magnitude of each component.
inline Spectrum absolute(const Spectrum& packet) {
    return {std::fabs(packet.x), std::fabs(packet.y), std::fabs(packet.z), std::fabs(packet.w)};
}

// The smaller and the greater of each two components, as std::min and std::max have them.
inline Spectrum minimum(const Spectrum& a, const Spectrum& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}
inline Spectrum maximum(const Spectrum& a, const Spectrum& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}
inline double largest(const Spectrum& packet) {
    return std::max(std::max(packet.x, packet.y), std::max(packet.z, packet.w));
}

// The quotient of each two components, and 0 where the denominator is not positive.
inline Spectrum share_of(const Spectrum& part, const Spectrum& whole) {
    const auto share = [](double a, double b) { return b > 0 ? a / b : 0; };
    return {share(part.x, whole.x), share(part.y, whole.y), share(part.z, whole.z),
            share(part.w, whole.w)};
}

}  // namespace skybake
