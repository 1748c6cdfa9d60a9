#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/cloud_light/depth_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/assets/cloud_light/depth_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::cloud_light {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

// A block is a multiple of the lanes.
using Floats = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Floats>;
constexpr Floats kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
static_assert(kDepthBlock % kLanes == 0);

// The sums of four vectors stay in registers while rows pass.
constexpr std::size_t kTogether = 4;

void add_part(std::span<const WeightedRow> rows, std::size_t first, float* sums) {
    Vector sum[kTogether];
    for (Vector& one : sum) one = hn::Zero(kFloats);
    for (const WeightedRow& row : rows) {
        const Vector weight = hn::Set(kFloats, row.weight);
        for (std::size_t i = 0; i < kTogether; ++i) {
            const Vector values = hn::LoadU(kFloats, row.values + first + i * kLanes);
            sum[i] = hn::Add(sum[i], hn::Mul(weight, values));
        }
    }
    for (std::size_t i = 0; i < kTogether; ++i) {
        hn::StoreU(sum[i], kFloats, sums + first + i * kLanes);
    }
}

HWY_INLINE Vector between(Vector a, Vector b, float share) {
    return hn::Add(a, hn::Mul(hn::Set(kFloats, share), hn::Sub(b, a)));
}

HWY_INLINE Vector filtered(const FilteredRow& row, std::size_t at) {
    const auto along_x = [&](std::size_t pair) HWY_ATTR {
        return between(hn::LoadU(kFloats, row.corners[pair] + at),
                       hn::LoadU(kFloats, row.corners[pair + 1] + at), row.share[0]);
    };
    return between(between(along_x(0), along_x(2), row.share[1]),
                   between(along_x(4), along_x(6), row.share[1]), row.share[2]);
}

// density of cloud_phase.h.
HWY_INLINE Vector density_of(Vector value, float threshold, float over_softness) {
    const Vector one = hn::Set(kFloats, 1.0F);
    const Vector above = hn::Sub(value, hn::Set(kFloats, threshold));
    const Vector x = hn::Min(hn::Mul(above, hn::Set(kFloats, over_softness)), one);
    const Vector step =
        hn::Mul(hn::Mul(x, x), hn::Sub(hn::Set(kFloats, 3.0F), hn::Mul(hn::Set(kFloats, 2.0F), x)));
    return hn::IfThenElseZero(hn::Gt(above, hn::Zero(kFloats)), hn::Mul(value, step));
}

}  // namespace

void AddRows(std::span<const WeightedRow> rows, float* sums) {
    for (std::size_t first = 0; first < kDepthBlock; first += kTogether * kLanes) {
        add_part(rows, first, sums);
    }
}

void AddFilteredRows(std::span<const FilteredRow> rows, float threshold, float over_softness,
                     float* sums) {
    for (std::size_t first = 0; first < kDepthBlock; first += kLanes) {
        Vector sum = hn::Zero(kFloats);
        for (const FilteredRow& row : rows) {
            const Vector density = density_of(filtered(row, first), threshold, over_softness);
            sum = hn::Add(sum, hn::Mul(hn::Set(kFloats, row.weight), density));
        }
        hn::StoreU(sum, kFloats, sums + first);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::cloud_light
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::cloud_light {

HWY_EXPORT(AddRows);
HWY_EXPORT(AddFilteredRows);

void add_rows(std::span<const WeightedRow> rows, float* sums) {
    HWY_DYNAMIC_DISPATCH(AddRows)(rows, sums);
}

void add_filtered_rows(std::span<const FilteredRow> rows, const CloudOptics& optics, float* sums) {
    // A softness of 0 is a step: any value above the threshold has all of its density.
    constexpr float kStep = 0x1p126F;
    const auto softness = static_cast<float>(optics.edge_softness);
    const float over_softness = softness > 1 / kStep ? 1 / softness : kStep;
    HWY_DYNAMIC_DISPATCH(AddFilteredRows)
    (rows, static_cast<float>(optics.threshold), over_softness, sums);
}

}  // namespace skybake::cloud_light
#endif  // HWY_ONCE
