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

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/march/cloud_path-inl.h"
#include "bakers/march/cloud_rays.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// The points where light is looked up. They are collected while rays are marched and evaluated
// together.
struct LightPoints {
    std::vector<float> x, y, z;  // in voxels, within the tile
    std::vector<float> weight;   // the share of its light that reaches the eye
    std::vector<float> tau;      // optical depth towards the sun
    std::vector<std::uint32_t> ray;

    std::size_t size() const { return x.size(); }
};

// Marches towards the sun, one in each lane; a lane that has ended takes the next point.
class SunMarches {
  public:
    SunMarches(const CloudMarch& march, const RayBlock& rays, LightPoints& points,
               FetchCounts& counts)
        : march_(march), rays_(rays), points_(points), counts_(counts) {}

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

    // Lanes that are in an empty cell after an empty sample leap to the first sample that may be in
    // cloud. Returns whether any lane has leapt.
    bool leap_on(const Place& at, FloatMask going) {
        const FloatMask looking = going & (FloatLanes(0.0F) < progress_.was_empty);
        if (!any(looking)) return false;
        counts_.cells += count_of(looking);
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
        const FloatLanes end(march_.light_samples);
        progress_.k = zero_unless(going, progress_.k);
        Place at = path.place(path.samples.distance(progress_.k));
        going = going & at.within;  // a march that leaves never returns
        if (march_.leaping && leap_on(at, going)) {
            going = going & (progress_.k < end);
            progress_.k = zero_unless(going, progress_.k);
            at = path.place(path.samples.distance(progress_.k));
            going = going & at.within;
        }
        counts_.light_samples += count_of(going);
        const FloatLanes sigma = extinction(*march_.medium, at, going);
        tau_ = tau_ + sigma * FloatLanes(march_.light_step_m);
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
    State lanes_;
    FloatLanes tau_;
    Progress progress_;
    bool started_ = false;
    std::size_t next_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_SUN_MARCH_INL_H_
