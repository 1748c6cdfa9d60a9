// The optical depth of a layer straight up, from the ground to the top of the atmosphere: printed
// by `show`, so that a slip of a unit is seen, and the basis of a warning. Bakers have their own.
#pragma once

#include <vector>

#include "config/sections/atmosphere.h"

namespace skybake::config {

// The layer's density integrated over altitude from 0 to `thickness`, in metres; closed forms.
double density_column(const Layer& layer, Length thickness);

// Extinction times that column, one value per channel.
std::vector<double> zenith_optical_depth(const Layer& layer, const Atmosphere& atmosphere);

}  // namespace skybake::config
