// The baker of asset = "weather_map".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bakers/assets/registry/baker.h"
#include "bakers/assets/weather_map/weather_map_table.h"
#include "bakers/field/baked.h"
#include "config/assets/weather_map.h"
#include "config/sections/parameters.h"

namespace skybake {

using config::WeatherMapBake;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const WeatherMapBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_weather_map(noise_named(parameters, asset.noise), asset, options,
                            labelled_volume(std::move(label)));
}

// A streak of `length` tiles has about so many steps of half a texel.
double steps_of(const WeatherMapBake& asset) {
    double steps = 0;
    for (const double length : asset.streaks) {
        steps += 16 * length * std::max(asset.size[0], asset.size[1]);
    }
    return steps;
}

Estimate estimate(const Parameters& parameters, const WeatherMapBake& asset) {
    const Noise& noise = noise_named(parameters, asset.noise);
    constexpr double kSecondsPerStep = 2e-9;
    constexpr double kSecondsToSort = 1e-7;
    return estimate_texels(
        asset, asset.size, noise.channels.size(),
        octaves_of(noise) * kSecondsPerOctave + kSecondsToSort + steps_of(asset) * kSecondsPerStep,
        0.3);
}

AssetPlaces places(const Parameters& parameters, const WeatherMapBake& asset, const StoredTexels&) {
    const std::array<double, 2> shift =
        weather_map_shift(noise_named(parameters, asset.noise), asset);
    return single_lookup({"x_tile", "y_tile"}, [shift](const Place& at) {
        return Uvw{at[0].second + shift[0], at[1].second + shift[1], 0.5};
    });
}

AssetLookup lookup(const Parameters& parameters, const WeatherMapBake& asset,
                   const StoredTexels& stored) {
    const std::array<double, 2> shift =
        weather_map_shift(noise_named(parameters, asset.noise), asset);
    GlslFunction function;
    function.comment =
        asset.content == config::WeatherContent::amounts
            ? "Returns the map's channels. p is a point in the plane and `tile` the edges of a "
              "tile, in one unit."
            : "Returns (1 + vector) / 2 of a unit vector; weather_map_direction takes it back. p "
              "is a point in the plane and `tile` the edges of a tile, in one unit.";
    function.arguments = "sampler2D table, vec2 p, vec2 tile";
    const std::string place =
        shift == std::array<double, 2>{}
            ? "p"
            : fmt::format("p + tile * vec2({}, {})", glsl_number(shift[0]), glsl_number(shift[1]));
    function.value = fmt::format("weather_map(table, {}, tile)", place);
    return {"weather_map", {with_channels(stored.channels, 4, std::move(function))}};
}

void draft(WeatherMapBake& asset, int most_texels) {
    for (int& edge : asset.size) edge = std::min(edge, most_texels);
    asset.mips = 1;
}

}  // namespace

Baker<WeatherMapBake> baker(BakerTag<WeatherMapBake>) {
    return {.version = 6,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft};
}

}  // namespace skybake
