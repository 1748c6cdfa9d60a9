#include "bakers/assets/environment/environment_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/sky_asset.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

using config::EnvironmentBake;

namespace {

// The angle above the horizon, in radians, at a coordinate y, and back.
double above_horizon(const SkyViewCamera& camera, double y) {
    return environment_elevation_deg(y) / kDegreesPerRadian + camera.dip();
}
double coordinate_of(const SkyViewCamera& camera, double above_horizon) {
    return 0.5 - (above_horizon - camera.dip()) * kDegreesPerRadian / 180;
}

// Rays from space that pass above the air see nothing.
bool sees_air(const SkyViewCamera& camera, double above_horizon) {
    return !camera.in_space() || above_horizon <= camera.range_above();
}

// The model of sky_view, whose rows may have any angle above the horizon and any azimuth.
using SkyRowFunction = std::function<void(double y, const std::vector<double>& x, double* values)>;

void fill_row(const SkyViewCamera& camera, int channels, double y, const std::vector<double>& x,
              double* values, const SkyRowFunction& sky_row) {
    const double angle = above_horizon(camera, y);
    if (!sees_air(camera, angle)) {
        std::fill_n(values, x.size() * static_cast<std::size_t>(channels), 0.0);
        return;
    }
    std::vector<double> azimuths;  // in half turns from the sun, to either side
    for (const double coordinate : x) azimuths.push_back(std::fabs(2 * coordinate - 1));
    sky_row(camera.coordinate(angle), azimuths, values);
}

void describe(const EnvironmentBake& bake, const SkyViewCamera& camera, const Shell& shell,
              Baked& table) {
    table.kind = "environment";
    table.content = fmt::format(
        "radiance of the sky and of the ground around a camera (1/sr) for a solar irradiance of 1, "
        "without the sun's disc: {}",
        light_text(bake.orders, bake.layers));
    table.mapping = "longitude_latitude";
    table.axes.resize(2);
    table.axes[0] = {"azimuth_deg", "u = azimuth from the sun / 360 degrees + 1/2",
                     "end points on texture edges", -180, 180};
    table.axes[1] = {"elevation_deg", "v = 1/2 - elevation / 180 degrees",
                     "end points on texture edges", 90, -90};
    for (AxisMapping& axis : table.axes) axis.end_points = TexelConvention::end_points_on_edges;
    table.axes[0].wrap = AxisWrap::repeat;
    table.axes[0].constants = {{"range_deg", 360.0}};
    table.axes[1].constants = shell_constants(shell);
    const Facts numbers = {
        {"dip_deg", camera.dip() * kDegreesPerRadian},
        {"sun_elevation_deg", to_digits(bake.sun_elevation.radians * kDegreesPerRadian, 9)},
        {"camera_altitude_km", to_digits(bake.altitude.kilometers(), 9)}};
    table.axes[1].constants.insert(table.axes[1].constants.end(), numbers.begin(), numbers.end());
    set_files(bake, table);
    describe_sky_table(table);
}

}  // namespace

double environment_azimuth_deg(double x) { return 360 * (x - 0.5); }

double environment_elevation_deg(double y) { return 180 * (0.5 - y); }

TableModel environment_model(const SkyLight& light, const SkyViewCamera& camera,
                             const SunZenith& sun) {
    TableModel model = sky_view_model(light, camera, sun);
    model.convention = TexelConvention::end_points_on_edges;
    model.v_of = nullptr;
    const int channels = model.channels;
    model.probe_place = [&camera](double x, double y) {
        const double angle = above_horizon(camera, y);
        if (!sees_air(camera, angle)) return std::array<double, 2>{x, y};
        const double off = camera.angle_at(camera.off_the_edges(camera.coordinate(angle)));
        return std::array<double, 2>{x, coordinate_of(camera, off)};
    };
    model.row = [&camera, channels, sky = model.row](int level, double y,
                                                     const std::vector<double>& x, double* values) {
        fill_row(camera, channels, y, x, values,
                 [&](double of_view, const std::vector<double>& azimuths, double* row) {
                     sky(level, of_view, azimuths, row);
                 });
    };
    model.reference = [&camera, channels, sky = model.reference](
                          double y, const std::vector<double>& x, double* values) {
        fill_row(camera, channels, y, x, values, sky);
    };
    return model;
}

config::Outcome<Baked> bake_environment(const SkyLights& lights, const EnvironmentBake& bake,
                                        const BakeOptions& options, Baked table) {
    const Shell& shell = lights.first().shell();
    const SkyViewCamera camera(shell, bake.altitude.kilometers());
    describe(bake, camera, shell, table);
    const auto place_of = [](double x, double y) {
        return Place{{"azimuth_deg", environment_azimuth_deg(x)},
                     {"elevation_deg", environment_elevation_deg(y)}};
    };
    const SunZenith sun = sun_at_elevation(bake.sun_elevation.radians);
    const TableModel model =
        lights.model([&](const SkyLight& light) { return environment_model(light, camera, sun); });
    AccuracyRequest request = sky_table_request(bake.size);
    // The horizon lies within a row of texels, so more rows must be measured than of sky_view.
    request.quick_search = {64, 36, 8, 6, 64};
    return finish_table(model, request, options, place_of, std::move(table));
}

}  // namespace skybake
