// Tables of pairs: density over altitude, and a cloud's profile over height.
#pragma once

#include <optional>
#include <vector>

#include "config/fields/number_reader.h"
#include "config/fields/point_tables.h"

namespace skybake::config {

// [["0 km", 1.0], ["10 km", 0.5]]: at least two, altitudes increasing from 0 up; densities have the
// range of the field.
std::optional<std::vector<DensityPoint>> read_density_table(const Reader& reader,
                                                            const Value& value);

// [[0, 0.0], [0.2, 1.0]]: at least one, heights increasing within [0, 1]; values have the range of
// the field.
std::optional<std::vector<HeightPoint>> read_height_table(const Reader& reader, const Value& value);

}  // namespace skybake::config
