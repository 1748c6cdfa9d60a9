// Places along rays through a cloud, with the cells and the extinction there, one ray in each lane.
//
// The file is included once per target (see Highway's foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MARCH_CLOUD_PATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MARCH_CLOUD_PATH_INL_H_
#undef SKYBAKE_BAKERS_MARCH_CLOUD_PATH_INL_H_
#else
#define SKYBAKE_BAKERS_MARCH_CLOUD_PATH_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include "bakers/march/cloud_medium.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// A place on a ray, in voxels. `x` and `y` are within the volume whose copy begins at tile_x, tile_y.
// If tiles vary, copies begin elsewhere than tiles do, and local_x, local_y are within the tile.
struct Place {
    FloatLanes x, y, z;
    FloatLanes tile_x, tile_y;
    FloatLanes local_x, local_y;
    FloatMask within;  // inside the volume, including both its faces along z
};

// Splits a position into the tile's beginning and the rest in [0, size). All steps are exact,
// except that a place just below a tile's beginning may round to that beginning; this keeps the
// order of places.
HWY_INLINE void split(FloatLanes position, float size, FloatLanes& rest, FloatLanes& tile) {
    const FloatLanes length(size);
    tile = length * floor_of(position * FloatLanes(1 / size));
    rest = position - tile;
    const FloatMask below = rest < FloatLanes(0.0F);
    rest = select(below, rest + length, rest);
    tile = select(below, tile - length, tile);
    const FloatMask beyond = length <= rest;
    rest = select(beyond, rest - length, rest);
    tile = select(beyond, tile + length, tile);
}

// The two voxels around a coordinate: the index of the first in a padded axis, and the weight of
// the second.
struct Taps {
    IntLanes index;
    FloatLanes weight;
};
HWY_INLINE Taps taps_at(FloatLanes x) {
    const FloatLanes before = floor_of(x - FloatLanes(0.5F));
    return {to_int(before + FloatLanes(1.0F)), (x - FloatLanes(0.5F)) - before};
}

HWY_INLINE FloatLanes mixed(FloatLanes a, FloatLanes b, FloatLanes t) { return a + t * (b - a); }

