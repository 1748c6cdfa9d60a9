// The asset weather_map: a plane of noise as amounts of clouds, or as directions.
#pragma once

#include "bakers/math/bake_options.h"
#include "config/assets/weather_map.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/noise.h"

namespace skybake {

struct Baked;

// Returns `table`, which comes with name and parameters, with its texels and all else that the map's
// files state, except levels of detail and what finish_volume adds. Returns E0411 if a share cannot
// be reached, and neither value nor diagnostics after an interruption.
Outcome<Baked> make_weather_map(const Noise& noise, const config::WeatherMapBake& bake,
                                const BakeOptions& options, Baked table);

// Bakes the same, surveyed and certified. Returns E0411 if a share cannot be reached,
// and neither value nor diagnostics after an interruption.
Outcome<Baked> bake_weather_map(const Noise& noise, const config::WeatherMapBake& bake,
                                const BakeOptions& options, Baked table);

// The place of the samples within their texels, as a part of the tile that is added to coordinates
// along each axis: 0, or half a texel if samples lie at the texels' corners.
std::array<double, 2> weather_map_shift(const Noise& noise, const config::WeatherMapBake& bake);

}  // namespace skybake
