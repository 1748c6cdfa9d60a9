// Where the probes of a table of columns may lie.
#pragma once

#include <array>

#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/field/choose_probes.h"

namespace skybake {

// The path of texture coordinates, kept off the horizon by kHorizonMargin, by what a runtime knows
// of it:
//
//   to_top                    altitude_km, cos_zenith
//   between by altitudes      low_altitude_km, high_altitude_km, angle_at_centre_deg
//   between by distance       altitude_km, cos_zenith, length_km
ProbePlace column_probe_place(const ColumnTable& table, const std::array<double, 3>& uvw);

// The texture coordinates of the place that a probe names.
std::array<double, 3> column_texture_coordinates(
    const ColumnTable& table, const std::vector<std::pair<std::string, double>>& at);

}  // namespace skybake
