#include "bakers/math/low_discrepancy.h"

#include <cmath>

namespace skybake {

namespace {

double member(double step, int index) {
    const double sum = 0.5 + step * (index + 1);
    return sum - std::floor(sum);
}

}  // namespace

std::vector<PointRow> low_discrepancy_points(int rows, int per_row) {
    // 1 / g and 1 / g^2, g = 1.3247... the real root of g^3 = g + 1.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    std::vector<PointRow> points;
    for (int j = 0; j < rows; ++j) {
        PointRow row{member(kStepY, j), {}};
        for (int k = 0; k < per_row; ++k) row.x.push_back(member(kStepX, j * per_row + k));
        points.push_back(std::move(row));
    }
    return points;
}

std::array<double, 3> low_discrepancy_point(int index) {
    // Powers of 1 / g, g = 1.2207... the real root of g^4 = g + 1.
    return {member(0.8191725133961645, index), member(0.6710436067037893, index),
            member(0.5497004779019703, index)};
}

}  // namespace skybake
