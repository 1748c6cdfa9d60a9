// The quadrature of one cell of a ray: Gauss' three nodes on [0, 1], their weights, and the weights
// of the integral from 0 to each node.
#pragma once

#include <array>
#include <cstddef>

namespace skybake::cell_rule {

inline constexpr std::size_t kGauss = 3;
inline constexpr double kRoot15 = 3.87298334620741688518;
inline constexpr std::array<double, kGauss> kNodes = {0.5 - kRoot15 / 10, 0.5, 0.5 + kRoot15 / 10};
inline constexpr std::array<double, kGauss> kWeights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
inline constexpr std::array<std::array<double, kGauss>, kGauss> kUpTo = {{
    {5.0 / 36, 2.0 / 9 - kRoot15 / 15, 5.0 / 36 - kRoot15 / 30},
    {5.0 / 36 + kRoot15 / 24, 2.0 / 9, 5.0 / 36 - kRoot15 / 24},
    {5.0 / 36 + kRoot15 / 30, 2.0 / 9 + kRoot15 / 15, 5.0 / 36},
}};

}  // namespace skybake::cell_rule
