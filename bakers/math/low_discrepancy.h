// The fixed points at which errors are measured: the same on every run and machine.
#pragma once

#include <array>
#include <vector>

namespace skybake {

// Points of the unit square that share their y.
struct PointRow {
    double y = 0;
    std::vector<double> x;
};

// rows * per_row points, spread evenly in [0, 1)^2 for any first so many rows: the additive
// recurrence with the plastic number (M. Roberts, "The unreasonable effectiveness of quasirandom
// sequences", 2018), each coordinate counted on by itself. With one point a row it is his sequence.
std::vector<PointRow> low_discrepancy_points(int rows, int per_row);

// Roberts' sequence in three dimensions: point `index`, from 0 on, of the unit cube [0, 1)^3.
std::array<double, 3> low_discrepancy_point(int index);

}  // namespace skybake
