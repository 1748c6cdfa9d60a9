#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/cloud_light/radiance_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/assets/cloud_light/radiance_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::cloud_light {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using RowFloats = hn::CappedTag<float, kRowSlack>;
using RowVector = hn::Vec<RowFloats>;
constexpr RowFloats kRowFloats;
constexpr std::size_t kRowLanes = hn::MaxLanes(kRowFloats);

}  // namespace

void add_scaled_here(const float* values, float weight, std::size_t count, float* sums) {
    const RowVector factor = hn::Set(kRowFloats, weight);
    for (std::size_t i = 0; i < count; i += kRowLanes) {
        const RowVector product = hn::Mul(factor, hn::LoadU(kRowFloats, values + i));
        hn::StoreU(hn::Add(hn::LoadU(kRowFloats, sums + i), product), kRowFloats, sums + i);
    }
}

void step_row_here(const RowStep& step, std::size_t count, float* after, float* mean) {
    const RowVector part = hn::Set(kRowFloats, step.part);
    for (std::size_t i = 0; i < count; i += kRowLanes) {
        RowVector light = hn::Zero(kRowFloats);
        for (std::size_t k = 0; k < step.light.size(); ++k) {
            light = hn::Add(light, hn::Mul(hn::Set(kRowFloats, step.share[k]),
                                           hn::LoadU(kRowFloats, step.light[k] + i)));
        }
        const RowVector source = hn::LoadU(kRowFloats, step.source + i);
        const RowVector excess = hn::Sub(light, source);
        const RowVector left = hn::Mul(excess, hn::LoadU(kRowFloats, step.passing + i));
        const RowVector within = hn::Mul(excess, hn::LoadU(kRowFloats, step.mean_passing + i));
        hn::StoreU(hn::Add(source, left), kRowFloats, after + i);
        const RowVector before = hn::LoadU(kRowFloats, mean + i);
        hn::StoreU(hn::Add(before, hn::Mul(part, hn::Add(source, within))), kRowFloats, mean + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::cloud_light
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::cloud_light {

HWY_EXPORT(add_scaled_here);
HWY_EXPORT(step_row_here);

void add_scaled(const float* values, float weight, std::size_t count, float* sums) {
    HWY_DYNAMIC_DISPATCH(add_scaled_here)(values, weight, count, sums);
}

void step_row(const RowStep& step, std::size_t count, float* after, float* mean) {
    HWY_DYNAMIC_DISPATCH(step_row_here)(step, count, after, mean);
}

}  // namespace skybake::cloud_light
#endif
