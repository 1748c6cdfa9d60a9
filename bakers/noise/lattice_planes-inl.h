// Fills lattice planes, for any kind of random vector at their points.
#if defined(SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_
#undef SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/lattice_hash.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Hashes a plane into its slot. hash(row_key, scaled_x) returns a vector of x, y and z.
template <class Hash>
void hash_plane(std::int64_t plane, std::size_t slot, LatticePlanes& planes, const Hash& hash) {
    const Words words;
    const Floats floats;
    const std::uint32_t z = wrapped_cell(plane, planes.frequency[2]);
    for (std::size_t j = 0; j < static_cast<std::size_t>(planes.count[1]); ++j) {
        const std::uint32_t y =
            wrapped_cell(planes.first[1] + static_cast<std::int64_t>(j), planes.frequency[1]);
        const RowKey key = row_key(planes.key, y, z);
        const std::size_t row = planes.row(slot, j);
        for (std::size_t i = 0; i < static_cast<std::size_t>(planes.count[0]);
             i += hn::Lanes(floats)) {
            const auto point = hash(key, hn::LoadU(words, planes.scaled_x.data() + i));
            hn::StoreU(point.x, floats, planes.x.data() + row + i);
            hn::StoreU(point.y, floats, planes.y.data() + row + i);
            hn::StoreU(point.z, floats, planes.z.data() + row + i);
        }
    }
    planes.plane_of_slot[slot] = plane;
}

// Returns the slot of the plane, after hashing the plane if the slot does not hold it.
template <class Hash>
HWY_INLINE std::size_t slot_of_plane(std::int64_t plane, LatticePlanes& planes, const Hash& hash) {
    const std::int64_t slots = planes.count[2];
    const auto slot = static_cast<std::size_t>(plane - floor_divide(plane, slots) * slots);
    if (planes.plane_of_slot[slot] != plane) hash_plane(plane, slot, planes, hash);
    return slot;
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_
