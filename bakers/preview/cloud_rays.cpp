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
#include "bakers/preview/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {
namespace {

constexpr float kPi = 3.14159265F;

// Somewhere along a ray, in voxels: `x`, `y` within the tile that begins at tile_x, tile_y.
struct Place {
    FloatLanes x, y, z;
    FloatLanes tile_x, tile_y;
    FloatMask within_height;  // both faces belong to the volume
};

// Splits x into the tile's beginning and the rest in [0, size), in steps that are exact but for
// one rounding of places just below a tile's beginning, to that beginning: it keeps their order.
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

// The two voxels beside a coordinate, as the index of the first in a padded axis, and the second's
// weight.
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

// Samples stand evenly along a ray.
struct Samples {
    FloatLanes jitter;
    float step_m;
    float steps_per_m;

    HWY_INLINE FloatLanes distance(FloatLanes k) const { return (k + jitter) * FloatLanes(step_m); }
    // About the first sample at or beyond a distance.
    HWY_INLINE FloatLanes first_beyond(FloatLanes distance_m) const {
        return ceil_of(distance_m * FloatLanes(steps_per_m) - jitter);
    }
};

// A ray with its samples, in each lane.
struct Path {
    const CloudMedium& medium;
    FloatLanes origin_x, origin_y, origin_z;           // voxels
    FloatLanes direction_x, direction_y, direction_z;  // voxels per metre
    FloatLanes pace_x, pace_y, pace_z;                 // metres per voxel
    Samples samples;

    HWY_INLINE FloatLanes x_at(FloatLanes t) const { return origin_x + t * direction_x; }
    HWY_INLINE FloatLanes y_at(FloatLanes t) const { return origin_y + t * direction_y; }
    HWY_INLINE FloatLanes z_at(FloatLanes t) const { return origin_z + t * direction_z; }