HWY_INLINE FloatLanes lookup(const PaddedVolume& volume, FloatLanes x, FloatLanes y, FloatLanes z) {
    const Taps tx = taps_at(x);
    const Taps ty = taps_at(y);
    const Taps tz = taps_at(z);
    const std::ptrdiff_t row = volume.row();
    const std::ptrdiff_t plane = volume.plane();
    const IntLanes index = tz.index * IntLanes(static_cast<std::int32_t>(plane)) +
                           ty.index * IntLanes(static_cast<std::int32_t>(row)) + tx.index;
    const auto along_x = [&](std::ptrdiff_t offset) HWY_ATTR {
        const float* first = volume.values.data() + offset;
        return mixed(gather(first, index), gather(first + 1, index), tx.weight);
    };
    return mixed(mixed(along_x(0), along_x(row), ty.weight),
                 mixed(along_x(plane), along_x(plane + row), ty.weight), tz.weight);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "bakers/march/tile_variation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The samples along a ray, as cloud_rays.h spaces them.
struct CloudSamples {
    FloatLanes jitter;
    float step_m;
    float steps_per_m;
    float growth = 0;

    HWY_INLINE FloatLanes distance(FloatLanes k) const {
        const FloatLanes u = k + jitter;
        return u * FloatLanes(step_m) * (FloatLanes(1.0F) + FloatLanes(growth) * u);
    }
    // Returns the length that sample k stands for.
    HWY_INLINE FloatLanes length(FloatLanes k) const {
        return FloatLanes(step_m) *
               (FloatLanes(1.0F) + FloatLanes(growth) * (k + k + FloatLanes(1.0F)));
    }
    // Returns, up to rounding, the first sample at or beyond a distance. Nothing is beyond negative ones.
    HWY_INLINE FloatLanes first_beyond(FloatLanes distance_m) const {
        const FloatLanes even = maximum(distance_m * FloatLanes(steps_per_m), FloatLanes(0.0F));
        const FloatLanes stretch = square_root(FloatLanes(1.0F) + FloatLanes(4.0F * growth) * even);
        return ceil_of((even + even) / (FloatLanes(1.0F) + stretch) - jitter);
    }
};

// One ray per lane, with its samples.
struct CloudPath {
    const CloudMedium& medium;
    FloatLanes origin_x, origin_y, origin_z;           // voxels
    FloatLanes direction_x, direction_y, direction_z;  // voxels per metre
    CloudSamples samples;

    HWY_INLINE FloatLanes x_at(FloatLanes t) const { return origin_x + t * direction_x; }
    HWY_INLINE FloatLanes y_at(FloatLanes t) const { return origin_y + t * direction_y; }
    HWY_INLINE FloatLanes z_at(FloatLanes t) const { return origin_z + t * direction_z; }

    HWY_INLINE FloatMask in_first_tile(const Place& place) const {
        const FloatLanes zero(0.0F);
        return (place.tile_x <= zero) & (zero <= place.tile_x) & (place.tile_y <= zero) &
               (zero <= place.tile_y);
    }

    HWY_INLINE Place place(FloatLanes t) const {
        Place place;
        split(x_at(t), static_cast<float>(medium.volume.size[0]), place.x, place.tile_x);
        split(y_at(t), static_cast<float>(medium.volume.size[1]), place.y, place.tile_y);
        place.z = z_at(t);
        const FloatLanes top(static_cast<float>(medium.volume.size[2]));
        place.local_x = place.x;
        place.local_y = place.y;
        if (medium.variation.varies()) shift_into_copy(medium, place);
        place.within = (FloatLanes(0.0F) <= place.z) & (place.z <= top);
        if (!medium.repeats) place.within = place.within & in_first_tile(place);
        return place;
    }
};

// The cell of a place, for the lanes in `wanted`.
struct CellPlace {
    IntLanes x, y, z;
};
HWY_INLINE CellPlace cell_place(const LeapGrid& grid, const Place& at, FloatMask wanted) {
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    // The volume's top belongs to the highest cell.
    return {shifted_right(to_int(at.x), shift), shifted_right(to_int(at.y), shift),
            minimum(shifted_right(to_int(zero_unless(wanted, at.z)), shift),
                    IntLanes(grid.cells[2] - 1))};
}
HWY_INLINE IntLanes index_of(const LeapGrid& grid, const CellPlace& cell) {
    return (cell.z * IntLanes(grid.cells[1]) + cell.y) * IntLanes(grid.cells[0]) + cell.x;
}

// Returns the extinction in 1/m for the lanes in `wanted`, and 0 for the others.
HWY_INLINE FloatLanes extinction(const CloudMedium& medium, const Place& at, FloatMask wanted) {
    const CloudOptics& optics = medium.optics;
    const FloatLanes z = zero_unless(wanted, at.z);
    const FloatLanes value = medium.variation.varies() ? varied_lookup(medium, at, z, wanted)
                                                       : lookup(medium.volume, at.x, at.y, z);
    const FloatMask visible = wanted & (FloatLanes(medium.visible_above) < value);
    FloatLanes sigma = value * FloatLanes(static_cast<float>(optics.extinction_per_m));
    if (optics.has_edge && optics.edge_softness > 0) {
        const FloatLanes above = value - FloatLanes(static_cast<float>(optics.threshold));
        const FloatLanes x =
            minimum(above / FloatLanes(static_cast<float>(optics.edge_softness)), FloatLanes(1.0F));
        sigma = sigma * (x * x * (FloatLanes(3.0F) - (x + x)));
    }
    return zero_unless(visible, sigma);
}

// The progress of each lane: it is at sample k, and the sample before it was empty or not.
struct Progress {
    FloatLanes k;
    FloatLanes was_empty;  // 1 or 0
};

// Moves the lanes in `sampled` on to the next sample.
HWY_INLINE void step_on(FloatMask sampled, FloatLanes sigma, Progress& progress) {
    const FloatLanes empty = select(FloatLanes(0.0F) < sigma, FloatLanes(0.0F), FloatLanes(1.0F));
    progress.was_empty = select(sampled, empty, progress.was_empty);
    progress.k = select(sampled, progress.k + FloatLanes(1.0F), progress.k);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_CLOUD_PATH_INL_H_
