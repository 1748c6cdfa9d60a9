// Where factors of light that goes on by small angles stand in a table (asset = "forward_scattering"):
//
//   x = sqrt(sin(angle / 2))     y = depth / (depth + kMiddleDepth) (1 + kMiddleDepth / kDeepest)
//
// x is 0 straight on and 1 straight back; y is 0 where the sun is not hidden and 1 at kDeepest. End points
// are on the centres of texels.
#pragma once

#include <cmath>

namespace skybake::forward_scattering {

// Half of the texels are for smaller depths.
inline constexpr double kMiddleDepth = 4;
// Where no sunlight is left: exp(-252 s) is below 1e-15 for the least s, 0.14 of degree 0.
inline constexpr double kDeepest = 252;
// y / (depth / (depth + kMiddleDepth)).
inline constexpr double kStretch = (kDeepest + kMiddleDepth) / kDeepest;

// The coordinate of an angle, by 1 - its cosine.
inline double angle_coordinate_of_offset(double one_minus_cosine) {
    return std::sqrt(std::sqrt(one_minus_cosine / 2));
}

// The coordinate of an optical depth >= 0.
inline double depth_coordinate(double depth) {
    const double within = std::fmin(depth, kDeepest);
    return kStretch * within / (within + kMiddleDepth);
}

// The optical depth of a coordinate.
inline double depth_at(double y) { return kMiddleDepth * y / (kStretch - y); }

}  // namespace skybake::forward_scattering
