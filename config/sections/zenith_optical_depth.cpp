#include "config/sections/zenith_optical_depth.h"

#include <algorithm>
#include <cmath>

namespace skybake::config {
namespace {

// The part of the line from a to b, where the density runs linearly from density_a to density_b,
// that lies between `bottom` and `top`: its length times its mean density.
double linear_column(double a, double density_a, double b, double density_b, double bottom,
                     double top) {
    const double low = std::max(a, bottom);
    const double high = std::min(b, top);
    if (!(high > low)) return 0;
    const double middle = ((low - a) + (high - a)) / 2 / (b - a);
    return (high - low) * (density_a + (density_b - density_a) * middle);
}

double tent_column(double center, double half_width, double thickness) {
    return linear_column(center - half_width, 0, center, 1, 0, thickness) +
           linear_column(center, 1, center + half_width, 0, 0, thickness);
}

double tabulated_column(const std::vector<DensityPoint>& table, double thickness) {
    double column = 0;
    for (std::size_t i = 1; i < table.size(); ++i) {
        column += linear_column(table[i - 1].altitude.meters, table[i - 1].density,
                                table[i].altitude.meters, table[i].density, 0, thickness);
    }
    return column;
}

}  // namespace

double density_column(const Layer& layer, Length thickness) {
    const double top = thickness.meters;
    switch (layer.profile) {
        case Profile::exponential:
            return -layer.scale_height.meters * std::expm1(-top / layer.scale_height.meters);
        case Profile::tent:
            return tent_column(layer.center_altitude.meters, layer.half_width.meters, top);
        case Profile::slab:
            return linear_column(layer.bottom_altitude.meters, 1, layer.top_altitude.meters, 1, 0,
                                 top);
        case Profile::tabulated:
            return tabulated_column(layer.table, top);
    }
    return 0;
}

std::vector<double> zenith_optical_depth(const Layer& layer, const Atmosphere& atmosphere) {
    const Length thickness{atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
    const double column = density_column(layer, thickness);
    std::vector<double> depths;
    for (const InverseLength extinction : layer.extinction) {
        depths.push_back(extinction.per_meter * column);
    }
    return depths;
}

}  // namespace skybake::config
