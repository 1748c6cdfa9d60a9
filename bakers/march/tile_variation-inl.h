// Lookups of a tile whose copies vary (TileVariation of cloud_medium.h), one place in each lane.
//
// Within a margin about a border, the copies on both sides are eroded and the greater value counts:
//
//   v = max_i (v_i - e_i v_max),   e = max(0, 1 - kOverlap w)
//
// where the weight w of a copy rises smoothly from 0 at the margin's far end over 1/2 at the border to
// 1 at its near end. So clouds shrink towards the end of their copy instead of fading, and a copy
// ends where nothing of it is left. kOverlap lets both copies reach across the border, without which
// the erosion would leave a clear line.
//
// The file is included once per target (see Highway's foreach_target.h), so it has no ordinary
// include guard. cloud_path-inl.h includes it after Place and lookup().
#if defined(SKYBAKE_BAKERS_MARCH_TILE_VARIATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MARCH_TILE_VARIATION_INL_H_
#undef SKYBAKE_BAKERS_MARCH_TILE_VARIATION_INL_H_
#else
#define SKYBAKE_BAKERS_MARCH_TILE_VARIATION_INL_H_
#endif

#include "bakers/march/cloud_medium.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

constexpr float kOverlap = 1.6F;

// Returns the index of a tile's shift from where the tile begins, in voxels.
HWY_INLINE IntLanes shift_index(const CloudMedium& medium, FloatLanes begin_x, FloatLanes begin_y) {
    constexpr float count = kVariedTiles;
    const auto number = [&](FloatLanes begin, int size) HWY_ATTR {
        const FloatLanes tile =
            floor_of(begin * FloatLanes(1 / static_cast<float>(size)) + FloatLanes(0.5F));
        return tile - FloatLanes(count) * floor_of(tile * FloatLanes(1 / count));
    };
    return to_int(number(begin_y, medium.volume.size[1]) * FloatLanes(count) +
                  number(begin_x, medium.volume.size[0]));
}

// Moves a place from its tile into the copy that the tile shows.
HWY_INLINE void shift_into_copy(const CloudMedium& medium, Place& place) {
    const TileVariation& variation = medium.variation;
    const FloatLanes begin_x = place.tile_x;
    const FloatLanes begin_y = place.tile_y;
    const IntLanes index = shift_index(medium, begin_x, begin_y);
    const FloatLanes shift_x = gather(variation.shift_x.data(), index);
    const FloatLanes shift_y = gather(variation.shift_y.data(), index);
    split(place.local_x + shift_x, static_cast<float>(medium.volume.size[0]), place.x,
          place.tile_x);
    split(place.local_y + shift_y, static_cast<float>(medium.volume.size[1]), place.y,
          place.tile_y);
    place.tile_x = (begin_x - shift_x) + place.tile_x;
    place.tile_y = (begin_y - shift_y) + place.tile_y;
}

// The nearest border of a tile along one axis.
struct TileBorder {
    FloatMask near;           // the place is in the border's margin
    FloatLanes to_neighbour;  // from the beginning of the tile to that beyond the border
    FloatLanes own, beyond;   // the erosion e of the tile and of that beyond
};

HWY_INLINE TileBorder nearest_border(FloatLanes local, int size, float margin) {
    const FloatLanes length(static_cast<float>(size));
    const FloatMask high = FloatLanes(0.5F) * length < local;
    const FloatLanes distance = select(high, length - local, local);
    const FloatLanes x = minimum(distance * FloatLanes(1 / margin), FloatLanes(1.0F));
    const FloatLanes half = FloatLanes(0.5F) * (x * x * (FloatLanes(3.0F) - (x + x)));
    const auto erosion = [](FloatLanes weight) HWY_ATTR {
        return maximum(FloatLanes(1.0F) - FloatLanes(kOverlap) * weight, FloatLanes(0.0F));
    };
    return {distance < FloatLanes(margin), select(high, length, FloatLanes(0.0F) - length),
            erosion(FloatLanes(0.5F) + half), erosion(FloatLanes(0.5F) - half)};
}

struct TileBorders {
    TileBorder x, y;
};
HWY_INLINE TileBorders nearest_borders(const CloudMedium& medium, const Place& at) {
    return {nearest_border(at.local_x, medium.volume.size[0], medium.variation.margin_x),
            nearest_border(at.local_y, medium.volume.size[1], medium.variation.margin_y)};
}

// Returns where the same place is in the copy of a neighbouring tile.
HWY_INLINE Place in_neighbour(const CloudMedium& medium, const Place& at,
                              const TileBorders& borders, bool beyond_x, bool beyond_y) {
    Place place = at;
    place.tile_x = (at.tile_x + at.x) - at.local_x;
    place.tile_y = (at.tile_y + at.y) - at.local_y;
    if (beyond_x) {
        place.tile_x = place.tile_x + borders.x.to_neighbour;
        place.local_x = place.local_x - borders.x.to_neighbour;
    }
    if (beyond_y) {
        place.tile_y = place.tile_y + borders.y.to_neighbour;
        place.local_y = place.local_y - borders.y.to_neighbour;
    }
    shift_into_copy(medium, place);
    return place;
}

// Calls `visit` with each neighbouring tile that reaches some of the `wanted` lanes: whether it is
// beyond the border along x and along y, and the lanes.
template <class Visit>
HWY_INLINE void for_neighbours(const TileBorders& borders, FloatMask wanted, const Visit& visit) {
    const FloatMask x = wanted & borders.x.near;
    const FloatMask y = wanted & borders.y.near;
    if (any(x)) visit(true, false, x);
    if (any(y)) visit(false, true, y);
    if (any(x & y)) visit(true, true, x & y);
}

// Looks up the volume in the lanes `wanted`. `seen`, if not null, becomes the place in the copy whose value counts.
HWY_INLINE FloatLanes varied_lookup(const CloudMedium& medium, const Place& at, FloatLanes z,
                                    FloatMask wanted, Place* seen = nullptr) {
    const FloatLanes greatest(medium.variation.greatest);
    const TileBorders borders = nearest_borders(medium, at);
    FloatLanes value =
        lookup(medium.volume, at.x, at.y, z) - greatest * maximum(borders.x.own, borders.y.own);
    for_neighbours(borders, wanted, [&](bool x, bool y, FloatMask lanes) HWY_ATTR {
        const FloatLanes erosion =
            maximum(x ? borders.x.beyond : borders.x.own, y ? borders.y.beyond : borders.y.own);
        // A copy is not looked up where not even its greatest voxel would count.
        lanes = lanes & (value < greatest - greatest * erosion);
        if (!any(lanes)) return;
        const Place place = in_neighbour(medium, at, borders, x, y);
        const FloatLanes other = lookup(medium.volume, place.x, place.y, z) - greatest * erosion;
        if (seen != nullptr) {
            const FloatMask wins = lanes & (value < other);
            for (FloatLanes Place::*member :
                 {&Place::x, &Place::y, &Place::tile_x, &Place::tile_y}) {
                seen->*member = select(wins, place.*member, seen->*member);
            }
        }
        value = select(lanes, maximum(value, other), value);
    });
    return value;
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_TILE_VARIATION_INL_H_
