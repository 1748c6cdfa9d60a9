#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/preview/cloud_rays.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

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

// Samples stand evenly along a ray.
struct Samples {
    RayFloats jitter;
    float step_m;
    float steps_per_m;

    HWY_INLINE RayFloats distance(RayFloats k) const { return (k + jitter) * RayFloats(step_m); }
    // About the first sample at or beyond a distance.
    HWY_INLINE RayFloats first_beyond(RayFloats distance_m) const {
        return ceil_of(distance_m * RayFloats(steps_per_m) - jitter);
    }
};

// A ray with its samples, in each lane.
struct Path {
    const CloudMedium& medium;
    RayFloats origin_x, origin_y, origin_z;           // voxels
    RayFloats direction_x, direction_y, direction_z;  // voxels per metre
    RayFloats pace_x, pace_y, pace_z;                 // metres per voxel
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
};

// 1 / direction; where a coordinate does not move, 2^60 of the unit stands for never.
HWY_INLINE RayFloats pace_of(RayFloats direction) {
    const RayMask still = (RayFloats(0.0F) <= direction) & (direction <= RayFloats(0.0F));
    return select(still, RayFloats(0x1p60F),
                  RayFloats(1.0F) / select(still, RayFloats(1.0F), direction));
}

// Places from `low` to below `high`.
struct Interval {
    RayFloats low, high;

    HWY_INLINE RayMask contains(RayFloats x) const { return (low <= x) & (x < high); }
};

// A cell along one axis and everything within its reach.
HWY_INLINE Interval interval_about(RayInts cell, int shift, int size, RayFloats tile,
                                   RayFloats reach) {
    const RayFloats first = to_float(shifted_left(cell, shift));
    const RayFloats last = minimum(to_float(shifted_left(cell + RayInts(1), shift)),
                                   RayFloats(static_cast<float>(size)));
    return {(tile + first) - reach, (tile + last) + reach};
}

// About the distance at which a coordinate leaves an interval. `pace` is 1 / direction.
HWY_INLINE RayFloats exit_distance(RayFloats origin, RayFloats pace, const Interval& within) {
    const RayFloats face = select(RayFloats(0.0F) < pace, within.high, within.low);
    return (face - origin) * pace;
}

// The cell of a place, as an index; of lanes in `wanted`.
struct CellPlace {
    RayInts x, y, z;
};
HWY_INLINE CellPlace cell_place(const LeapGrid& grid, const Place& at, RayMask wanted) {
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    // The volume's top belongs to the highest cell.
    return {shifted_right(to_int(at.x), shift), shifted_right(to_int(at.y), shift),
            minimum(shifted_right(to_int(zero_unless(wanted, at.z)), shift),
                    RayInts(grid.cells[2] - 1))};
}
HWY_INLINE RayInts index_of(const LeapGrid& grid, const CellPlace& cell) {
    return (cell.z * RayInts(grid.cells[1]) + cell.y) * RayInts(grid.cells[0]) + cell.x;
}

