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
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The voxels first ... last of one axis, counted in cells from the first voxel's cell.
struct Extent {
    std::int64_t cell = 0;  // of the first voxel
    int cells = 0;          // the cells that voxels lie in
    float low = 0;          // position of the first voxel
    float high = 0;         // and of the last
};

HWY_INLINE Extent extent_of(const AxisCells& axis, int first, int count) {
    const auto from = static_cast<std::size_t>(first);
    const auto to = from + static_cast<std::size_t>(count) - 1;
    const int span = axis.cell[to] - axis.cell[from];
    return {axis.cell[from], span + 1, axis.fraction[from],
            static_cast<float>(span) + axis.fraction[to]};
}

// The points of cells, of which planes hold the places.
class CellPoints {
  public:
    explicit CellPoints(const CellField& field) : key_(field.key), shift_(field.shift) {}
    RowKey keys(std::uint32_t y, std::uint32_t z) const { return row_key(key_, y, z); }
    // Returns the points that it stores.
    HWY_INLINE CellPointVector store(RowKey key, WordVector scaled_x, LatticePlanes& planes,
                                     std::size_t at) const {
        const Floats floats;
        const CellPointVector point = cell_point(in_all_lanes(key), scaled_x, shift_);
        hn::StoreU(point.x, floats, planes.x.data() + at);
        hn::StoreU(point.y, floats, planes.y.data() + at);
        hn::StoreU(point.z, floats, planes.z.data() + at);
        return point;
    }

  private:
    std::uint64_t key_;
    PathShift shift_;
};

// Hashes a plane into its slot. points.keys(y, z) returns what the points of a lattice row share,
// and points.store(keys, scaled_x, planes, at) writes what the planes hold of a vector of them.
template <class Points>
void hash_plane(std::int64_t plane, std::size_t slot, LatticePlanes& planes, const Points& points) {
    const Words words;
    const std::uint32_t z = wrapped_cell(plane, planes.frequency[2]);
    for (std::size_t j = 0; j < static_cast<std::size_t>(planes.count[1]); ++j) {
        const std::uint32_t y =
            wrapped_cell(planes.first[1] + static_cast<std::int64_t>(j), planes.frequency[1]);
        const auto keys = points.keys(y, z);
        const std::size_t row = planes.row(slot, j);
        for (std::size_t i = 0; i < static_cast<std::size_t>(planes.count[0]);
             i += hn::Lanes(words)) {
            points.store(keys, hn::LoadU(words, planes.scaled_x.data() + i), planes, row + i);
        }
    }
    planes.plane_of_slot[slot] = plane;
}

// Returns the slot of the plane, after hashing the plane if the slot does not hold it.
template <class Points>
HWY_INLINE std::size_t slot_of_plane(std::int64_t plane, LatticePlanes& planes,
                                     const Points& points) {
    const std::int64_t slots = planes.count[2];
    const auto slot = static_cast<std::size_t>(plane - floor_divide(plane, slots) * slots);
    if (planes.plane_of_slot[slot] != plane) hash_plane(plane, slot, planes, points);
    return slot;
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_LATTICE_PLANES_INL_H_
