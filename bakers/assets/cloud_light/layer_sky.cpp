#include "bakers/assets/cloud_light/layer_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <utility>

#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/environment/environment_sky.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/color/color_space.h"
#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/parallel.h"
#include "config/text/mapped.h"

namespace skybake::cloud_light {
namespace {

bool has_sky(const CloudLightBake& bake) {
    return bake.contents == CloudLightContents::clear_sky_radiance;
}

// The weight of each wavelength in luminance: that of the recipe's colours, or of spectra that are
// linear between the wavelengths if it has none. They are empty after an interruption.
std::vector<double> luminance_weights(const Parameters& parameters, const BakeOptions& options) {
    config::Color color = parameters.color.value_or(config::Color{});
    if (color.space == config::ColorSpace::none) color.space = config::ColorSpace::linear_srgb;
    const auto fitted = colors_of(parameters, options);
    if (!fitted && options.cancelled()) return {};
    const std::vector<glm::dvec3> weights =
        fitted ? fitted->weights : linear_color_weights(parameters.wavelengths, color);
    return mapped<double>(
        weights, [&](const glm::dvec3& weight) { return (to_xyz(color.space) * weight).y; });
}

// The light of all packets of wavelengths as a camera sees it.
class LuminousSky {
  public:
    LuminousSky(const Parameters& parameters, double altitude_km, double sun_elevation,
                const BakeOptions& options)
        : weights_(luminance_weights(parameters, options)), sun_(sun_at_elevation(sun_elevation)) {
        for (const config::Atmosphere& packet : packets_of(parameters.atmosphere)) {
            if (options.cancelled()) return;
            lights_.push_back(std::make_unique<SkyLight>(packet, config::SkyOrders::all,
                                                         std::vector<std::string>{}, options));
        }
        camera_.emplace(lights_.front()->shell(), altitude_km);
    }

    std::optional<Diagnostic> problem(const std::string& name) const {
        for (const auto& light : lights_) {
            if (auto found = light->problem(name)) return found;
        }
        return std::nullopt;
    }

    const SkyViewCamera& camera() const { return *camera_; }

    // The luminance by the coordinates of sky_view. This object must outlive it.
    TableModel model() const {
        std::vector<TableModel> packets;
        for (const auto& light : lights_) packets.push_back(wide_sky_model(*light, *camera_, sun_));
        TableModel model = packets.front();
        model.channels = 1;
        model.row = [this, packets](int level, double y, const std::vector<double>& x,
                                    double* values) {
            std::fill_n(values, x.size(), 0.0);
            std::vector<double> light;
            const double* weight = weights_.data();
            for (const TableModel& packet : packets) {
                const auto channels = static_cast<std::size_t>(packet.channels);
                light.resize(x.size() * channels);
                packet.row(level, y, x, light.data());
                for (std::size_t i = 0; i < light.size(); ++i) {
                    values[i / channels] += weight[i % channels] * light[i];
                }
                weight += channels;
            }
        };
        return model;
    }

  private:
    std::vector<double> weights_;
    SunZenith sun_;
    std::vector<std::unique_ptr<const SkyLight>> lights_;
    std::optional<SkyViewCamera> camera_;
};

// The luminance at directions that are 0.5 degrees apart, linear between them: for the reference, which
// does not share the interpolation of SkyAround.
class SampledSky {
  public:
    SampledSky(const TableModel& sky, const SkyViewCamera& camera, const BakeOptions& options)
        : values_(kAzimuths, kElevations, 1) {
        std::vector<double> azimuths;
        for (int i = 0; i < kAzimuths; ++i) {
            azimuths.push_back(static_cast<double>(i) / (kAzimuths - 1));
        }
        for_each_tile(kElevations, options, "the sky above the layer", [&](int row) {
            const double elevation = 0.5 * std::numbers::pi * row / (kElevations - 1);
            const double angle = elevation + camera.dip();
            if (!sees_air(camera, angle)) return;
            sky.row(0, camera.off_the_edges(camera.coordinate(angle)), azimuths,
                    values_.texel(0, row));
        });
    }

