#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/preview/cloud_rays.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <bit>

#include "bakers/preview/cloud_rays.h"
#include "bakers/preview/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {
namespace {

constexpr float kPi = 3.14159265F;

// Somewhere along a ray, in voxels: `x`, `y` within the tile that begins at tile_x, tile_y.
struct Place {
    RayFloats x, y, z;
    RayFloats tile_x, tile_y;
    RayMask within_height;  // both faces belong to the volume
};

// Splits x into the tile's beginning and the rest in [0, size), in steps that are exact but for
// one rounding of places just below a tile's beginning, to that beginning: it keeps their order.
HWY_INLINE void split(RayFloats position, float size, RayFloats& rest, RayFloats& tile) {
    const RayFloats length(size);
    tile = length * floor_of(position * RayFloats(1 / size));
    rest = position - tile;
    const RayMask below = rest < RayFloats(0.0F);
    rest = select(below, rest + length, rest);
    tile = select(below, tile - length, tile);
    const RayMask beyond = length <= rest;
    rest = select(beyond, rest - length, rest);
    tile = select(beyond, tile + length, tile);
}

// The two voxels beside a coordinate, as the index of the first in a padded axis, and the second's
// weight.
struct Taps {
    RayInts index;
    RayFloats weight;
};
HWY_INLINE Taps taps_at(RayFloats x) {
    const RayFloats before = floor_of(x - RayFloats(0.5F));
    return {to_int(before + RayFloats(1.0F)), (x - RayFloats(0.5F)) - before};
}

HWY_INLINE RayFloats mixed(RayFloats a, RayFloats b, RayFloats t) { return a + t * (b - a); }

HWY_INLINE RayFloats lookup(const PaddedVolume& volume, RayFloats x, RayFloats y, RayFloats z) {
    const Taps tx = taps_at(x);
    const Taps ty = taps_at(y);
    const Taps tz = taps_at(z);
    const std::ptrdiff_t row = volume.row();
    const std::ptrdiff_t plane = volume.plane();
    const RayInts index = tz.index * RayInts(static_cast<std::int32_t>(plane)) +
                          ty.index * RayInts(static_cast<std::int32_t>(row)) + tx.index;
    const auto along_x = [&](std::ptrdiff_t offset) HWY_ATTR {
        const float* first = volume.values.data() + offset;
        return mixed(gather(first, index), gather(first + 1, index), tx.weight);
    };
    return mixed(mixed(along_x(0), along_x(row), ty.weight),
                 mixed(along_x(plane), along_x(plane + row), ty.weight), tz.weight);
}

// Samples evenly along a ray.
struct EvenSamples {
    RayFloats jitter;
    float step_m;
    float steps_per_m;

    HWY_INLINE RayFloats distance(RayFloats k) const { return (k + jitter) * RayFloats(step_m); }
    // About the first sample at or beyond a distance.
    HWY_INLINE RayFloats first_beyond(RayFloats distance_m) const {
        return ceil_of(distance_m * RayFloats(steps_per_m) - jitter);
    }
};

// Samples in the segments towards the sun.
struct SegmentSamples {
    RayFloats jitter;
    const LightSegments& segments;
    float last_bucket;

    HWY_INLINE RayFloats length(RayFloats k) const {
        return gather(segments.length_m.data(), to_int(k));
    }
    HWY_INLINE RayFloats distance(RayFloats k) const {
        return gather(segments.begin_m.data(), to_int(k)) + jitter * length(k);
    }
    HWY_INLINE RayFloats first_beyond(RayFloats distance_m) const {
        const RayFloats bucket =
            minimum(distance_m * RayFloats(1 / segments.bucket_m), RayFloats(last_bucket));
        return gather(segments.first_beyond.data(), to_int(maximum(bucket, RayFloats(0.0F))));
    }
};

// A ray with its samples, in each lane.
template <class Samples>
struct Path {
    const CloudMedium& medium;
    RayFloats origin_x, origin_y, origin_z;           // voxels
    RayFloats direction_x, direction_y, direction_z;  // voxels per metre
    Samples samples;

    HWY_INLINE RayFloats x_at(RayFloats t) const { return origin_x + t * direction_x; }
    HWY_INLINE RayFloats y_at(RayFloats t) const { return origin_y + t * direction_y; }
    HWY_INLINE RayFloats z_at(RayFloats t) const { return origin_z + t * direction_z; }

    HWY_INLINE Place place(RayFloats t) const {
        Place place;
        split(x_at(t), static_cast<float>(medium.volume.size[0]), place.x, place.tile_x);
        split(y_at(t), static_cast<float>(medium.volume.size[1]), place.y, place.tile_y);
        place.z = z_at(t);
        const RayFloats top(static_cast<float>(medium.volume.size[2]));
        place.within_height = (RayFloats(0.0F) <= place.z) & (place.z <= top);
        return place;
    }

