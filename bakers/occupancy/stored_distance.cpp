#include "bakers/occupancy/stored_distance.h"

#include <algorithm>
#include <cmath>

#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

namespace {

constexpr double kArithmetic = 0x1p-20;
// Half a texel's diagonal times this is how far a place 1/256 texel off along each axis is away.
constexpr double kPlace = 1.0 / 128;

}  // namespace

DistanceCode::DistanceCode(const std::array<double, 2>& range_m,
                           const std::array<double, 3>& texel_m, config::PixelType type)
    : range_m_(range_m),
      ends_m_(range_m),
      type_(type),
      half_diagonal_m_(
          std::sqrt(texel_m[0] * texel_m[0] + texel_m[1] * texel_m[1] + texel_m[2] * texel_m[2]) /
          2),
      curvature_m2_(half_diagonal_m_ * half_diagonal_m_ + texel_m[2] * texel_m[2] / 8),
      arithmetic_m_(kArithmetic * std::max(-range_m[0], range_m[1])) {
    if (!is_unorm()) ends_m_ = {0, 1};
    surface_ = outside(0);
}

bool DistanceCode::is_unorm() const {
    return type_ == config::PixelType::unorm8 || type_ == config::PixelType::unorm16;
}

// What is left of a distance when all is taken off that a lookup may add.
double DistanceCode::shortened(float square) const {
    const double distance = std::sqrt(double{square}) * (1 - kArithmetic);
    const double half = half_diagonal_m_;
    double taken = 2 * half;
    if (distance >= 3 * half * (1 + 4 * kArithmetic)) {
        taken = std::min(half, curvature_m2_ / (2 * (distance - 2 * half)));
    }
    return std::max(0.0, distance - taken - kPlace * half - arithmetic_m_);
}

float DistanceCode::outside(float square) const {
    const double distance = std::min(shortened(square), range_m_[1]);
    if (!is_unorm()) return stored_down(static_cast<float>(distance), type_);
    const double code = (distance - range_m_[0]) * steps() / (range_m_[1] - range_m_[0]);
    return static_cast<float>(std::floor(code) / steps());
}

float DistanceCode::inside(float square) const {
    const double distance = std::max(-shortened(square), range_m_[0]);
    if (!is_unorm()) return stored_up(static_cast<float>(distance), type_);
    const double code = (distance - range_m_[0]) * steps() / (range_m_[1] - range_m_[0]);
    return std::min(surface_, static_cast<float>(std::ceil(code) / steps()));
}

double DistanceCode::metres(double value) const {
    return ends_m_[0] + value * (ends_m_[1] - ends_m_[0]);
}

double DistanceCode::most_lost() const {
    constexpr double kHalfStep = 0x1p-10;  // of a half, of the value itself
    double step = 0;
    if (is_unorm()) step = (range_m_[1] - range_m_[0]) / steps();
    if (type_ == config::PixelType::half) step = kHalfStep * std::max(-range_m_[0], range_m_[1]);
    return half_diagonal_m_ * (2 + kPlace) + 2 * arithmetic_m_ + step +
           kArithmetic * std::max(-range_m_[0], range_m_[1]);
}

}  // namespace skybake::occupancy
