// Marches from many points in a cloud towards the sun at once, to measure their optical depths.
//
// The file is included once per target (see Highway's foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_
#undef SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_
#else
#define SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/march/cloud_leap-inl.h"
#include "bakers/march/cloud_points-inl.h"
#include "bakers/march/cloud_rays.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// How points become voxels of the layer that is marched: x' = (tile_x + x) * scale + offset.
struct PointFrame {
    std::array<float, 3> scale = {1, 1, 1};
    float offset_z = 0;
    float begin_m = 0;     // from the points to where marches begin
    float samples = 0;     // the most for each march
    bool enters = true;    // points may be outside of the layer
    bool in_tile = false;  // x and y alone count, because all tiles are alike
};

// Returns the frame of the layer's own points.
inline PointFrame own_frame(const CloudMarch& march) {
    PointFrame frame;
    frame.samples = march.own_samples > 0 ? march.own_samples : march.light_samples;
    frame.enters = false;
    frame.in_tile = !march.medium->variation.varies();
    return frame;
}
// Returns the frame of points that may be outside of the layer, by the edges of their unit in metres and the
// altitude of their z = 0.
inline PointFrame frame_from(const std::array<double, 3>& unit_m, double base_m,
                             const CloudMarch& march) {
    const CloudMedium& to = *march.medium;
    PointFrame frame;
    frame.samples = march.light_samples;
    for (std::size_t a = 0; a < 3; ++a) {
        frame.scale[a] = static_cast<float>(unit_m[a] / to.meters_per_voxel(a));
    }
    frame.offset_z = static_cast<float>((base_m - to.base_m) / to.meters_per_voxel(2));
    return frame;
}
inline PointFrame frame_of(const CloudMedium& from, const CloudMarch& march) {
    return frame_from(
        {from.meters_per_voxel(0), from.meters_per_voxel(1), from.meters_per_voxel(2)}, from.base_m,
        march);
}

// Marches towards the sun, one in each lane; a lane that has ended takes the next point. The optical
// depths are added to those of the points.
class SunMarches {
  public:
    SunMarches(const CloudMarch& march, const PointFrame& frame, LightPoints& points,
               FetchCounts& counts)
        : march_(march), frame_(frame), points_(points), counts_(counts) {}

