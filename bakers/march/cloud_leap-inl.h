// Lets rays leap over empty cells (empty-space skipping), one ray in each lane.
//
// The file is included once per target (see Highway's foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_
#undef SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_
#else
#define SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_
#endif

#include <bit>
#include <cstdint>

#include "bakers/march/cloud_path-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// Returns 1 / direction. If a coordinate hardly changes, the result is 2^60, which means that the
// ray never gets anywhere along it; products with 2^60 do not overflow.
HWY_INLINE FloatLanes pace_of(FloatLanes direction) {
    const FloatMask still =
        (FloatLanes(-0x1p-60F) < direction) & (direction < FloatLanes(0x1p-60F));
    return select(still, FloatLanes(0x1p60F),
                  FloatLanes(1.0F) / select(still, FloatLanes(1.0F), direction));
}

// The metres per voxel of a path along each axis, per lane.
struct Pace {
    FloatLanes x, y, z;
};

// The interval [low, high).
struct Interval {
    FloatLanes low, high;

    HWY_INLINE FloatMask contains(FloatLanes x) const { return (low <= x) & (x < high); }
};

// Returns the interval of a cell along one axis, extended by its reach on both sides.
HWY_INLINE Interval interval_about(IntLanes cell, int shift, int size, FloatLanes tile,
                                   FloatLanes reach) {
    const FloatLanes first = to_float(shifted_left(cell, shift));
    const FloatLanes last = minimum(to_float(shifted_left(cell + IntLanes(1), shift)),
                                    FloatLanes(static_cast<float>(size)));
    return {(tile + first) - reach, (tile + last) + reach};
}

// Returns, up to rounding, the distance at which a coordinate leaves an interval.
// `pace` is 1 / direction.
HWY_INLINE FloatLanes exit_distance(FloatLanes origin, FloatLanes pace, const Interval& within) {
    const FloatLanes face = select(FloatLanes(0.0F) < pace, within.high, within.low);
    return (face - origin) * pace;
}

// Returns those of the lanes `looking` at sample k whose cell is empty. For these lanes, `next` is
// the first sample that is not known to be in empty cells, or `end`.
HWY_INLINE FloatMask leap(const CloudPath& path, const Pace& pace, const Place& at,
                          FloatMask looking, FloatLanes k, FloatLanes end, FloatLanes& next) {
    const LeapGrid& grid = path.medium.leaps;
    const std::array<int, 3>& size = path.medium.volume.size;
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    const CellPlace cell = cell_place(grid, at, looking);
    const FloatLanes reach = gather(grid.reach.data(), index_of(grid, cell));
    const FloatMask empty = looking & (FloatLanes(0.0F) <= reach);
    if (!any(empty)) return empty;

    const Interval x = interval_about(cell.x, shift, size[0], at.tile_x, reach);
    const Interval y = interval_about(cell.y, shift, size[1], at.tile_y, reach);
    const Interval z = interval_about(cell.z, shift, size[2], FloatLanes(0.0F), reach);
    const FloatLanes exit = minimum(
        exit_distance(path.origin_x, pace.x, x),
        minimum(exit_distance(path.origin_y, pace.y, y), exit_distance(path.origin_z, pace.z, z)));

    // The exit distance gives a first guess of where the samples within the box end. Positions are
    // monotonic along each axis, even after rounding, so if the last sample is within the box, all
    // are.
    const FloatLanes at_least = k + FloatLanes(1.0F);
    next = minimum(maximum(path.samples.first_beyond(exit), at_least), end);
    for (;;) {
        const FloatLanes t = path.samples.distance(zero_unless(empty, next - FloatLanes(1.0F)));
        const FloatMask inside =
            x.contains(path.x_at(t)) & y.contains(path.y_at(t)) & z.contains(path.z_at(t));
        const FloatMask too_far = and_not(empty & (at_least < next), inside);
        if (!any(too_far)) return empty;
        next = select(too_far, next - FloatLanes(1.0F), next);
    }
}

// Returns the lanes that look into the volume at their sample. Of the other lanes that are going,
// those in empty cells have leapt. A lane looks for an empty cell only after a sample that was
// empty, because inside clouds there is none. If only few lanes are left to look into the volume,
// they wait for the others to leap.
HWY_INLINE FloatMask leap_or_look(const CloudPath& path, const Pace& pace, const Place& at,
                                  FloatMask going, FloatLanes end, Progress& progress,
                                  std::int64_t& cells) {
    constexpr std::int64_t kFew = static_cast<std::int64_t>(FloatLanes::kCount) / 4;
    const FloatMask looking = going & (FloatLanes(0.0F) < progress.was_empty);
    if (!any(looking)) return going;
    cells += count_of(looking);
    FloatLanes next;
    const FloatMask empty = leap(path, pace, at, looking, progress.k, end, next);
    if (!any(empty)) return going;
    progress.k = select(empty, next, progress.k);
    const FloatMask rest = and_not(going, empty);
    progress.was_empty = select(rest, FloatLanes(0.0F), progress.was_empty);
    return count_of(rest) <= kFew && any(empty & (progress.k < end)) ? and_not(rest, rest) : rest;
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_
