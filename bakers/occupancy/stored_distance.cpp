#include "bakers/occupancy/stored_distance.h"

#include <algorithm>
#include <cmath>

#include "bakers/occupancy/code_kernel.h"
#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

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
        code_outside(
            {half_diagonal_m_, curvature_m2_, arithmetic_m_, range_m_[0], range_m_[1], steps()},
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
