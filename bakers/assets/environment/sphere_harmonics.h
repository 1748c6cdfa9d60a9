// Real spherical harmonics to degree 4 of light around a point.
//
//   L(w) = sum over l, m of c_lm Y_lm(w),   c_lm = integral of L Y_lm over the sphere
//
// The harmonics are orthonormal, without the Condon-Shortley phase, as in Sloan 2008, "Stupid
// Spherical Harmonics Tricks", appendix A2, of (x, y, z) = (right, ahead, up): m counts azimuths
// from right to ahead. They stand in the order l (l + 1) + m.
//
// The lights of an environment in numbers: NAME.json, and facts of its manifest.
//
// Values are in the channels of the map and for a solar irradiance of 1. Where these are colours of
// the measured sunlight, illuminance is told in lux too: 1 in all channels outside the air is 133.1e3
// lux, the solar illuminance at the mean distance of the Earth (spectral_color.h).
#pragma once

#include <glm/ext/vector_double3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/field/conventions.h"
#include "bakers/field/image.h"
#include "config/assets/environment.h"

namespace skybake {

inline constexpr int kHarmonicDegree = 4;
inline constexpr std::size_t kHarmonics = 25;

// Returns all Y_lm at a direction (right, up, ahead).
std::array<double, kHarmonics> harmonics_at(const glm::dvec3& direction);

// Returns the coefficients of each channel of a map: [channel][l (l + 1) + m]. Each texel counts with
// its solid angle, as if all its light came from its middle.
std::vector<std::array<double, kHarmonics>> harmonics_of(const Image2<float>& map,
                                                         const EnvironmentLayout& layout);

// Returns the irradiance of a level surface, facing up, by the texels of the upper half: one value
// for each channel.
std::vector<double> level_irradiance(const Image2<float>& map, const EnvironmentLayout& layout);

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
