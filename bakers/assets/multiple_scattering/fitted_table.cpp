#include "bakers/assets/multiple_scattering/fitted_table.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "bakers/field/texel_axis.h"
#include "bakers/math/relative_error.h"

namespace skybake {

Image2<double> fitted_texels(const SkyMedium& medium, const SolvedLight& light,
                             const std::optional<config::Scene>& scene, const SunColumns& columns,
                             std::array<int, 2> size, int threads) {
    FitScene fit;
    if (scene) {
        fit.lowest_camera_km = scene->altitude[0].kilometers();
        fit.highest_camera_km = scene->altitude[1].kilometers();
        fit.smallest_sun_zenith = 0.5 * std::numbers::pi - scene->sun_elevation[1].radians;
        fit.largest_sun_zenith = 0.5 * std::numbers::pi - scene->sun_elevation[0].radians;
    }
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    FitAxes axes;
    for (int x = 0; x < size[0]; ++x) {
        axes.sun_cos_zenith_of_columns.push_back(
            columns.cosine(texel_coordinate(kConvention, x, size[0])));
    }
    for (int y = 0; y < size[1]; ++y) {
        axes.altitudes_km_of_rows.push_back(medium.air.thickness_km *
                                            texel_coordinate(kConvention, y, size[1]));
    }
    axes.column_of = [&columns, size](double sun_cos_zenith) {
        return columns.coordinate(sun_cos_zenith) * (size[0] - 1);
    };
    return fit_mean_radiance(medium, light, fit, axes, {}, threads);
}

TableModel fitted_model(const Image2<double>& texels) {
    TableModel model;
    model.channels = texels.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    model.cost_per_texel = {1};
    model.row = [&texels](int, double y, const std::vector<double>& x, double* values) {
        const double row = y * (texels.height - 1);
        const int low = std::min(static_cast<int>(row), std::max(texels.height - 2, 0));
        const int high = std::min(low + 1, texels.height - 1);
        for (const double coordinate : x) {
            const double column = coordinate * (texels.width - 1);
            const int left = std::min(static_cast<int>(column), std::max(texels.width - 2, 0));
            const int right = std::min(left + 1, texels.width - 1);
            for (int c = 0; c < texels.channels; ++c) {
                const auto between = [c, s = column - left](const double* a, const double* b) {
                    return a[c] + s * (b[c] - a[c]);
                };
                const double below = between(texels.texel(left, low), texels.texel(right, low));
                const double above = between(texels.texel(left, high), texels.texel(right, high));
                *values++ = below + (row - low) * (above - below);
            }
        }
    };
    model.reference = [row = model.row](double y, const std::vector<double>& x, double* values) {
        row(0, y, x, values);
    };
    model.error = relative_error;
    return model;
}

}  // namespace skybake