// Of lanes that are `looking` at sample k, those whose cell is empty; these get `next`: the first
// sample that is not known to be in empty cells, or `end`.
HWY_INLINE RayMask leap(const Path& path, const Place& at, RayMask looking, RayFloats k,
                        RayFloats end, RayFloats& next) {
    const LeapGrid& grid = path.medium.leaps;
    const std::array<int, 3>& size = path.medium.volume.size;
    const int shift = std::countr_zero(static_cast<unsigned>(grid.cell));
    const CellPlace cell = cell_place(grid, at, looking);
    const RayFloats reach = gather(grid.reach.data(), index_of(grid, cell));
    const RayMask empty = looking & (RayFloats(0.0F) <= reach);
    if (!any(empty)) return empty;

    const Interval x = interval_about(cell.x, shift, size[0], at.tile_x, reach);
    const Interval y = interval_about(cell.y, shift, size[1], at.tile_y, reach);
    const Interval z = interval_about(cell.z, shift, size[2], RayFloats(0.0F), reach);
    const RayFloats exit = minimum(exit_distance(path.origin_x, path.pace_x, x),
                                   minimum(exit_distance(path.origin_y, path.pace_y, y),
                                           exit_distance(path.origin_z, path.pace_z, z)));

    // Geometry says about where the samples within the box end. Positions go one way along each
    // axis, their roundings too: if the last of them is within it, all are.
    const RayFloats at_least = k + RayFloats(1.0F);
    next = minimum(maximum(path.samples.first_beyond(exit), at_least), end);
    for (;;) {
        const RayFloats t = path.samples.distance(zero_unless(empty, next - RayFloats(1.0F)));
        const RayMask inside =
            x.contains(path.x_at(t)) & y.contains(path.y_at(t)) & z.contains(path.z_at(t));
        const RayMask too_far = and_not(empty & (at_least < next), inside);
        if (!any(too_far)) return empty;
        next = select(too_far, next - RayFloats(1.0F), next);
    }
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

// How far lanes are: at sample k, the one before it having been nothing or not.
struct Progress {
    RayFloats k;
    RayFloats was_empty;  // 1 or 0
};

// Which lanes look into the volume at their sample; of the others that are going, those that stand
// in empty cells have leapt on. A lane looks for an empty cell only after a sample that was
// nothing: in clouds there is none. Where few lanes are left to look into the volume, they wait
// for the others to leap.
HWY_INLINE RayMask leap_or_look(const Path& path, const Place& at, RayMask going, RayFloats end,
                                Progress& progress, std::int64_t& cells) {
    constexpr std::int64_t kFew = static_cast<std::int64_t>(RayFloats::kCount) / 4;
    const RayMask looking = going & (RayFloats(0.0F) < progress.was_empty);
    if (!any(looking)) return going;
    cells += count_of(looking);
    RayFloats next;
    const RayMask empty = leap(path, at, looking, progress.k, end, next);
    if (!any(empty)) return going;
    progress.k = select(empty, next, progress.k);
    const RayMask rest = and_not(going, empty);
    progress.was_empty = select(rest, RayFloats(0.0F), progress.was_empty);
    return count_of(rest) <= kFew && any(empty & (progress.k < end)) ? and_not(rest, rest) : rest;
}

// Beyond the sample that lanes have looked at.
HWY_INLINE void step_on(RayMask sampled, RayFloats sigma, Progress& progress) {
    const RayFloats empty = select(RayFloats(0.0F) < sigma, RayFloats(0.0F), RayFloats(1.0F));
    progress.was_empty = select(sampled, empty, progress.was_empty);
    progress.k = select(sampled, progress.k + RayFloats(1.0F), progress.k);
}

// Where the light is looked up: after the march of some rays, all at once.
struct LightPoints {
    std::vector<float> x, y, z;  // voxels, within the tile
    std::vector<float> weight;   // the share of its light that reaches the eye
    std::vector<float> tau;      // towards the sun
    std::vector<std::uint32_t> ray;

    std::size_t size() const { return x.size(); }
    void clear() {
        for (auto* values : {&x, &y, &z, &weight, &tau}) values->clear();
        ray.clear();
    }
};

// Marches towards the sun, one in each lane; a lane that has ended takes the next point.
class SunMarches {
  public:
    SunMarches(const CloudMarch& march, const RayBlock& rays, LightPoints& points,
               FetchCounts& counts)
        : march_(march), rays_(rays), points_(points), counts_(counts) {
        for (std::size_t a = 0; a < 3; ++a) pace_[a] = pace_of(RayFloats(march.light_direction[a]));
    }

    HWY_NOINLINE void run() {
        points_.tau.resize(points_.size());
        RayMask going = refill(RayFloats(0.0F) < RayFloats(0.0F));
        while (any(going)) {
            going = advance(going);
            const auto busy = static_cast<std::size_t>(count_of(going));
            // Refilling takes about as long as a step.
            if (busy == 0 || (next_ < points_.size() && busy <= RayFloats::kCount - kRefill)) {
                going = refill(going);
            }
        }
    }

  private:
    static constexpr std::size_t kRefill = RayFloats::kCount / 4 + 1;

    RayMask refill(RayMask going) {
        alignas(64) float busy[RayFloats::kCount];
        select(going, RayFloats(1.0F), RayFloats(0.0F)).store(busy);
        if (started_) tau_.store(lanes_.tau);
        if (started_) progress_.k.store(lanes_.k);
        if (started_) progress_.was_empty.store(lanes_.was_empty);
        for (std::size_t lane = 0; lane < RayFloats::kCount; ++lane) {
            if (busy[lane] != 0) continue;
            if (lanes_.point[lane] != kNone) points_.tau[lanes_.point[lane]] = lanes_.tau[lane];
            lanes_.point[lane] = next_ < points_.size() ? next_++ : kNone;
            if (lanes_.point[lane] == kNone) continue;
            const std::size_t point = lanes_.point[lane];
            busy[lane] = 1;
            lanes_.x[lane] = points_.x[point];
            lanes_.y[lane] = points_.y[point];
            lanes_.z[lane] = points_.z[point];
            lanes_.jitter[lane] = rays_.light_jitter[points_.ray[point]];
            lanes_.tau[lane] = 0;
            lanes_.k[lane] = 0;
            lanes_.was_empty[lane] = 0;
        }
        started_ = true;
        tau_ = RayFloats::load(lanes_.tau);
        progress_ = {RayFloats::load(lanes_.k), RayFloats::load(lanes_.was_empty)};
        return RayFloats(0.0F) < RayFloats::load(busy);
    }

    // Those of the lanes after a sample that was nothing whose cell is empty go on to the first
    // sample that may be something.
    RayMask leap_on(const Place& at, RayMask going) {
        const RayMask looking = going & (RayFloats(0.0F) < progress_.was_empty);
        if (!any(looking)) return looking;
        counts_.cells += count_of(looking);
        const LeapGrid& grid = march_.medium->leaps;
        const RayFloats leaps =
            gather(march_.sun_leaps.data(), index_of(grid, cell_place(grid, at, looking)));
        const RayMask empty = looking & (RayFloats(0.0F) <= leaps);
        progress_.k = select(empty, progress_.k + RayFloats(1.0F) + leaps, progress_.k);
        progress_.was_empty = select(empty, RayFloats(1.0F), RayFloats(0.0F));
        return empty;
    }

    // A sample or a leap of most lanes.
    RayMask advance(RayMask going) {
        const Path path{
            *march_.medium,
            RayFloats::load(lanes_.x),
            RayFloats::load(lanes_.y),
            RayFloats::load(lanes_.z),
            RayFloats(march_.light_direction[0]),
            RayFloats(march_.light_direction[1]),
            RayFloats(march_.light_direction[2]),
            pace_[0],
            pace_[1],
            pace_[2],
            {RayFloats::load(lanes_.jitter), march_.light_step_m, 1 / march_.light_step_m}};
        const RayFloats end(march_.light_samples);
        progress_.k = zero_unless(going, progress_.k);
        const Place at = path.place(path.samples.distance(progress_.k));
        going = going & at.within_height;  // which it never enters again
        RayMask sampling = going;
        if (march_.leaping) sampling = and_not(going, leap_on(at, going));
        if (any(sampling)) {
            counts_.light_samples += count_of(sampling);
            const RayFloats sigma = extinction(*march_.medium, at, sampling);
            tau_ = tau_ + sigma * RayFloats(march_.light_step_m);
            step_on(sampling, sigma, progress_);
        }
        return going & (progress_.k < end);
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    struct State {
        alignas(64) float x[RayFloats::kCount] = {};
        alignas(64) float y[RayFloats::kCount] = {};
        alignas(64) float z[RayFloats::kCount] = {};
        alignas(64) float jitter[RayFloats::kCount] = {};
        alignas(64) float tau[RayFloats::kCount] = {};
        alignas(64) float k[RayFloats::kCount] = {};
        alignas(64) float was_empty[RayFloats::kCount] = {};
        std::size_t point[RayFloats::kCount];
        State() {
            for (std::size_t& value : point) value = kNone;
        }
    };

    const CloudMarch& march_;
    const RayBlock& rays_;
    LightPoints& points_;
    FetchCounts& counts_;
    RayFloats pace_[3];
    State lanes_;
    RayFloats tau_;
    Progress progress_;
    bool started_ = false;
    std::size_t next_ = 0;
};

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

// A share of diffuse light at places of the volume.
HWY_INLINE RayFloats share_at(const std::array<int, 3>& voxels, const PaddedVolume& shares,
                              RayFloats x, RayFloats y, RayFloats z) {
    const auto scaled = [&](RayFloats value, std::size_t axis) HWY_ATTR {
        const double scale = static_cast<double>(shares.size[axis]) / voxels[axis];
        return minimum(value * RayFloats(static_cast<float>(scale)),
                       RayFloats(static_cast<float>(shares.size[axis])));
    };
    return lookup(shares, scaled(x, 0), scaled(y, 1), scaled(z, 2));
}

// The light of each point goes to its ray, in the order of points.
class Lighting {
  public:
    Lighting(const CloudMarch& march, const RayBlock& rays) : march_(march) {
        for (std::size_t i = 0; i < RayBlock::kCount; i += RayFloats::kCount) {
            const OctaveLanes octaves = octaves_at(march, RayFloats::load(&rays.sun_offset[i]));
            for (std::size_t n = 0; n < kOctaves; ++n) octaves.value[n].store(&octaves_[n][i]);
        }
    }

    HWY_NOINLINE void add(const LightPoints& points, RayResults& results) const {
        for (std::size_t first = 0; first < points.size(); first += RayFloats::kCount) {
            add_packet(points, first, results);
        }
    }

  private:
    void add_packet(const LightPoints& points, std::size_t first, RayResults& results) const {
        alignas(64) float x[RayFloats::kCount] = {};
        alignas(64) float y[RayFloats::kCount] = {};
        alignas(64) float z[RayFloats::kCount] = {};
        alignas(64) float tau[RayFloats::kCount] = {};
        alignas(64) float octaves[kOctaves][RayFloats::kCount] = {};
        const std::size_t count = std::min(RayFloats::kCount, points.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = points.x[first + i];
            y[i] = points.y[first + i];
            z[i] = points.z[first + i];
            tau[i] = points.tau[first + i];
            for (std::size_t n = 0; n < kOctaves; ++n) {
                octaves[n][i] = octaves_[n][points.ray[first + i]];
            }
        }
        OctaveLanes lanes;
        for (std::size_t n = 0; n < kOctaves; ++n) lanes.value[n] = RayFloats::load(octaves[n]);
        const std::array<int, 3>& voxels = march_.medium->volume.size;
        const RayFloats at_x = RayFloats::load(x);
        const RayFloats at_y = RayFloats::load(y);
        const RayFloats at_z = RayFloats::load(z);
        const RayFloats sunlight = scattered_sunlight(lanes, RayFloats::load(tau));
        const RayFloats height = at_z * RayFloats(1.0F / static_cast<float>(voxels[2]));
        const RayFloats high = sunlight * height;
        (sunlight - high).store(x);
        high.store(y);
        share_at(voxels, march_.diffuse->from_sky, at_x, at_y, at_z).store(z);
        share_at(voxels, march_.diffuse->from_ground, at_x, at_y, at_z).store(tau);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t ray = points.ray[first + i];
            const float weight = points.weight[first + i];
            results.sun_at_base[ray] += weight * x[i];
            results.sun_at_top[ray] += weight * y[i];
            results.from_sky[ray] += 0.5F * weight * z[i];
            results.from_ground[ray] += 0.5F * weight * tau[i];
        }
    }

    const CloudMarch& march_;
    alignas(64) std::array<RayBlock::Floats, kOctaves> octaves_;
};

// What of a packet's samples becomes points of light: of samples k and k + 1, both in cloud and k
// even, the latter has the light of the former.
class PointCollector {
  public:
    PointCollector(LightPoints& points, std::size_t first_ray)
        : points_(points), first_ray_(first_ray) {
        for (float& k : last_k_) k = -2;  // one after none
    }

    HWY_NOINLINE void add(const Place& at, RayFloats k, RayFloats weight, RayMask lit) {
        alignas(64) float values[5][RayFloats::kCount];
        at.x.store(values[0]);
        at.y.store(values[1]);
        at.z.store(values[2]);
        zero_unless(lit, weight).store(values[3]);
        k.store(values[4]);
        for (std::size_t lane = 0; lane < RayFloats::kCount; ++lane) {
            if (values[3][lane] == 0) continue;
            const bool odd = (static_cast<std::int32_t>(values[4][lane]) & 1) != 0;
            if (odd && last_k_[lane] + 1 == values[4][lane]) {
                points_.weight[last_point_[lane]] += values[3][lane];
                continue;
            }
            last_k_[lane] = values[4][lane];
            last_point_[lane] = points_.size();
            points_.x.push_back(values[0][lane]);
            points_.y.push_back(values[1][lane]);
            points_.z.push_back(values[2][lane]);
            points_.weight.push_back(values[3][lane]);
            points_.ray.push_back(static_cast<std::uint32_t>(first_ray_ + lane));
        }
    }

  private:
    LightPoints& points_;
    std::size_t first_ray_;
    float last_k_[RayFloats::kCount];
    std::size_t last_point_[RayFloats::kCount] = {};
};

HWY_NOINLINE void march_packet(const CloudMarch& march, const RayBlock& rays, std::size_t first,
                               LightPoints& points, RayResults& results, FetchCounts& counts) {
    const RayFloats direction_x = RayFloats::load(&rays.direction[0][first]);
    const RayFloats direction_y = RayFloats::load(&rays.direction[1][first]);
    const RayFloats direction_z = RayFloats::load(&rays.direction[2][first]);
    const Path path{*march.medium,
                    RayFloats(march.origin[0]),
                    RayFloats(march.origin[1]),
                    RayFloats(march.origin[2]),
                    direction_x,
                    direction_y,
                    direction_z,
                    pace_of(direction_x),
                    pace_of(direction_y),
                    pace_of(direction_z),
                    {RayFloats::load(&rays.jitter[first]), march.step_m, 1 / march.step_m}};
    PointCollector collector(points, first);
    const RayFloats zero(0.0F);
    const RayFloats one(1.0F);
    const RayFloats end = RayFloats::load(&rays.end[first]);
    Progress progress{RayFloats::load(&rays.first[first]), one};
    RayFloats transmittance = one;
    RayFloats distance = zero;
    RayMask going = progress.k < end;
    while (any(going)) {
        progress.k = zero_unless(going, progress.k);
        const RayFloats k = progress.k;
        const RayFloats t = path.samples.distance(k);
        const Place at = path.place(t);
        const RayMask before = and_not(going, at.within_height);
        progress.k = select(before, k + one, k);
        RayMask sampling = going & at.within_height;
        if (march.leaping) {
            sampling = leap_or_look(path, at, sampling, end, progress, counts.cells);
        }
        if (any(sampling)) {
            counts.samples += count_of(sampling);
            const RayFloats sigma = extinction(*march.medium, at, sampling);
            step_on(sampling, sigma, progress);
            const RayMask lit = zero < sigma;
            if (any(lit)) {
                const RayFloats through =
                    exponential_of_negative(zero - sigma * RayFloats(march.step_m));
                const RayFloats weight = transmittance * (one - through);
                collector.add(at, k, weight, lit);
                distance = distance + zero_unless(lit, weight * t);
                transmittance = select(lit, transmittance * through, transmittance);
            }
        }
        going = going & (progress.k < end) & (RayFloats(kOpaque) <= transmittance);
    }
    transmittance.store(&results.transmittance[first]);
    distance.store(&results.distance_m[first]);
}

}  // namespace

void march_all(const CloudMarch& march, const RayBlock& rays, RayResults& results,
               FetchCounts& counts) {
    results = {};
    const Lighting lighting(march, rays);
    LightPoints points;
    for (std::size_t first = 0; first < RayBlock::kCount; first += RayFloats::kCount) {
        march_packet(march, rays, first, points, results, counts);
    }
    SunMarches(march, rays, points, counts).run();
    lighting.add(points, results);
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
