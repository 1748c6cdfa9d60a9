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

// Probes stay away from the edges of a part, beyond which coarse levels blend other texels than
// those of a runtime's neighbouring part.
std::array<double, 2> off_the_edges_of_part(double x, double y, double margin) {
    return {std::clamp(x, margin, 1 - margin), std::clamp(y, margin, 1 - margin)};
}

// Light at a place of a part; `values` are one texel.
using LightOfPlace = std::function<void(double x, double y, double* values)>;

// Returns a model that is made place by place.
TableModel model_of_places(int channels, double lowest, const LightOfPlace& light,
                           const LightOfPlace& exact) {
    TableModel model;
    model.channels = channels;
    model.convention = TexelConvention::end_points_on_edges;
    model.cost_per_texel = {1};
    model.lowest = lowest;
    model.highest = std::numeric_limits<double>::max();
    model.error = relative_error;
    const auto row_of = [channels](const LightOfPlace& any) {
        return [channels, any](double y, const std::vector<double>& x, double* values) {
            for (const double coordinate : x) {
                any(coordinate, y, values);
                values += channels;
            }
        };
    };
    model.row = [row = row_of(light)](int, double y, const std::vector<double>& x, double* values) {
        row(y, x, values);
    };
    model.reference = row_of(exact);
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
    const double sun = bake_.sun_azimuth.radians;
    const auto light = [this, part, sun](double x, double y, double* texel) {
        const MapAngles angles = angles_of(layout_.direction(part, x, y));
        around_->at(angles.elevation, (angles.azimuth - sun) / std::numbers::pi, texel);
    };
    const auto exact = [this, part, sun](double x, double y, double* texel) {
        const MapAngles angles = angles_of(layout_.direction(part, x, y));
        const double angle = angles.elevation + camera_.dip();
        std::fill_n(texel, sky_.channels, 0.0);
        if (!sees_air(camera_, angle)) return;
        const double turn = turn_from_sun((angles.azimuth - sun) / std::numbers::pi);
        sky_.reference(camera_.coordinate(angle), {turn}, texel);
    };
    return model_of_places(sky_.channels, sky_.lowest, light, exact);
}

TableModel EnvironmentModels::cloudy_packet(const SkyLight& light, int part) const {
    const CloudySky& sky = *cloudy_.at(&light);
    const int channels = light.medium().air.channels;
    const auto light_of = [this, part, &sky, channels](double x, double y, double* texel) {
        const auto size = layout_.part_size();
        const int column = std::min(static_cast<int>(x * size.columns), size.columns - 1);
        const int row = std::min(static_cast<int>(y * size.rows), size.rows - 1);
        const Spectrum found =
            sky.radiance(layout_.direction(part, x, y), clouds_->texel(part, column, row), false);
        std::copy_n(data(found), channels, texel);
    };
    const auto exact = [this, part, &sky, channels](double x, double y, double* texel) {
        const Spectrum found =
            sky.radiance(layout_.direction(part, x, y), clouds_->around(part, x, y), true);
        std::copy_n(data(found), channels, texel);
    };
    return model_of_places(channels, 0, light_of, exact);
}

TableModel EnvironmentModels::cloudy_part(int part) const {
    return lights_.model(
        [this, part](const SkyLight& light) { return cloudy_packet(light, part); });
}

TableModel EnvironmentModels::of_part(int part) const {
    if (!clouds_ && !around_) return clear_rows();
    TableModel model = clouds_ ? cloudy_part(part) : clear_part(part);
    if (layout_.mapping() != EnvironmentMapping::longitude_latitude) {
        const int coarsest = std::max(layout_.part_size().columns >> (bake_.mips - 1), 1);
        model.probe_place = [margin = 0.5 / coarsest](double x, double y) {
            return off_the_edges_of_part(x, y, margin);
        };
    }
    return model;
}

}  // namespace skybake