    double at(double elevation, double half_turns) const {
        const double x = turn_from_sun(half_turns) * (kAzimuths - 1);
        const double y = elevation / (0.5 * std::numbers::pi) * (kElevations - 1);
        const int column = std::clamp(static_cast<int>(x), 0, kAzimuths - 2);
        const int row = std::clamp(static_cast<int>(y), 0, kElevations - 2);
        const auto along = [&](int j) {
            const double left = *values_.texel(column, j);
            return left + (x - column) * (*values_.texel(column + 1, j) - left);
        };
        return along(row) + (y - row) * (along(row + 1) - along(row));
    }

    // Returns the mean over the hemisphere, of rings of the same solid angle.
    double mean() const {
        constexpr int kRings = 1024;
        constexpr int kAround = 720;
        double sum = 0;
        for (int i = 0; i < kRings; ++i) {
            const double up = (i + 0.5) / kRings;
            const double elevation = angle_of(up, std::sqrt(1 - up * up));
            for (int k = 0; k < kAround; ++k) sum += at(elevation, (k + 0.5) / kAround);
        }
        return sum / (kRings * kAround);
    }

  private:
    static constexpr int kAzimuths = 361;
    static constexpr int kElevations = 181;
    Image2<double> values_;
};

// Turns a function of the elevation and of the azimuth from the sun, in half turns, into one of
// directions, with its values over `mean`.
template <class Sky>
SkyByDirection by_direction(std::shared_ptr<const Sky> sky, const glm::dvec3& sun, double mean) {
    return [sky = std::move(sky), azimuth = angle_of(sun.y, sun.x),
            mean](const glm::dvec3& direction) {
        const MapAngles angles = angles_of({direction.y, direction.z, direction.x});
        return sky->at(angles.elevation, (angles.azimuth - azimuth) / std::numbers::pi) / mean;
    };
}

// SkyAround with the camera that it refers to.
struct SkyOfCamera {
    SkyViewCamera camera;
    SkyAround around;

    SkyOfCamera(const TableModel& sky, const SkyViewCamera& of, const BakeOptions& options)
        : camera(of), around(sky, camera, options) {}
    double at(double elevation, double half_turns) const {
        double value = 0;
        around.at(elevation, half_turns, &value);
        return value;
    }
};

Diagnostic black_sky(const std::string& name, double altitude_km) {
    return diagnosis(
        "E0189",
        fmt::format("`{}`: the sky is black at the top of the layer, {:.6g} km above the ground",
                    name, altitude_km),
        "give the atmosphere layers that scatter light above the cloud");
}

}  // namespace

std::vector<Need> sky_needs(const Parameters& parameters, const CloudLightBake& bake) {
    if (!has_sky(bake)) return {};
    std::vector<Need> needs = color_needs(parameters);
    std::ranges::move(light_needs(packets_of(parameters.atmosphere), config::SkyOrders::all, true),
                      std::back_inserter(needs));
    return needs;
}

std::optional<Diagnostic> add_sky(const Parameters& parameters, const CloudLightBake& bake,
                                  const Cloud& cloud, const std::string& name,
                                  const BakeOptions& options, CloudLayer& layer) {
    if (!has_sky(bake)) return std::nullopt;
    const double altitude_km = cloud.base_altitude.kilometers() + cloud.extent[2].kilometers();
    const LuminousSky sky(parameters, altitude_km, bake.sun_elevations.front().radians, options);
    if (options.cancelled()) return std::nullopt;
    if (auto problem = sky.problem(name)) return problem;
    const TableModel model = sky.model();
    const auto fine = std::make_shared<const SkyOfCamera>(model, sky.camera(), options);
    const auto sampled = std::make_shared<const SampledSky>(model, sky.camera(), options);
    if (options.cancelled()) return std::nullopt;
    const glm::dvec3 sun = sun_directions(bake).front();
    const double mean = mean_radiance(by_direction(fine, sun, 1));
    if (!(mean > 0)) return black_sky(name, altitude_km);
    layer.sky = {by_direction(fine, sun, mean), by_direction(sampled, sun, sampled->mean())};
    return std::nullopt;
}

}  // namespace skybake::cloud_light
