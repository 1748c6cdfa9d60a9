#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/code_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/occupancy/code_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::occupancy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

constexpr hn::ScalableTag<double> kDoubles;
constexpr hn::Rebind<float, decltype(kDoubles)> kFloats;
using Doubles = hn::Vec<decltype(kDoubles)>;

HWY_INLINE Doubles all(double value) { return hn::Set(kDoubles, value); }

// DistanceCode::shortened.
HWY_INLINE Doubles shortened(const CodeNumbers& n, Doubles squares) {
    const double half = n.half_diagonal_m;
    const Doubles distance = hn::Mul(hn::Sqrt(squares), all(1 - kCodeArithmetic));
    const Doubles beyond = hn::Sub(distance, all(2 * half));
    const Doubles by_curvature = hn::Div(all(n.curvature_m2), hn::Mul(all(2), beyond));
    const auto is_far = hn::Ge(distance, all(3 * half * (1 + 4 * kCodeArithmetic)));
    const Doubles taken = hn::IfThenElse(is_far, hn::Min(all(half), by_curvature), all(2 * half));
    const Doubles left =
        hn::Sub(hn::Sub(hn::Sub(distance, taken), all(kCodePlace * half)), all(n.arithmetic_m));
    return hn::Max(hn::Zero(kDoubles), left);
}

HWY_INLINE hn::Vec<decltype(kFloats)> code(const CodeNumbers& n,
                                           hn::Vec<decltype(kFloats)> squares) {
    const Doubles distance = hn::Min(shortened(n, hn::PromoteTo(kDoubles, squares)), all(n.high_m));
    const Doubles steps =
        hn::Div(hn::Mul(hn::Sub(distance, all(n.low_m)), all(n.steps)), all(n.high_m - n.low_m));
    return hn::DemoteTo(kFloats, hn::Div(hn::Floor(steps), all(n.steps)));
}

}  // namespace

void fill_codes(const CodeNumbers& numbers, const float* squares, std::size_t count, float* out) {
    constexpr std::size_t kMost = hn::MaxLanes(kFloats);
    std::size_t i = 0;
    for (; i + kMost <= count; i += kMost) {
        hn::StoreU(code(numbers, hn::LoadU(kFloats, squares + i)), kFloats, out + i);
    }
    if (i == count) return;
    float last[kMost] = {};
    for (std::size_t k = i; k < count; ++k) last[k - i] = squares[k];
    hn::StoreU(code(numbers, hn::LoadU(kFloats, last)), kFloats, last);
    for (std::size_t k = i; k < count; ++k) out[k] = last[k - i];
}

}  // namespace skybake::occupancy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::occupancy {

HWY_EXPORT(fill_codes);

void code_outside(const CodeNumbers& numbers, const float* squares, std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(fill_codes)(numbers, squares, count, out);
}

}  // namespace skybake::occupancy
#endif  // HWY_ONCE
