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
namespace skybake::HWY_NAMESPACE {

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

// A box along the axes.
struct EmptyBox {
    Interval x, y, z;
};

// Returns those of the lanes `looking` whose cell is empty, and the box about each that is.
HWY_INLINE FloatMask empty_box(const CloudMedium& medium, const Place& at, FloatMask looking,
                               EmptyBox& box) {
    const LeapGrid& grid = medium.leaps;
    const std::array<int, 3>& size = medium.volume.size;
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    const CellPlace cell = cell_place(grid, at, looking);
    const FloatLanes reach = gather(grid.reach.data(), index_of(grid, cell));
    box = {interval_about(cell.x, shift, size[0], at.tile_x, reach),
           interval_about(cell.y, shift, size[1], at.tile_y, reach),
           interval_about(cell.z, shift, size[2], FloatLanes(0.0F), reach)};
    return looking & (FloatLanes(0.0F) <= reach);
}

// Returns the part of an interval that lies between the tile's margins, or in the margin of the
// nearest border. `begin` is where the tile begins.
HWY_INLINE Interval within_margin(const Interval& interval, const TileBorder& border,
                                  FloatLanes begin, float size, float margin) {
    const FloatLanes nearest = begin + maximum(border.to_neighbour, FloatLanes(0.0F));
    const FloatLanes low =
        select(border.near, nearest - FloatLanes(margin), begin + FloatLanes(margin));
    const FloatLanes high =
        select(border.near, nearest + FloatLanes(margin), begin + FloatLanes(size - margin));
    return {maximum(interval.low, low), minimum(interval.high, high)};
}

HWY_INLINE void intersect(FloatMask lanes, const Interval& other, Interval& interval) {
    interval.low = select(lanes, maximum(interval.low, other.low), interval.low);
    interval.high = select(lanes, minimum(interval.high, other.high), interval.high);
}

// Does the same as empty_box for tiles that vary: the box is empty in all copies that reach it.
HWY_INLINE FloatMask varied_empty_box(const CloudMedium& medium, const Place& at, FloatMask looking,
                                      EmptyBox& box) {
    FloatMask empty = empty_box(medium, at, looking, box);
    if (!any(empty)) return empty;
    const TileVariation& variation = medium.variation;
    const TileBorders borders = nearest_borders(medium, at);
    box.x = within_margin(box.x, borders.x, (at.tile_x + at.x) - at.local_x,
                          static_cast<float>(medium.volume.size[0]), variation.margin_x);
    box.y = within_margin(box.y, borders.y, (at.tile_y + at.y) - at.local_y,
                          static_cast<float>(medium.volume.size[1]), variation.margin_y);
    for_neighbours(borders, empty, [&](bool x, bool y, FloatMask lanes) HWY_ATTR {
        EmptyBox other;
        const Place place = in_neighbour(medium, at, borders, x, y);
        const FloatMask also = empty_box(medium, place, lanes, other);
        empty = and_not(empty, and_not(lanes, also));
        intersect(also, other.x, box.x);
        intersect(also, other.y, box.y);
        intersect(also, other.z, box.z);
    });
    return empty;
}

// Returns those of the lanes `looking` at sample k whose cell is empty. For these lanes, `next` is
// the first sample that is not known to be in empty cells, or `end`.
HWY_INLINE FloatMask leap(const CloudPath& path, const Pace& pace, const Place& at,
                          FloatMask looking, FloatLanes k, FloatLanes end, FloatLanes& next) {
    EmptyBox box;
    const FloatMask empty = path.medium.variation.varies()
                                ? varied_empty_box(path.medium, at, looking, box)
                                : empty_box(path.medium, at, looking, box);
    if (!any(empty)) return empty;
    const FloatLanes exit = minimum(exit_distance(path.origin_x, pace.x, box.x),
                                    minimum(exit_distance(path.origin_y, pace.y, box.y),
                                            exit_distance(path.origin_z, pace.z, box.z)));

    // The exit distance gives a first guess of where the samples within the box end. Positions are
    // monotonic along each axis, even after rounding, so if the last sample is within the box, all
    // are.
    const FloatLanes at_least = k + FloatLanes(1.0F);
    next = minimum(maximum(path.samples.first_beyond(exit), at_least), end);
    for (;;) {
        const FloatLanes t = path.samples.distance(zero_unless(empty, next - FloatLanes(1.0F)));
        const FloatMask inside = box.x.contains(path.x_at(t)) & box.y.contains(path.y_at(t)) &
                                 box.z.contains(path.z_at(t));
        const FloatMask too_far = and_not(empty & (at_least < next), inside);
        if (!any(too_far)) return empty;
        next = select(too_far, next - FloatLanes(1.0F), next);
    }
}

// Returns the lanes that look into the volume at their sample. Among the other lanes that are going,
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

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_CLOUD_LEAP_INL_H_
