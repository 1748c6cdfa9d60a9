#include "bakers/assets/environment/environment_model.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "bakers/assets/environment/environment_sky.h"
#include "bakers/math/relative_error.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentBake;
using config::EnvironmentMapping;

namespace {

// The angle above the horizon, in radians, at a coordinate y, and back.
double above_horizon(const SkyViewCamera& camera, double y) {
    return 180 * (0.5 - y) / kDegreesPerRadian + camera.dip();
}
double coordinate_of(const SkyViewCamera& camera, double above_horizon) {
    return 0.5 - (above_horizon - camera.dip()) * kDegreesPerRadian / 180;
}

// The model of sky_view, whose rows may have any angle above the horizon and any azimuth.
using SkyRowFunction = std::function<void(double y, const std::vector<double>& x, double* values)>;

// A row of a map by longitude and latitude. The sun is at `sun_half_turns` from the middle.
struct EnvironmentRow {
    const SkyViewCamera& camera;
    int channels;
    double sun_half_turns;

    void fill(double y, const std::vector<double>& x, double* values,
              const SkyRowFunction& sky_row) const {
        const double angle = above_horizon(camera, y);
        if (!sees_air(camera, angle)) {
            std::fill_n(values, x.size() * static_cast<std::size_t>(channels), 0.0);
            return;
        }
        std::vector<double> azimuths;  // in half turns from the sun, to either side
        for (const double coordinate : x) {
            azimuths.push_back(turn_from_sun(2 * coordinate - 1 - sun_half_turns));
        }
        sky_row(camera.coordinate(angle), azimuths, values);
    }
};

// Light in directions of a part. `light` writes one texel.
using LightOfPlace = std::function<void(double x, double y, double* values)>;

void fill_places(const std::vector<double>& x, double y, int channels, double* values,
                 const LightOfPlace& light) {
    for (const double coordinate : x) {
        light(coordinate, y, values);
        values += channels;
    }
}

// Probes stay away from the edges of a part, beyond which coarse levels blend other texels than
// those of a runtime's neighbouring part.
std::array<double, 2> off_the_edges_of_part(double x, double y, double margin) {
    return {std::clamp(x, margin, 1 - margin), std::clamp(y, margin, 1 - margin)};
}

TableModel empty_model(int channels, double lowest) {
    TableModel model;
    model.channels = channels;
    model.convention = TexelConvention::end_points_on_edges;
    model.cost_per_texel = {1};
    model.lowest = lowest;
    model.highest = std::numeric_limits<double>::max();
    model.error = relative_error;
    return model;
}

bool any_is_sunlit(const SkyLights& lights, std::span<const CloudMedium> media,
                   const SunZenith& sun) {
    bool lit = false;
    lights.for_each_packet([&](const SkyLight& light) {
        for (const CloudMedium& medium : media) {
            lit = lit || CloudySky::is_sunlit(light, medium, sun);
        }
    });
    return lit;
}

}  // namespace

TableModel environment_model(const SkyLight& light, const SkyViewCamera& camera,
                             const SunZenith& sun, double sun_azimuth) {
    TableModel model = wide_sky_model(light, camera, sun);
    model.convention = TexelConvention::end_points_on_edges;
    model.v_of = nullptr;
    const EnvironmentRow place{camera, model.channels, sun_azimuth / std::numbers::pi};
    model.probe_place = [&camera](double x, double y) {
        const double angle = above_horizon(camera, y);
        if (!sees_air(camera, angle)) return std::array<double, 2>{x, y};
        const double off = camera.angle_at(camera.off_the_edges(camera.coordinate(angle)));
        return std::array<double, 2>{x, coordinate_of(camera, off)};
    };
    model.row = [place, sky = model.row](int level, double y, const std::vector<double>& x,
                                         double* values) {
        place.fill(y, x, values,
                   [&](double of_view, const std::vector<double>& azimuths, double* row) {
                       sky(level, of_view, azimuths, row);
                   });
    };
    model.reference = [place, sky = model.reference](double y, const std::vector<double>& x,
                                                     double* values) {
        place.fill(y, x, values, sky);
    };
    return model;
}

