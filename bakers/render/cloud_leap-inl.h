// How a ray gets over empty cells, one ray in each lane.
//
// Included once per target (see Highway's foreach_target.h), so no ordinary include guard.
#if defined(SKYBAKE_BAKERS_PREVIEW_CLOUD_LEAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_PREVIEW_CLOUD_LEAP_INL_H_
#undef SKYBAKE_BAKERS_PREVIEW_CLOUD_LEAP_INL_H_
#else
#define SKYBAKE_BAKERS_PREVIEW_CLOUD_LEAP_INL_H_
#endif

#include <bit>
#include <cstdint>

#include "bakers/render/cloud_path-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// 1 / direction; where a coordinate hardly moves, 2^60 of the unit stands for never, so that no
// product with it overflows.
HWY_INLINE FloatLanes pace_of(FloatLanes direction) {
    const FloatMask still =
        (FloatLanes(-0x1p-60F) < direction) & (direction < FloatLanes(0x1p-60F));
    return select(still, FloatLanes(0x1p60F),
                  FloatLanes(1.0F) / select(still, FloatLanes(1.0F), direction));
}

// Of a path, per lane: metres per voxel.
struct Pace {
    FloatLanes x, y, z;
};

// Places from `low` to below `high`.
struct Interval {
    FloatLanes low, high;

    HWY_INLINE FloatMask contains(FloatLanes x) const { return (low <= x) & (x < high); }
};

// A cell along one axis and everything within its reach.
HWY_INLINE Interval interval_about(IntLanes cell, int shift, int size, FloatLanes tile,
                                   FloatLanes reach) {
    const FloatLanes first = to_float(shifted_left(cell, shift));
    const FloatLanes last = minimum(to_float(shifted_left(cell + IntLanes(1), shift)),
                                    FloatLanes(static_cast<float>(size)));
    return {(tile + first) - reach, (tile + last) + reach};
}

// About the distance at which a coordinate leaves an interval. `pace` is 1 / direction.
HWY_INLINE FloatLanes exit_distance(FloatLanes origin, FloatLanes pace, const Interval& within) {
    const FloatLanes face = select(FloatLanes(0.0F) < pace, within.high, within.low);
    return (face - origin) * pace;
}

// Of lanes that are `looking` at sample k, those whose cell is empty; these get `next`: the first
// sample that is not known to be in empty cells, or `end`.
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

    // Geometry says about where the samples within the box end. Positions go one way along each
    // axis, their roundings too: if the last of them is within it, all are.
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

// Which lanes look into the volume at their sample; of the others that are going, those that stand
// in empty cells have leapt on. A lane looks for an empty cell only after a sample that was
// nothing: in clouds there is none. Where few lanes are left to look into the volume, they wait
// for the others to leap.
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

#endif  // SKYBAKE_BAKERS_PREVIEW_CLOUD_LEAP_INL_H_