    void run() {
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
            if (lanes_.point[lane] != kNone) points_.tau[lanes_.point[lane]] += lanes_.tau[lane];
            lanes_.point[lane] = kNone;
            while (next_ < points_.size() && lanes_.point[lane] == kNone) begin(lane, next_++);
            if (lanes_.point[lane] != kNone) busy[lane] = 1;
        }
        started_ = true;
        tau_ = FloatLanes::load(lanes_.tau);
        progress_ = {FloatLanes::load(lanes_.k), FloatLanes::load(lanes_.was_empty)};
        return FloatLanes(0.0F) < FloatLanes::load(busy);
    }

    // Begins the march from a point, unless it never meets the layer.
    void begin(std::size_t lane, std::size_t point) {
        const float tile_x = frame_.in_tile ? 0.0F : points_.tile_x[point];
        const float tile_y = frame_.in_tile ? 0.0F : points_.tile_y[point];
        const auto& climb = march_.light_direction;
        lanes_.x[lane] = (tile_x + points_.x[point]) * frame_.scale[0] + frame_.begin_m * climb[0];
        lanes_.y[lane] = (tile_y + points_.y[point]) * frame_.scale[1] + frame_.begin_m * climb[1];
        lanes_.z[lane] =
            points_.z[point] * frame_.scale[2] + frame_.offset_z + frame_.begin_m * climb[2];
        lanes_.jitter[lane] = points_.jitter[point];
        const float first = frame_.enters ? first_within(lane) : 0.0F;
        if (first < 0) return;
        lanes_.point[lane] = point;
        lanes_.tau[lane] = frame_.enters ? 0 : depth_before_first(lane, points_.extinction[point]);
        lanes_.k[lane] = first;
        lanes_.end[lane] = first + frame_.samples;
        lanes_.was_empty[lane] = frame_.enters ? 1.0F : 0.0F;
    }

    // Returns the optical depth from a point in cloud to its first sample, as far as it follows from the
    // extinction at the point: half of it, or all of it if the layer ends before that sample.
    float depth_before_first(std::size_t lane, float extinction) const {
        const float climb = march_.light_direction[2] * march_.light_step_m;
        const float to_face =
            climb > 0 ? static_cast<float>(march_.medium->volume.size[2]) - lanes_.z[lane]
                      : 0 - lanes_.z[lane];
        const float jitter = lanes_.jitter[lane];
        const bool ends = climb != 0 && to_face / climb < jitter;
        return extinction * march_.light_step_m * (ends ? to_face / climb : 0.5F * jitter);
    }

    // Returns the length that a sample stands for, in steps: from half the way to the point or to the sample
    // before it, to half the way to the next.
    FloatLanes steps_of_sample() const {
        const FloatLanes one(1.0F);
        if (frame_.enters) return one;
        const FloatLanes half(0.5F);
        const FloatLanes of_first = half + half * FloatLanes::load(lanes_.jitter);
        return select(progress_.k < half, of_first, one);
    }

    // Returns the first sample at a height within the layer and, if that does not repeat, within its
    // tile, or -1 if there is none. If the march passes by the tile, the sample is outside of it.
    float first_within(std::size_t lane) const {
        const float jitter = lanes_.jitter[lane];
        const float up = first_within(2, lanes_.z[lane], jitter);
        if (march_.medium->repeats || up < 0) return up;
        const float along_x = first_within(0, lanes_.x[lane], jitter);
        const float along_y = first_within(1, lanes_.y[lane], jitter);
        return along_x < 0 || along_y < 0 ? -1 : std::max({up, along_x, along_y});
    }

    // Returns the first sample between the volume's two faces along one axis, or -1 if there is none.
    float first_within(std::size_t axis, float from, float jitter) const {
        constexpr float kFarthest = 0x1p22F;  // whole numbers and halves beyond it are not exact
        const float last = static_cast<float>(march_.medium->volume.size[axis]);
        if (from >= 0 && from <= last) return 0;
        const float climb = march_.light_direction[axis] * march_.light_step_m;
        const float way = from < 0 ? 0 - from : last - from;
        if (!(way * climb > 0) || way / climb > kFarthest) return -1;
        float k = std::max(std::ceil(way / climb - jitter), 0.0F);
        const auto outside = [&] {
            const float at =
                from + (k + jitter) * march_.light_step_m * march_.light_direction[axis];
            return from < 0 ? at < 0 : at > last;
        };
        while (outside()) ++k;
        return k;
    }

    // Lanes that are in an empty cell after an empty sample leap to the first sample that may be in
    // cloud. Returns whether any lane has leapt.
    bool leap_on(const CloudPath& path, const Place& at, FloatMask going, FloatLanes end) {
        const FloatMask looking = going & (FloatLanes(0.0F) < progress_.was_empty);
        if (!any(looking)) return false;
        counts_.cells += count_of(looking);
        // The leaps of cells are exact for marches that begin in the tile (sun_leaps.h).
        if (!frame_.in_tile) {
            const Pace pace{pace_of(path.direction_x), pace_of(path.direction_y),
                            pace_of(path.direction_z)};
            FloatLanes next;
            const FloatMask leapt = leap(path, pace, at, looking, progress_.k, end, next);
            if (any(leapt)) progress_.k = select(leapt, next, progress_.k);
            return any(leapt);
        }
        const LeapGrid& grid = march_.medium->leaps;
        const FloatLanes leaps =
            gather(march_.sun_leaps.data(), index_of(grid, cell_place(grid, at, looking)));
        const FloatMask empty = looking & (FloatLanes(0.0F) <= leaps);
        progress_.k = select(empty, progress_.k + FloatLanes(1.0F) + leaps, progress_.k);
        return any(empty);
    }

    // Takes one sample in each lane, after a leap if the lane is in empty space.
    FloatMask advance(FloatMask going) {
        const CloudPath path{
            *march_.medium,
            FloatLanes::load(lanes_.x),
            FloatLanes::load(lanes_.y),
            FloatLanes::load(lanes_.z),
            FloatLanes(march_.light_direction[0]),
            FloatLanes(march_.light_direction[1]),
            FloatLanes(march_.light_direction[2]),
            {FloatLanes::load(lanes_.jitter), march_.light_step_m, 1 / march_.light_step_m}};
        const FloatLanes end = FloatLanes::load(lanes_.end);
        progress_.k = zero_unless(going, progress_.k);
        Place at = path.place(path.samples.distance(progress_.k));
        going = going & at.within;  // a march that leaves never returns
        if (march_.leaping && leap_on(path, at, going, end)) {
            going = going & (progress_.k < end);
            progress_.k = zero_unless(going, progress_.k);
            at = path.place(path.samples.distance(progress_.k));
            going = going & at.within;
        }
        counts_.light_samples += count_of(going);
        const FloatLanes sigma = extinction(*march_.medium, at, going);
        tau_ = tau_ + sigma * FloatLanes(march_.light_step_m) * steps_of_sample();
        step_on(going, sigma, progress_);
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
        alignas(64) float end[FloatLanes::kCount] = {};
        alignas(64) float was_empty[FloatLanes::kCount] = {};
        std::size_t point[FloatLanes::kCount];
        State() {
            for (std::size_t& value : point) value = kNone;
        }
    };

    const CloudMarch& march_;
    PointFrame frame_;
    LightPoints& points_;
    FetchCounts& counts_;
    State lanes_;
    FloatLanes tau_;
    Progress progress_;
    bool started_ = false;
    std::size_t next_ = 0;
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_
