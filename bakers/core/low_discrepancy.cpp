#include "bakers/core/low_discrepancy.h"

#include <cmath>

namespace skybake {

std::vector<PointRow> low_discrepancy_points(int rows, int per_row) {
    // 1 / g and 1 / g^2, g = 1.3247... the real root of g^3 = g + 1.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    const auto member = [](double step, int i) {
        const double sum = 0.5 + step * (i + 1);
        return sum - std::floor(sum);
    };
    std::vector<PointRow> points;
    for (int j = 0; j < rows; ++j) {
        PointRow row{member(kStepY, j), {}};
        for (int k = 0; k < per_row; ++k) row.x.push_back(member(kStepX, j * per_row + k));
        points.push_back(std::move(row));
    }
    return points;
}

}  // namespace skybake
