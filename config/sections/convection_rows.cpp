#include <span>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range cells_range{8, 512};
constexpr Range layer_range{1, 1e4};
constexpr Range inversion_range{1e-4, 1e8};  // 0.7 times any extent lies within
constexpr Range instability_range{-20, 20};
constexpr Range temperature_range{240, 308};  // Bolton's formula of saturation holds
constexpr Range wind_range{-200, 200};
constexpr Range patches_range{0, 10000};
constexpr Range width_range{1, 1e6};
constexpr Range warmth_range{0, 20};
constexpr Range minutes_range{.minimum = 0, .maximum = 600, .open_minimum = true};

const ConvectionField convection_table[] = {
    {"cells", Kind::voxels, &Convection::cells,
     "cells over the cloud's extent along x, y and z, in which the air moves", cells_range,
     KeyFlag::required, Hint{"products of 2, 3 and 5, along x and y even; edges of 20 to 50 m"}},
    {"mixed_layer", Kind::length, &Convection::mixed_layer,
     "depth of the layer below the base, from whose floor warm air rises", layer_range,
     Default{R"("600 m")"}, Hint{"it adds cells below the cloud"}},
    {"inversion", Kind::length, &Convection::inversion,
     "height above the base at which stable air begins; 0.7 times that of the extent by default",
     inversion_range},
    {"instability", Kind::number, &Convection::instability,
     "kelvin per kilometre by which the air below the inversion cools faster than what rises in "
     "cloud",
     instability_range, Default{"1.5"}, Hint{"0.5 keeps cumulus low, 3 makes towers"}},
    {"temperature", Kind::number, &Convection::temperature, "temperature at the base in kelvin",
     temperature_range, Default{"288"}, Hint{"warmer air holds more water"}},
    {"humidity", Kind::fraction, &Convection::humidity, "relative humidity above the base",
     unit_range, Default{"0.7"}, Hint{"dry air eats what mixes with it"}},
    {"wind", Kind::pair, &Convection::wind, "wind along x and y up to the base, in m/s", wind_range,
     Default{"[0, 0]"},
     Hint{"the tile moves with the mean wind; only its change with height leans"}},
    {"wind_above", Kind::pair, &Convection::wind_above,
     "wind along x and y at the inversion, in m/s", wind_range, Default{"[0, 0]"}},
    {"patches", Kind::integer, &Convection::patches, "number of warm patches of ground",
     patches_range, Default{"12"}},
    {"patch_width", Kind::length_bounds, &Convection::patch_width,
     "range of the width of a patch, within which it is warmer by more than 1/e", width_range,
     Default{R"(["0.4 km", "1.2 km"])"}},
    {"warmth", Kind::number, &Convection::warmth, "kelvin by which air above a patch is warmed",
     warmth_range, Default{"0.6"}},
    {"seed", Kind::seed, &Convection::seed, "another seed gives other patches", Default{"1"}},
    {"minutes", Kind::number, &Convection::minutes, "minutes for which the cloud grows",
     minutes_range, Default{"20"}},
};

}  // namespace

std::span<const ConvectionField> convection_fields() { return convection_table; }

}  // namespace skybake::config
