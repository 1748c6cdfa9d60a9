// Entries of tables of numbers.
#pragma once

#include "config/text/quantity.h"

namespace skybake::config {

// One entry of `table = [["0 km", 1.0], ...]`.
struct DensityPoint {
    Length altitude;
    double density = 0;
};

// One entry of `table = [[0, 0.0], [0.2, 1.0]]`.
struct HeightPoint {
    double height = 0;  // in [0, 1]
    double value = 0;
};

}  // namespace skybake::config