    HWY_INLINE Place place(FloatLanes t) const {
        Place place;
        split(x_at(t), static_cast<float>(medium.volume.size[0]), place.x, place.tile_x);
        split(y_at(t), static_cast<float>(medium.volume.size[1]), place.y, place.tile_y);
        place.z = z_at(t);
        const FloatLanes top(static_cast<float>(medium.volume.size[2]));
        place.within_height = (FloatLanes(0.0F) <= place.z) & (place.z <= top);
        return place;
    }
};

// 1 / direction; where a coordinate hardly moves, 2^60 of the unit stands for never, so that no
// product with it overflows.
HWY_INLINE FloatLanes pace_of(FloatLanes direction) {
    const FloatMask still =
        (FloatLanes(-0x1p-60F) < direction) & (direction < FloatLanes(0x1p-60F));
    return select(still, FloatLanes(0x1p60F),
                  FloatLanes(1.0F) / select(still, FloatLanes(1.0F), direction));
}

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

// The cell of a place, as an index; of lanes in `wanted`.
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

// Of lanes that are `looking` at sample k, those whose cell is empty; these get `next`: the first
// sample that is not known to be in empty cells, or `end`.
HWY_INLINE FloatMask leap(const Path& path, const Place& at, FloatMask looking, FloatLanes k,
                          FloatLanes end, FloatLanes& next) {
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
    const FloatLanes exit = minimum(exit_distance(path.origin_x, path.pace_x, x),
                                    minimum(exit_distance(path.origin_y, path.pace_y, y),
                                            exit_distance(path.origin_z, path.pace_z, z)));

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

// Extinction per metre at places of the volume, 0 elsewhere.
HWY_INLINE FloatLanes extinction(const CloudMedium& medium, const Place& at, FloatMask wanted) {
    const CloudOptics& optics = medium.optics;
    const FloatLanes value = lookup(medium.volume, at.x, at.y, zero_unless(wanted, at.z));
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

// How far lanes are: at sample k, the one before it having been nothing or not.
struct Progress {
    FloatLanes k;
    FloatLanes was_empty;  // 1 or 0
};

// Which lanes look into the volume at their sample; of the others that are going, those that stand
// in empty cells have leapt on. A lane looks for an empty cell only after a sample that was
// nothing: in clouds there is none. Where few lanes are left to look into the volume, they wait
// for the others to leap.
HWY_INLINE FloatMask leap_or_look(const Path& path, const Place& at, FloatMask going,
                                  FloatLanes end, Progress& progress, std::int64_t& cells) {
    constexpr std::int64_t kFew = static_cast<std::int64_t>(FloatLanes::kCount) / 4;
    const FloatMask looking = going & (FloatLanes(0.0F) < progress.was_empty);
    if (!any(looking)) return going;
    cells += count_of(looking);
    FloatLanes next;
    const FloatMask empty = leap(path, at, looking, progress.k, end, next);
    if (!any(empty)) return going;
    progress.k = select(empty, next, progress.k);
    const FloatMask rest = and_not(going, empty);
    progress.was_empty = select(rest, FloatLanes(0.0F), progress.was_empty);
    return count_of(rest) <= kFew && any(empty & (progress.k < end)) ? and_not(rest, rest) : rest;
}

// Beyond the sample that lanes have looked at.
HWY_INLINE void step_on(FloatMask sampled, FloatLanes sigma, Progress& progress) {
    const FloatLanes empty = select(FloatLanes(0.0F) < sigma, FloatLanes(0.0F), FloatLanes(1.0F));
    progress.was_empty = select(sampled, empty, progress.was_empty);
    progress.k = select(sampled, progress.k + FloatLanes(1.0F), progress.k);
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
        for (std::size_t a = 0; a < 3; ++a)
            pace_[a] = pace_of(FloatLanes(march.light_direction[a]));
    }

    void run() {
        points_.tau.resize(points_.size());
        FloatMask going = refill(FloatLanes(0.0F) < FloatLanes(0.0F));
        while (any(going)) {
            going = advance(going);
            const auto busy = static_cast<std::size_t>(count_of(going));
            // Refilling takes about as long as a step.
            if (busy == 0 || (next_ < points_.size() && busy <= FloatLanes::kCount - kRefill)) {
                going = refill(going);
            }
        }
    }

  private:
    static constexpr std::size_t kRefill = FloatLanes::kCount / 4 + 1;

    FloatMask refill(FloatMask going) {
        alignas(64) float busy[FloatLanes::kCount];
        select(going, FloatLanes(1.0F), FloatLanes(0.0F)).store(busy);
        if (started_) tau_.store(lanes_.tau);
        if (started_) progress_.k.store(lanes_.k);
        if (started_) progress_.was_empty.store(lanes_.was_empty);
        for (std::size_t lane = 0; lane < FloatLanes::kCount; ++lane) {
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
        tau_ = FloatLanes::load(lanes_.tau);
        progress_ = {FloatLanes::load(lanes_.k), FloatLanes::load(lanes_.was_empty)};
        return FloatLanes(0.0F) < FloatLanes::load(busy);
    }

    // Those of the lanes after a sample that was nothing whose cell is empty go on to the first
    // sample that may be something.
    FloatMask leap_on(const Place& at, FloatMask going) {
        const FloatMask looking = going & (FloatLanes(0.0F) < progress_.was_empty);
        if (!any(looking)) return looking;
        counts_.cells += count_of(looking);
        const LeapGrid& grid = march_.medium->leaps;
        const FloatLanes leaps =
            gather(march_.sun_leaps.data(), index_of(grid, cell_place(grid, at, looking)));
        const FloatMask empty = looking & (FloatLanes(0.0F) <= leaps);
        progress_.k = select(empty, progress_.k + FloatLanes(1.0F) + leaps, progress_.k);
        progress_.was_empty = select(empty, FloatLanes(1.0F), FloatLanes(0.0F));
        return empty;
    }

    // A sample or a leap of most lanes.
    FloatMask advance(FloatMask going) {
        const Path path{
            *march_.medium,
            FloatLanes::load(lanes_.x),
            FloatLanes::load(lanes_.y),
            FloatLanes::load(lanes_.z),
            FloatLanes(march_.light_direction[0]),
            FloatLanes(march_.light_direction[1]),
            FloatLanes(march_.light_direction[2]),
            pace_[0],
            pace_[1],
            pace_[2],
            {FloatLanes::load(lanes_.jitter), march_.light_step_m, 1 / march_.light_step_m}};
        const FloatLanes end(march_.light_samples);
        progress_.k = zero_unless(going, progress_.k);
        const Place at = path.place(path.samples.distance(progress_.k));
        going = going & at.within_height;  // which it never enters again
        FloatMask sampling = going;
        if (march_.leaping) sampling = and_not(going, leap_on(at, going));
        if (any(sampling)) {
            counts_.light_samples += count_of(sampling);
            const FloatLanes sigma = extinction(*march_.medium, at, sampling);
            tau_ = tau_ + sigma * FloatLanes(march_.light_step_m);
            step_on(sampling, sigma, progress_);
        }
        return going & (progress_.k < end);
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    struct State {
        alignas(64) float x[FloatLanes::kCount] = {};
        alignas(64) float y[FloatLanes::kCount] = {};
        alignas(64) float z[FloatLanes::kCount] = {};
        alignas(64) float jitter[FloatLanes::kCount] = {};
        alignas(64) float tau[FloatLanes::kCount] = {};
        alignas(64) float k[FloatLanes::kCount] = {};
        alignas(64) float was_empty[FloatLanes::kCount] = {};
        std::size_t point[FloatLanes::kCount];
        State() {
            for (std::size_t& value : point) value = kNone;
        }
    };

    const CloudMarch& march_;
    const RayBlock& rays_;
    LightPoints& points_;
    FetchCounts& counts_;
    FloatLanes pace_[3];
    State lanes_;
    FloatLanes tau_;
    Progress progress_;
    bool started_ = false;
    std::size_t next_ = 0;
};

// The octaves of sun_scattering for the angle of each lane: b^n p_n.
struct OctaveLanes {
    FloatLanes value[kOctaves];
};

HWY_INLINE FloatLanes henyey_greenstein(double g, FloatLanes offset) {
    const FloatLanes base = FloatLanes(static_cast<float>((1 - g) * (1 - g))) +
                            FloatLanes(static_cast<float>(2 * g)) * offset;
    return FloatLanes(static_cast<float>((1 - g) * (1 + g) / 4)) /
           (FloatLanes(kPi) * base * square_root(base));
}

HWY_INLINE OctaveLanes octaves_at(const CloudMarch& march, FloatLanes offset) {
    OctaveLanes lanes;
    const FloatLanes u = FloatLanes(1.0F) - offset;
    for (std::size_t n = 0; n < kOctaves; ++n) {
        const DropletPhase& phase = march.octaves[n].phase;
        const double brightness = march.octaves[n].brightness;
        const double g = phase.draine_g;
        const double alpha = phase.draine_alpha;
        const double draine_scale =
            brightness * phase.draine_share / (1 + alpha * (1 + 2 * g * g) / 3);
        const FloatLanes draine =
            henyey_greenstein(g, offset) *
            (FloatLanes(1.0F) + FloatLanes(static_cast<float>(alpha)) * u * u) *
            FloatLanes(static_cast<float>(draine_scale));
        const FloatLanes forward =
            henyey_greenstein(phase.hg_g, offset) *
            FloatLanes(static_cast<float>(brightness * (1 - phase.draine_share)));
        lanes.value[n] = draine + forward;
    }
    return lanes;
}

// exp(-tau / 2^n) for the last octave, whose squares are those before it.
HWY_INLINE FloatLanes scattered_sunlight(const OctaveLanes& octaves, FloatLanes tau) {
    static_assert(kOctaveHalving == 0.5);
    FloatLanes through =
        exponential_of_negative(tau * FloatLanes(-1.0F / static_cast<float>(1 << (kOctaves - 1))));
    FloatLanes sum(0.0F);
    for (std::size_t n = kOctaves; n-- > 0;) {
        sum = sum + octaves.value[n] * through;
        through = through * through;
    }
    return sum;
}

// A share of diffuse light at places of the volume.
HWY_INLINE FloatLanes share_at(const std::array<int, 3>& voxels, const PaddedVolume& shares,
                               FloatLanes x, FloatLanes y, FloatLanes z) {
    const auto scaled = [&](FloatLanes value, std::size_t axis) HWY_ATTR {
        const double scale = static_cast<double>(shares.size[axis]) / voxels[axis];
        return minimum(value * FloatLanes(static_cast<float>(scale)),
                       FloatLanes(static_cast<float>(shares.size[axis])));
    };
    return lookup(shares, scaled(x, 0), scaled(y, 1), scaled(z, 2));
}

// The light of each point goes to its ray, in the order of points.
class Lighting {
  public:
    Lighting(const CloudMarch& march, const RayBlock& rays) : march_(march) {
        for (std::size_t i = 0; i < RayBlock::kCount; i += FloatLanes::kCount) {
            const OctaveLanes octaves = octaves_at(march, FloatLanes::load(&rays.sun_offset[i]));
            for (std::size_t n = 0; n < kOctaves; ++n) octaves.value[n].store(&octaves_[n][i]);
        }
    }

    void add(const LightPoints& points, RayResults& results) const {
        for (std::size_t first = 0; first < points.size(); first += FloatLanes::kCount) {
            add_packet(points, first, results);
        }
    }

  private:
    void add_packet(const LightPoints& points, std::size_t first, RayResults& results) const {
        alignas(64) float x[FloatLanes::kCount] = {};
        alignas(64) float y[FloatLanes::kCount] = {};
        alignas(64) float z[FloatLanes::kCount] = {};
        alignas(64) float tau[FloatLanes::kCount] = {};
        alignas(64) float octaves[kOctaves][FloatLanes::kCount] = {};
        const std::size_t count = std::min(FloatLanes::kCount, points.size() - first);
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
        for (std::size_t n = 0; n < kOctaves; ++n) lanes.value[n] = FloatLanes::load(octaves[n]);
        const std::array<int, 3>& voxels = march_.medium->volume.size;
        const FloatLanes at_x = FloatLanes::load(x);
        const FloatLanes at_y = FloatLanes::load(y);
        const FloatLanes at_z = FloatLanes::load(z);
        const FloatLanes sunlight = scattered_sunlight(lanes, FloatLanes::load(tau));
        const FloatLanes height = at_z * FloatLanes(1.0F / static_cast<float>(voxels[2]));
        const FloatLanes high = sunlight * height;
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

    void add(const Place& at, FloatLanes k, FloatLanes weight, FloatMask lit) {
        alignas(64) float values[5][FloatLanes::kCount];
        at.x.store(values[0]);
        at.y.store(values[1]);
        at.z.store(values[2]);
        zero_unless(lit, weight).store(values[3]);
        k.store(values[4]);
        for (std::size_t lane = 0; lane < FloatLanes::kCount; ++lane) {
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
    float last_k_[FloatLanes::kCount];
    std::size_t last_point_[FloatLanes::kCount] = {};
};

void march_packet(const CloudMarch& march, const RayBlock& rays, std::size_t first,
                  LightPoints& points, RayResults& results, FetchCounts& counts) {
    const FloatLanes direction_x = FloatLanes::load(&rays.direction[0][first]);
    const FloatLanes direction_y = FloatLanes::load(&rays.direction[1][first]);
    const FloatLanes direction_z = FloatLanes::load(&rays.direction[2][first]);
    const Path path{*march.medium,
                    FloatLanes(march.origin[0]),
                    FloatLanes(march.origin[1]),
                    FloatLanes(march.origin[2]),
                    direction_x,
                    direction_y,
                    direction_z,
                    pace_of(direction_x),
                    pace_of(direction_y),
                    pace_of(direction_z),
                    {FloatLanes::load(&rays.jitter[first]), march.step_m, 1 / march.step_m}};
    PointCollector collector(points, first);
    const FloatLanes zero(0.0F);
    const FloatLanes one(1.0F);
    const FloatLanes end = FloatLanes::load(&rays.end[first]);
    Progress progress{FloatLanes::load(&rays.first[first]), one};
    FloatLanes transmittance = one;
    FloatLanes distance = zero;
    FloatMask going = progress.k < end;
    while (any(going)) {
        progress.k = zero_unless(going, progress.k);
        const FloatLanes k = progress.k;
        const FloatLanes t = path.samples.distance(k);
        const Place at = path.place(t);
        const FloatMask before = and_not(going, at.within_height);
        progress.k = select(before, k + one, k);
        FloatMask sampling = going & at.within_height;
        if (march.leaping) {
            sampling = leap_or_look(path, at, sampling, end, progress, counts.cells);
        }
        if (any(sampling)) {
            counts.samples += count_of(sampling);
            const FloatLanes sigma = extinction(*march.medium, at, sampling);
            step_on(sampling, sigma, progress);
            const FloatMask lit = zero < sigma;
            if (any(lit)) {
                const FloatLanes through =
                    exponential_of_negative(zero - sigma * FloatLanes(march.step_m));
                const FloatLanes weight = transmittance * (one - through);
                collector.add(at, k, weight, lit);
                distance = distance + zero_unless(lit, weight * t);
                transmittance = select(lit, transmittance * through, transmittance);
            }
        }
        going = going & (progress.k < end) & (FloatLanes(kOpaque) <= transmittance);
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
    for (std::size_t first = 0; first < RayBlock::kCount; first += FloatLanes::kCount) {
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
