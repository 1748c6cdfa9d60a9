#include "bakers/render/solved_sky.h"

#include <cmath>

#include "bakers/field/interpolation.h"

namespace skybake {

std::optional<SolvedSky> SolvedSky::of(const PreviewAsset& sky_view, const Shell& shell,
                                       const Place& place) {
    const bool is_one =
        sky_view.entry.kind == "sky_view" && sky_view.table.width > 1 && sky_view.table.height > 1;
    if (!is_one) return std::nullopt;
    return SolvedSky(sky_view.table, shell, place);
}

void SolvedSky::look_up(double elevation_degrees, double azimuth_degrees, double* radiance) const {
    const double above_horizon = elevation_degrees / kDegreesPerRadian + camera_.dip();
    const double x = std::fabs(std::remainder(azimuth_degrees, 360.0)) / 180;
    const double u =
        texture_coordinate(TexelConvention::end_points_on_texel_centres, x, table_.width);
    bilinear(table_, u, sky_view_v(camera_.coordinate(above_horizon), table_.height), radiance);
}

}  // namespace skybake
