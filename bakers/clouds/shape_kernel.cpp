#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/clouds/shape_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <array>
#include <cassert>
#include <cstring>

#include "bakers/clouds/shape_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::cloud::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Floats = hn::ScalableTag<float>;
constexpr Floats kFloats;
using FloatVector = hn::Vec<Floats>;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

HWY_INLINE FloatVector constant(float value) { return hn::Set(kFloats, value); }

// The last vector of a row, where fewer floats are left than it has.
HWY_INLINE FloatVector load(const float* from, std::size_t left) {
    if (left >= kLanes) return hn::LoadU(kFloats, from);
    HWY_ALIGN std::array<float, kLanes> part{};
    std::memcpy(part.data(), from, left * sizeof(float));
    return hn::Load(kFloats, part.data());
}

HWY_INLINE void store(FloatVector values, float* to, std::size_t left) {
    if (left >= kLanes) {
        hn::StoreU(values, kFloats, to);
        return;
    }
    HWY_ALIGN std::array<float, kLanes> part;
    hn::Store(values, kFloats, part.data());
    std::memcpy(to, part.data(), left * sizeof(float));
}

HWY_INLINE FloatVector profile(const SliceShape& slice, const ColumnRow& columns, std::size_t i,
                               std::size_t left) {
    const FloatVector first = constant(slice.profile[0]);
    if (columns.second_type == nullptr) return first;
    const FloatVector second =
        hn::Mul(load(columns.second_type + i, left), constant(slice.profile[1] - slice.profile[0]));
    const FloatVector third =
        hn::Mul(load(columns.third_type + i, left), constant(slice.profile[2] - slice.profile[1]));
    return hn::Add(hn::Add(first, second), third);
}

}  // namespace

bool ShapeBase(const SliceShape& slice, const ColumnRow& columns, float level, std::size_t count,
               float* values) {
    const FloatVector zero = hn::Zero(kFloats);
    FloatVector greatest = constant(level);
    for (std::size_t i = 0; i < count; i += kLanes) {
        const std::size_t left = count - i;
        const FloatVector height = hn::Max(
            hn::Add(profile(slice, columns, i, left), load(columns.towers + i, left)), zero);
        const FloatVector base =
            hn::Add(hn::Mul(load(values + i, left), height), load(columns.offset + i, left));
        greatest = hn::Max(greatest, base);
        store(base, values + i, left);
    }
    return !hn::AllTrue(kFloats, hn::Le(greatest, constant(level)));
}

void Erode(const SliceShape& slice, const float* detail, float level, std::size_t count,
           float* values) {
    const FloatVector zero = hn::Zero(kFloats);
    const FloatVector one = constant(1);
    const FloatVector strength = constant(slice.erosion);
    const FloatVector billow = constant(slice.billow);
    for (std::size_t i = 0; i < count; i += kLanes) {
        const std::size_t left = count - i;
        const FloatVector d = hn::Min(hn::Max(load(detail + i, left), zero), one);
        const FloatVector turned =
            hn::Add(d, hn::Mul(billow, hn::Sub(one, hn::Mul(constant(2), d))));
        const FloatVector erosion = hn::Mul(strength, turned);
        const FloatVector base = load(values + i, left);
        const FloatVector eroded = hn::Div(hn::Sub(base, erosion), hn::Sub(one, erosion));
        store(hn::IfThenElseZero(hn::Gt(base, constant(level)), eroded), values + i, left);
    }
}

void Finish(const CloudPlan& plan, float water, std::size_t count, float* values) {
    const FloatVector zero = hn::Zero(kFloats);
    const FloatVector one = constant(1);
    const FloatVector threshold = constant(plan.threshold);
    const FloatVector inverse = constant(plan.inverse_softness);
    const bool hard = plan.inverse_softness == 0;
    const bool saturates = plan.threshold_in_file && plan.inverse_full > 0;
    for (std::size_t i = 0; i < count; i += kLanes) {
        const std::size_t left = count - i;
        const FloatVector made = hn::Max(load(values + i, left), zero);
        FloatVector value = made;
        if (saturates) value = hn::Min(hn::Mul(made, constant(plan.inverse_full)), one);
        if (plan.threshold_in_file && hard) {
            value = hn::IfThenElseZero(hn::Gt(made, threshold), value);
        } else if (plan.threshold_in_file) {
            const FloatVector x =
                hn::Min(hn::Max(hn::Mul(hn::Sub(made, threshold), inverse), zero), one);
            const FloatVector edge =
                hn::Mul(hn::Mul(x, x), hn::Sub(constant(3), hn::Mul(constant(2), x)));
            value = hn::Mul(value, edge);
        }
        if (plan.threshold_in_file) value = hn::Mul(value, constant(water));
        store(value, values + i, left);
    }
}

}  // namespace skybake::cloud::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::cloud {

HWY_EXPORT(ShapeBase);
HWY_EXPORT(Erode);
HWY_EXPORT(Finish);

bool shape_base(const SliceShape& slice, const ColumnRow& columns, float level, std::size_t count,
                float* values) {
    assert(level >= 0);
    return HWY_DYNAMIC_DISPATCH(ShapeBase)(slice, columns, level, count, values);
}

void erode(const SliceShape& slice, const float* detail, float level, std::size_t count,
           float* values) {
    HWY_DYNAMIC_DISPATCH(Erode)(slice, detail, level, count, values);
}

void finish(const CloudPlan& plan, float water, std::size_t count, float* values) {
    HWY_DYNAMIC_DISPATCH(Finish)(plan, water, count, values);
}

}  // namespace skybake::cloud
#endif  // HWY_ONCE
