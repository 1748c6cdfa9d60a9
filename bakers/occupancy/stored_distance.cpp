#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/stored_distance.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "bakers/occupancy/occupied_cells.h"
#include "bakers/occupancy/stored_distance.h"

#ifndef SKYBAKE_BAKERS_OCCUPANCY_STORED_DISTANCE_ONCE
#define SKYBAKE_BAKERS_OCCUPANCY_STORED_DISTANCE_ONCE
namespace skybake::occupancy {

// The numbers that a code is made from (DistanceCode).
struct CodeNumbers {
    double half_diagonal_m = 0;  // of a texel
    double curvature_m2 = 0;
    double arithmetic_m = 0;
    double low_m = 0;  // of the range
    double high_m = 0;
    double steps = 0;  // of the pixel type
};

inline constexpr double kCodeArithmetic = 0x1p-20;
// Half a texel's diagonal times this is how far a place 1/256 texel off along each axis is away.
inline constexpr double kCodePlace = 1.0 / 128;

}  // namespace skybake::occupancy
#endif

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

// Writes DistanceCode::outside of each squared distance, bit for bit.
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

DistanceCode::DistanceCode(const std::array<double, 2>& range_m,
                           const std::array<double, 3>& texel_m, PixelType type)
    : range_m_(range_m),
      ends_m_(range_m),
      type_(type),
      half_diagonal_m_(
          std::sqrt(texel_m[0] * texel_m[0] + texel_m[1] * texel_m[1] + texel_m[2] * texel_m[2]) /
          2),
      curvature_m2_(half_diagonal_m_ * half_diagonal_m_ + texel_m[2] * texel_m[2] / 8),
      arithmetic_m_(kCodeArithmetic * std::max(-range_m[0], range_m[1])) {
    if (!is_unorm(type_)) ends_m_ = {0, 1};
    surface_ = outside(0);
}

// Returns a distance less all that a lookup may add to it.
double DistanceCode::shortened(float square) const {
    const double distance = std::sqrt(double{square}) * (1 - kCodeArithmetic);
    const double half = half_diagonal_m_;
    double taken = 2 * half;
    if (distance >= 3 * half * (1 + 4 * kCodeArithmetic)) {
        taken = std::min(half, curvature_m2_ / (2 * (distance - 2 * half)));
    }
    return std::max(0.0, distance - taken - kCodePlace * half - arithmetic_m_);
}

float DistanceCode::outside(float square) const {
    const double distance = std::min(shortened(square), range_m_[1]);
    if (!is_unorm(type_)) return stored_down(static_cast<float>(distance), type_);
    const double code = (distance - range_m_[0]) * steps() / (range_m_[1] - range_m_[0]);
    return static_cast<float>(std::floor(code) / steps());
}

void DistanceCode::outside(const float* squares, std::size_t count, float* out) const {
    if (is_unorm(type_)) {
        HWY_DYNAMIC_DISPATCH(fill_codes)
        ({half_diagonal_m_, curvature_m2_, arithmetic_m_, range_m_[0], range_m_[1], steps()},
         squares, count, out);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) out[i] = outside(squares[i]);
}

float DistanceCode::inside(float square) const {
    const double distance = std::max(-shortened(square), range_m_[0]);
    if (!is_unorm(type_)) return stored_up(static_cast<float>(distance), type_);
    const double code = (distance - range_m_[0]) * steps() / (range_m_[1] - range_m_[0]);
    return std::min(surface_, static_cast<float>(std::ceil(code) / steps()));
}

double DistanceCode::metres(double value) const {
    return ends_m_[0] + value * (ends_m_[1] - ends_m_[0]);
}

double DistanceCode::most_lost() const {
    constexpr double kHalfStep = 0x1p-10;  // of a half, of the value itself
    double step = 0;
    if (is_unorm(type_)) step = (range_m_[1] - range_m_[0]) / steps();
    if (type_ == PixelType::half) step = kHalfStep * std::max(-range_m_[0], range_m_[1]);
    return half_diagonal_m_ * (2 + kCodePlace) + 2 * arithmetic_m_ + step +
           kCodeArithmetic * std::max(-range_m_[0], range_m_[1]);
}

}  // namespace skybake::occupancy
#endif  // HWY_ONCE
