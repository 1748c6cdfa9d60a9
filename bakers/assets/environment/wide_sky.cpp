#include "bakers/assets/environment/wide_sky.h"

#include <algorithm>
#include <vector>

#include "bakers/light/wide_row.h"

namespace skybake {

TableModel wide_sky_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground) {
    TableModel model = sky_view_model(light, camera, sun, ground);
    model.row = [&light, &camera, sun, ground, channels = model.channels](
                    int, double y, const std::vector<double>& x, double* values) {
        const RowOfView view(camera, y, sun);
        const auto row_of = [&](const SkyLight& any) {
            const SkyRow row(any.integrator(), any.medium(), any.higher_orders(), view.ray(1),
                             &any.sunlight());
            return wide_radiance(row, any.medium(), view, x);
        };
        for (SkyRadiance& radiance : with_once(light, row_of)) {
            if (ground == SeenGround::black) radiance.ground = {};
            const Spectrum wanted = light.wanted(radiance);
            values = std::copy_n(data(wanted), channels, values);
        }
    };
    return model;
}

}  // namespace skybake
