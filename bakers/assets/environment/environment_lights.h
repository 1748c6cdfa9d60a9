// The lights of an environment in numbers: NAME.json, and facts of its manifest.
//
// Values are in the channels of the map and for a solar irradiance of 1. Where these are colours of
// the measured sunlight, illuminance is told in lux too: 1 in all channels outside the air is 133.1e3
// lux, the solar illuminance at the mean distance of the Earth (spectral_color.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/environment/sphere_harmonics.h"
#include "bakers/field/conventions.h"
#include "config/assets/environment.h"

namespace skybake {

struct Baked;

struct EnvironmentLights {
    std::vector<double> sun_facing;  // irradiance of a surface that faces the sun, by its disc
    std::vector<double> sun_level;   // of a level surface
    std::vector<double> sky_level;  // of a level surface by the upper half of the map, without disc
    std::vector<std::array<double, kHarmonics>> harmonics;  // of the map without the disc
};

// Returns the lux of light in channels that are colours; nothing if they are not, or if the sunlight
// is not the measured one.
std::optional<double> lux_of(const ColorConvention& color, const std::vector<double>& channels);

// The text of NAME.json.
std::string lights_json(const EnvironmentLights& lights, const config::EnvironmentBake& bake,
                        const Baked& table);

// Adds the lights to the facts that the manifest states. `sun_direction`, (right, up, ahead), is
// there where a lamp of `sun_irradiance` takes the place of the disc, which the map lacks.
void add_light_facts(const EnvironmentLights& lights, const config::EnvironmentBake& bake,
                     Baked& table);

}  // namespace skybake
