// Shared by the tests of the sky: atmospheres, random ones among them, and light scattered before.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/sections/layer.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {

constexpr double kDegree = std::numbers::pi / 180;

inline double uniform(double from, double to) {
    return from + (to - from) * *rc::gen::inRange(0, 1 << 30) / static_cast<double>(1 << 30);
}

inline double log_uniform(double from, double to) {
    return std::exp(uniform(std::log(from), std::log(to)));
}

// A planet from 50 km to 1e5 km with one to `most` layers, which `fill(thickness, layer)` fills in.
template <class FillLayer>
config::Atmosphere random_planet(int most, const FillLayer& fill) {
    const double radius = log_uniform(5e4, 1e8);
    const double thickness = radius * log_uniform(1e-3, 0.3);
    config::Atmosphere atmosphere;
    atmosphere.ground_radius = {radius};
    atmosphere.top_radius = {radius + thickness};
    atmosphere.ground_albedo = {uniform(0, 1), uniform(0, 1), uniform(0, 1)};
    const int layers = *rc::gen::inRange(1, most + 1);
    for (int i = 0; i < layers; ++i) {
        config::Layer layer;
        layer.name = std::string(1, static_cast<char>('a' + i));
        layer.center_altitude = {thickness * uniform(0.1, 0.6)};
        fill(thickness, layer);
        atmosphere.layers.push_back(layer);
    }
    return atmosphere;
}

// One to three layers of any phase function and profile, zenith optical depths from 1e-3 to 10.
inline config::Atmosphere random_atmosphere() {
    return random_planet(3, [](double thickness, config::Layer& layer) {
        const bool is_tent = *rc::gen::inRange(0, 3) == 0;
        layer.profile = is_tent ? config::Profile::tent : config::Profile::exponential;
        layer.scale_height = {thickness * log_uniform(0.02, 1)};
        layer.half_width = {thickness * uniform(0.05, 0.4)};
        layer.phase = static_cast<config::Phase>(*rc::gen::inRange(0, 4));
        layer.g = uniform(-0.8, 0.9);
        const double column = is_tent ? layer.half_width.meters : layer.scale_height.meters;
        for (int c = 0; c < 3; ++c) {
            const double extinction = log_uniform(1e-3, 10) / column;
            layer.extinction.push_back({extinction});
            layer.scattering.push_back({extinction * uniform(0, 1)});
        }
    });
}

// Earth with drops, half of whose light goes into their peak.
inline config::Recipe earth_with_drops(const std::string& more = "",
                                       const std::string& number_density = "0.5 /cm3",
                                       const std::string& kind = "fog") {
    return recipe_of("preset = 'earth_hillaire'\n[particles.drops]\npreset = '" + kind +
                     "'\n[atmosphere.layers.fog]\nprofile = 'exponential'\n"
                     "scale_height = '1 km'\nphase = { mie = 'drops' }\nnumber_density = '" +
                     number_density + "'\n" + more);
}

// Haze over black ground, and no air.
inline SkyMedium haze_alone(const std::string& keys) {
    return make_sky_medium(
        recipe_of("[atmosphere]\nground_radius = '6360 km'\ntop_radius = '6460 km'\n"
                  "ground_albedo = 0\n[atmosphere.layers.haze]\nprofile = 'exponential'\n"
                  "scale_height = '1 km'\nphase = 'henyey_greenstein'\n" +
                  keys)
            .parameters.atmosphere);
}

// The light of an atmosphere with higher orders that are smooth and cost nothing.
class TestSky {
  public:
    TestSky(const config::Atmosphere& atmosphere, config::SkyOrders orders,
            const std::vector<std::string>& layers = {})
        : full_(make_sky_medium(atmosphere)),
          light_(scattering_only(make_sky_medium(atmosphere), layers), orders,
                 std::make_unique<IsotropicOrders>(
                     full_.air, [](double altitude_km, double sun_cos_zenith) {
                         const double psi =
                             0.02 * std::exp(3 * sun_cos_zenith) / (1 + 0.05 * altitude_km);
                         return Spectrum{psi, 1.5 * psi, 2 * psi, 0};
                     })) {}

    const SkyLight& light() const { return light_; }

  private:
    SkyMedium full_;
    SkyLight light_;
};

inline const TestSky& earth() {
    static const TestSky sky(preset_atmosphere("earth_hillaire"), config::SkyOrders::all);
    return sky;
}

}  // namespace skybake::test