    RayFloats leap(RayMask going, RayFloats k, RayFloats end, std::int64_t& cells) const;
};

// A box of places from `low` to below `high`.
struct Box {
    RayFloats low_x, low_y, low_z;
    RayFloats high_x, high_y, high_z;
};

// The cell of a place and everything within its reach.
HWY_INLINE void box_about(RayInts cell, int shift, int size, RayFloats tile, RayFloats reach,
                          RayFloats& low, RayFloats& high) {
    const RayFloats first = to_float(shifted_left(cell, shift));
    const RayFloats last = minimum(to_float(shifted_left(cell + RayInts(1), shift)),
                                   RayFloats(static_cast<float>(size)));
    low = (tile + first) - reach;
    high = (tile + last) + reach;
}

// The distance at which a coordinate leaves [low, high]. Where it does not move, 2^60 of the unit
// stands for never.
HWY_INLINE RayFloats exit_distance(RayFloats origin, RayFloats direction, RayFloats low,
                                   RayFloats high) {
    const RayMask forwards = RayFloats(0.0F) < direction;
    const RayMask still = (RayFloats(0.0F) <= direction) & (direction <= RayFloats(0.0F));
    const RayFloats face = select(forwards, high, low);
    const RayFloats speed = select(still, RayFloats(1.0F), direction);
    return select(still, RayFloats(0x1p60F), (face - origin) / speed);
}

// The next sample from k on that is in an occupied cell, for the lanes that are `going`; at most
// `end`. Samples that are not within the volume's height are left to the caller.
template <class Samples>
HWY_INLINE RayFloats Path<Samples>::leap(RayMask going, RayFloats k, RayFloats end,
                                         std::int64_t& cells) const {
    const LeapGrid& grid = medium.leaps;
    const std::array<int, 3>& size = medium.volume.size;
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    RayMask looking = going & (k < end);
    while (any(looking)) {
        const Place at = place(samples.distance(zero_unless(looking, k)));
        looking = looking & at.within_height;
        const RayInts cell_x = shifted_right(to_int(at.x), shift);
        const RayInts cell_y = shifted_right(to_int(at.y), shift);
        // The volume's top belongs to the highest cell.
        const RayFloats z = zero_unless(looking, at.z);
        const RayInts cell_z = minimum(shifted_right(to_int(z), shift), RayInts(grid.cells[2] - 1));
        const RayInts index =
            (cell_z * RayInts(grid.cells[1]) + cell_y) * RayInts(grid.cells[0]) + cell_x;
        const RayFloats reach = gather(grid.reach.data(), index);
        cells += count_of(looking);
        looking = looking & (RayFloats(0.0F) <= reach);
        if (!any(looking)) break;

        Box box;
        box_about(cell_x, shift, size[0], at.tile_x, reach, box.low_x, box.high_x);
        box_about(cell_y, shift, size[1], at.tile_y, reach, box.low_y, box.high_y);
        box_about(cell_z, shift, size[2], RayFloats(0.0F), reach, box.low_z, box.high_z);
        const RayFloats exit =
            minimum(exit_distance(origin_x, direction_x, box.low_x, box.high_x),
                    minimum(exit_distance(origin_y, direction_y, box.low_y, box.high_y),
                            exit_distance(origin_z, direction_z, box.low_z, box.high_z)));

        // Geometry says about where the samples within the box end. Positions go one way along each
        // axis, their roundings too: if the last of them is within it, all are.
        const RayFloats next_k = k + RayFloats(1.0F);
        RayFloats next = minimum(maximum(samples.first_beyond(exit), next_k), end);
        for (;;) {
            const RayFloats t = samples.distance(zero_unless(looking, next - RayFloats(1.0F)));
            const RayFloats x = x_at(t);
            const RayFloats y = y_at(t);
            const RayFloats last_z = z_at(t);
            const RayMask inside = (box.low_x <= x) & (x < box.high_x) & (box.low_y <= y) &
                                   (y < box.high_y) & (box.low_z <= last_z) & (last_z < box.high_z);
            const RayMask too_far = and_not(looking & (next_k < next), inside);
            if (!any(too_far)) break;
            next = select(too_far, next - RayFloats(1.0F), next);
        }
        k = select(looking, next, k);
        looking = looking & (k < end);
    }
    return k;
}

// Extinction per metre at places of the volume, 0 elsewhere.
HWY_INLINE RayFloats extinction(const CloudMedium& medium, const Place& at, RayMask wanted) {
    const CloudOptics& optics = medium.optics;
    const RayFloats value = lookup(medium.volume, at.x, at.y, zero_unless(wanted, at.z));
    const RayMask visible = wanted & (RayFloats(medium.visible_above) < value);
    RayFloats sigma = value * RayFloats(static_cast<float>(optics.extinction_per_m));
    if (optics.has_edge && optics.edge_softness > 0) {
        const RayFloats above = value - RayFloats(static_cast<float>(optics.threshold));
        const RayFloats x =
            minimum(above / RayFloats(static_cast<float>(optics.edge_softness)), RayFloats(1.0F));
        sigma = sigma * (x * x * (RayFloats(3.0F) - (x + x)));
    }
    return zero_unless(visible, sigma);
}

// The optical depth from places towards the sun, for the lanes in `lit`.
HWY_INLINE RayFloats depth_towards_sun(const CloudMarch& march, const Place& from, RayMask lit,
                                       RayFloats jitter, FetchCounts& counts) {
    const LightSegments& segments = *march.segments;
    const RayFloats count(static_cast<float>(segments.begin_m.size()));
    const Path<SegmentSamples> path{
        *march.medium,
        zero_unless(lit, from.x),
        zero_unless(lit, from.y),
        zero_unless(lit, from.z),
        RayFloats(march.light_direction[0]),
        RayFloats(march.light_direction[1]),
        RayFloats(march.light_direction[2]),
        {jitter, segments, static_cast<float>(segments.first_beyond.size() - 1)}};
    RayFloats tau(0.0F);
    RayFloats k(0.0F);
    RayMask going = lit & (k < count);
    while (any(going)) {
        if (march.leaping) {
            k = path.leap(going, k, count, counts.cells);
            going = going & (k < count);
            if (!any(going)) break;
        }
        const RayFloats inside_k = zero_unless(going, k);
        const Place at = path.place(path.samples.distance(inside_k));
        going = going & at.within_height;  // which it never enters again
        if (!any(going)) break;
        counts.light_samples += count_of(going);
        const RayFloats sigma = extinction(*march.medium, at, going);
        tau = tau + sigma * path.samples.length(inside_k);
        k = k + RayFloats(1.0F);
        going = going & (k < count);
    }
    return tau;
}

// The octaves of sun_scattering for the angle of each lane: b^n p_n.
struct OctaveLanes {
    RayFloats value[kOctaves];
};

HWY_INLINE RayFloats henyey_greenstein(double g, RayFloats offset) {
    const RayFloats base = RayFloats(static_cast<float>((1 - g) * (1 - g))) +
                           RayFloats(static_cast<float>(2 * g)) * offset;
    return RayFloats(static_cast<float>((1 - g) * (1 + g) / 4)) /
           (RayFloats(kPi) * base * square_root(base));
}

HWY_INLINE OctaveLanes octaves_at(const CloudMarch& march, RayFloats offset) {
    OctaveLanes lanes;
    const RayFloats u = RayFloats(1.0F) - offset;
    for (std::size_t n = 0; n < kOctaves; ++n) {
        const DropletPhase& phase = march.octaves[n].phase;
        const double brightness = march.octaves[n].brightness;
        const double g = phase.draine_g;
        const double alpha = phase.draine_alpha;
        const double draine_scale =
            brightness * phase.draine_share / (1 + alpha * (1 + 2 * g * g) / 3);
        const RayFloats draine = henyey_greenstein(g, offset) *
                                 (RayFloats(1.0F) + RayFloats(static_cast<float>(alpha)) * u * u) *
                                 RayFloats(static_cast<float>(draine_scale));
        const RayFloats forward =
            henyey_greenstein(phase.hg_g, offset) *
            RayFloats(static_cast<float>(brightness * (1 - phase.draine_share)));
        lanes.value[n] = draine + forward;
    }
    return lanes;
}

// exp(-tau / 2^n) for the last octave, whose squares are those before it.
HWY_INLINE RayFloats scattered_sunlight(const OctaveLanes& octaves, RayFloats tau) {
    static_assert(kOctaveHalving == 0.5);
    RayFloats through =
        exponential_of_negative(tau * RayFloats(-1.0F / static_cast<float>(1 << (kOctaves - 1))));
    RayFloats sum(0.0F);
    for (std::size_t n = kOctaves; n-- > 0;) {
        sum = sum + octaves.value[n] * through;
        through = through * through;
    }
    return sum;
}

HWY_INLINE RayFloats share_at(const CloudMarch& march, const PaddedVolume& shares, const Place& at,
                              RayMask lit) {
    const std::array<int, 3>& voxels = march.medium->volume.size;
    const auto scaled = [&](RayFloats x, std::size_t axis) HWY_ATTR {
        const double scale = static_cast<double>(shares.size[axis]) / voxels[axis];
        return minimum(x * RayFloats(static_cast<float>(scale)),
                       RayFloats(static_cast<float>(shares.size[axis])));
    };
    return lookup(shares, scaled(at.x, 0), scaled(at.y, 1), scaled(zero_unless(lit, at.z), 2));
}

struct Sums {
    RayFloats sun_at_base;
    RayFloats sun_at_top;
    RayFloats from_sky;
    RayFloats from_ground;
    RayFloats transmittance;
    RayFloats distance;
};

// One step through cloud, for the lanes in `lit`.
HWY_INLINE void add_step(const CloudMarch& march, const Place& at, RayMask lit, RayFloats sigma,
                         RayFloats t, const OctaveLanes& octaves, RayFloats light_jitter,
                         FetchCounts& counts, Sums& sums) {
    const RayFloats tau = depth_towards_sun(march, at, lit, light_jitter, counts);
    const RayFloats sunlight = scattered_sunlight(octaves, tau);
    const RayFloats through =
        exponential_of_negative(RayFloats(0.0F) - sigma * RayFloats(march.step_m));
    const RayFloats weight = zero_unless(lit, sums.transmittance * (RayFloats(1.0F) - through));
    const RayFloats height =
        zero_unless(lit, at.z) * RayFloats(1.0F / static_cast<float>(march.medium->volume.size[2]));
    const RayFloats half = weight * RayFloats(0.5F);
    sums.sun_at_base = sums.sun_at_base + weight * sunlight * (RayFloats(1.0F) - height);
    sums.sun_at_top = sums.sun_at_top + weight * sunlight * height;
    sums.from_sky = sums.from_sky + half * share_at(march, march.diffuse->from_sky, at, lit);
    sums.from_ground =
        sums.from_ground + half * share_at(march, march.diffuse->from_ground, at, lit);
    sums.distance = sums.distance + weight * t;
    sums.transmittance = select(lit, sums.transmittance * through, sums.transmittance);
}

void march_packet(const CloudMarch& march, const RayBlock& rays, std::size_t first,
                  RayResults& results, FetchCounts& counts) {
    const Path<EvenSamples> path{
        *march.medium,
        RayFloats(march.origin[0]),
        RayFloats(march.origin[1]),
        RayFloats(march.origin[2]),
        RayFloats::load(&rays.direction[0][first]),
        RayFloats::load(&rays.direction[1][first]),
        RayFloats::load(&rays.direction[2][first]),
        {RayFloats::load(&rays.jitter[first]), march.step_m, 1 / march.step_m}};
    const RayFloats light_jitter = RayFloats::load(&rays.light_jitter[first]);
    const OctaveLanes octaves = octaves_at(march, RayFloats::load(&rays.sun_offset[first]));
    const RayFloats end = RayFloats::load(&rays.end[first]);
    RayFloats k = RayFloats::load(&rays.first[first]);
    const RayFloats nothing(0.0F);
    Sums sums{nothing, nothing, nothing, nothing, RayFloats(1.0F), nothing};
    RayMask going = k < end;
    while (any(going)) {
        if (march.leaping) {
            k = path.leap(going, k, end, counts.cells);
            going = going & (k < end);
            if (!any(going)) break;
        }
        const RayFloats t = path.samples.distance(zero_unless(going, k));
        const Place at = path.place(t);
        const RayMask wanted = going & at.within_height;
        counts.samples += count_of(wanted);
        const RayFloats sigma = extinction(*march.medium, at, wanted);
        const RayMask lit = wanted & (RayFloats(0.0F) < sigma);
        if (any(lit)) add_step(march, at, lit, sigma, t, octaves, light_jitter, counts, sums);
        k = k + RayFloats(1.0F);
        going = going & (k < end) & (RayFloats(kOpaque) <= sums.transmittance);
    }
    sums.sun_at_base.store(&results.sun_at_base[first]);
    sums.sun_at_top.store(&results.sun_at_top[first]);
    sums.from_sky.store(&results.from_sky[first]);
    sums.from_ground.store(&results.from_ground[first]);
    sums.transmittance.store(&results.transmittance[first]);
    sums.distance.store(&results.distance_m[first]);
}

}  // namespace

void march_all(const CloudMarch& march, const RayBlock& rays, RayResults& results,
               FetchCounts& counts) {
    for (std::size_t first = 0; first < RayBlock::kCount; first += RayFloats::kCount) {
        march_packet(march, rays, first, results, counts);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(march_all);

void march_cloud_rays(const CloudMarch& march, const RayBlock& rays, RayResults& results,
                      FetchCounts& counts) {
    HWY_DYNAMIC_DISPATCH(march_all)(march, rays, results, counts);
}

}  // namespace skybake
#endif  // HWY_ONCE