EnvironmentModels::EnvironmentModels(const SkyLights& lights, const EnvironmentBake& bake,
                                     std::span<const CloudMedium> media, const BakeOptions& options)
    : lights_(lights),
      bake_(bake),
      layout_(bake.mapping, bake.size),
      camera_(lights.first().shell(), bake.altitude.kilometers()),
      sun_(sun_at_elevation(bake.sun_elevation.radians)),
      sky_(lights.model(
          [this](const SkyLight& light) { return wide_sky_model(light, camera_, sun_); })) {
    if (!media.empty()) {
        clouds_.emplace(media, bake, layout_, any_is_sunlit(lights, media, sun_), options);
        lights.for_each_packet([&](const SkyLight& light) {
            if (options.cancelled()) return;
            cloudy_[&light] =
                std::make_unique<CloudySky>(light, camera_, bake.altitude.kilometers(), sun_,
                                            bake.sun_azimuth.radians, *clouds_, options);
        });
    } else if (bake.mapping != EnvironmentMapping::longitude_latitude) {
        around_.emplace(sky_, camera_, options);
    }
}

TableModel EnvironmentModels::clear_rows() const {
    return lights_.model([this](const SkyLight& light) {
        return environment_model(light, camera_, sun_, bake_.sun_azimuth.radians);
    });
}

TableModel EnvironmentModels::clear_part(int part) const {
    TableModel model = empty_model(sky_.channels, sky_.lowest);
    const double sun = bake_.sun_azimuth.radians;
    model.row = [this, part, sun, channels = model.channels](
                    int, double y, const std::vector<double>& x, double* values) {
        fill_places(x, y, channels, values, [&](double at_x, double at_y, double* texel) {
            const MapAngles angles = angles_of(layout_.direction(part, at_x, at_y));
            around_->at(angles.elevation, (angles.azimuth - sun) / std::numbers::pi, texel);
        });
    };
    model.reference = [this, part, sun, channels = model.channels](
                          double y, const std::vector<double>& x, double* values) {
        fill_places(x, y, channels, values, [&](double at_x, double at_y, double* texel) {
            const MapAngles angles = angles_of(layout_.direction(part, at_x, at_y));
            const double angle = angles.elevation + camera_.dip();
            std::fill_n(texel, channels, 0.0);
            if (!sees_air(camera_, angle)) return;
            const double turn = turn_from_sun((angles.azimuth - sun) / std::numbers::pi);
            sky_.reference(camera_.coordinate(angle), {turn}, texel);
        });
    };
    return model;
}

TableModel EnvironmentModels::cloudy_packet(const SkyLight& light, int part) const {
    const CloudySky& sky = *cloudy_.at(&light);
    const int channels = light.medium().air.channels;
    TableModel model = empty_model(channels, 0);
    model.row = [this, part, &sky, channels](int, double y, const std::vector<double>& x,
                                             double* values) {
        const auto size = layout_.part_size();  // Clang captures no structured bindings
        const int columns = size[0];
        const int rows = size[1];
        const int row = std::min(static_cast<int>(y * rows), rows - 1);
        fill_places(x, y, channels, values, [&](double at_x, double at_y, double* texel) {
            const int column = std::min(static_cast<int>(at_x * columns), columns - 1);
            const Spectrum found = sky.radiance(layout_.direction(part, at_x, at_y),
                                                clouds_->texel(part, column, row), false);
            std::copy_n(data(found), channels, texel);
        });
    };
    model.reference = [this, part, &sky, channels](double y, const std::vector<double>& x,
                                                   double* values) {
        fill_places(x, y, channels, values, [&](double at_x, double at_y, double* texel) {
            const Spectrum found = sky.radiance(layout_.direction(part, at_x, at_y),
                                                clouds_->around(part, at_x, at_y), true);
            std::copy_n(data(found), channels, texel);
        });
    };
    return model;
}

TableModel EnvironmentModels::cloudy_part(int part) const {
    return lights_.model(
        [this, part](const SkyLight& light) { return cloudy_packet(light, part); });
}

TableModel EnvironmentModels::of_part(int part) const {
    if (!clouds_ && !around_) return clear_rows();
    TableModel model = clouds_ ? cloudy_part(part) : clear_part(part);
    if (layout_.mapping() != EnvironmentMapping::longitude_latitude) {
        const int coarsest = std::max(layout_.part_size()[0] >> (bake_.mips - 1), 1);
        model.probe_place = [margin = 0.5 / coarsest](double x, double y) {
            return off_the_edges_of_part(x, y, margin);
        };
    }
    return model;
}

}  // namespace skybake
