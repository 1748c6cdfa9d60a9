#include "bakers/assets/sky_view/sky_view_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/sky_row.h"
#include "bakers/math/relative_error.h"
#include "bakers/math/transcendental.h"
#include "config/assets/sky_view.h"

namespace skybake {

using config::SkyViewBake;

namespace {

// The suns whose tables stand one below the other, and the camera, in the digits that people write.
Facts sky_view_facts(const SkyViewBake& bake) {
    std::vector<double> elevations;
    for (const config::Angle& elevation : bake.sun_elevations) {
        elevations.push_back(elevation.radians * kDegreesPerRadian);
    }
    return {{"sun_elevations_deg", to_digits(std::move(elevations), 9)},
            {"camera_altitude_km", to_digits(bake.altitude.kilometers(), 9)}};
}

void describe_axes(const SkyViewBake& bake, const SkyViewCamera& camera, const Shell& shell,
                   Baked& table) {
    table.axes[0].constants = {{"range_deg", 180.0}};
    table.axes[1].constants = shell_constants(shell);
    const Facts numbers = {{"dip_deg", camera.dip() * kDegreesPerRadian},
                           {"range_below_deg", camera.range_below() * kDegreesPerRadian},
                           {"range_above_deg", camera.range_above() * kDegreesPerRadian},
                           {"tables", static_cast<double>(bake.sun_elevations.size())}};
    for (const Facts& more : {numbers, sky_view_facts(bake)}) {
        table.axes[1].constants.insert(table.axes[1].constants.end(), more.begin(), more.end());
    }
}

void describe(const SkyViewBake& bake, const SkyViewCamera& camera, const Shell& shell,
              Baked& table) {
    const std::size_t suns = bake.sun_elevations.size();
    table.kind = "sky_view";
    const bool from_strips =
        bake.sky == config::SkyMethod::strips && bake.orders != config::SkyOrders::single;
    table.content = fmt::format(
        "radiance of the sky and, below the horizon, of the ground (1/sr) for a solar irradiance "
        "of 1, without the sun's disc: {}{}",
        light_text(bake.orders, bake.layers),
        from_strips
            ? "; of the orders from the second on the second alone, lit by eight strips of sky"
            : "");
    table.mapping = "hillaire";
    table.axes.resize(2);
    table.axes[0] = {"azimuth_deg", "x = azimuth from the sun / 180 degrees",
                     "end points on texel centres", 0, 180};
    const std::string stacked = suns == 1 ? ""
                                          : fmt::format(
                                                "; {} tables one below the other, sun k from 0 on "
                                                "at v = (k + v of its table) / {}",
                                                suns, suns);
    table.axes[1] = {
        "above_horizon_deg",
        fmt::format(
            "y = 1/2 + 1/2 sign(l) sqrt(|l| / range), l the angle above the horizon, which is "
            "{:.9g} degrees below the horizontal, range {:.9g} degrees below and {:.9g} above it{}",
            camera.dip() * kDegreesPerRadian, camera.range_below() * kDegreesPerRadian,
            camera.range_above() * kDegreesPerRadian, stacked),
        "end points on texel centres", -camera.range_below() * kDegreesPerRadian,
        camera.range_above() * kDegreesPerRadian};
    set_files(bake, table);
    describe_sky_table(table);
    describe_axes(bake, camera, shell, table);
    const Facts facts = sky_view_facts(bake);
    table.details.insert(table.details.end(), facts.begin(), facts.end());
}

}  // namespace

void write_wanted(const SkyLight& light, SeenGround ground, std::vector<SkyRadiance> radiances,
                  double* values) {
    for (SkyRadiance& radiance : radiances) {
        if (ground == SeenGround::black) radiance.ground = {};
        const Spectrum wanted = light.wanted(radiance);
        values = std::copy_n(data(wanted), light.medium().air.channels, values);
    }
}

TableModel sky_view_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground) {
    TableModel model;
    model.channels = light.medium().air.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    model.v_of = sky_view_v;
    model.probe_place = [&camera](double x, double y) {
        return std::array<double, 2>{x, camera.off_the_edges(y)};
    };
    model.cost_per_texel = {1};
    model.row = [&light, &camera, sun, ground](int, double y, const std::vector<double>& x,
                                               double* values) {
        std::vector<double> cosines;
        for (const double azimuth : x) cosines.push_back(cosine_of_pi(azimuth));
        const auto row_of = [&](const SkyLight& any) {
            const SkyRow row(any.integrator(), any.medium(), any.higher_orders(),
                             camera.ray(y, sun, 1), &any.sunlight());
            return row.radiance([&](double cosine) { return camera.ray(y, sun, cosine); }, cosines);
        };
        write_wanted(light, ground, with_once(light, row_of), values);
    };
    model.reference = [&light, &camera, sun, ground](double y, const std::vector<double>& x,
                                                     double* values) {
        const auto rays_of = [&](const SkyLight& any) {
            std::vector<SkyRadiance> radiances;
            for (const double azimuth : x) {
                const SkyRay ray = camera.ray(y, sun, cosine_of_pi(azimuth));
                radiances.push_back(any.integrator().radiance(ray));
            }
            return radiances;
        };
        write_wanted(light, ground, with_once(light, rays_of), values);
    };
    model.error = relative_error;
    return model;
}

Outcome<Baked> bake_sky_view(const SkyLights& lights, const SkyViewBake& bake,
                             const BakeOptions& options, Baked table) {
    const Shell& shell = lights.first().shell();
    const SkyViewCamera camera(shell, bake.altitude.kilometers());
    describe(bake, camera, shell, table);
    const AccuracyRequest request = sky_table_request(bake.size);
    StackedParts parts;
    for (const config::Angle& elevation : bake.sun_elevations) {
        const auto place_of = [&camera, elevation](double x, double y) {
            return Place{{"azimuth_deg", 180 * x},
                         {"above_horizon_deg", camera.angle_at(y) * kDegreesPerRadian},
                         {"sun_elevation_deg", elevation.radians * kDegreesPerRadian}};
        };
        const SunZenith sun = sun_at_elevation(elevation.radians);
        const TableModel model =
            lights.model([&](const SkyLight& light) { return sky_view_model(light, camera, sun); });
        if (!add_part(make_part(model, request, options, place_of, table), parts)) break;
    }
    return stack_tables(std::move(parts), options);
}

}  // namespace skybake
