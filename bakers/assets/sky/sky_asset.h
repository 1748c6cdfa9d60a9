// The parts that assets of a sky's light share: how the light is checked before use, and what their
// tables state.
//
// Whether light of all orders in an asset's air can be made in reasonable time and memory.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/intermediates.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"
#include "config/sections/scene.h"

namespace skybake {

// Returns make(), which makes an asset of the lights. If the bake was interrupted while they were solved for,
// returns nothing; if a solution is invalid, returns E0405 for the asset of that name.
template <class Make>
Outcome<Baked> bake_of_light(const SkyLights& lights, const std::string& name,
                             const BakeOptions& options, const Make& make) {
    if (options.cancelled()) return {};
    if (const auto problem = lights.problem(name)) return *problem;
    return make();
}

// Returns the solved light of these packets of wavelengths, which an asset needs unless it shows light
// that was scattered once, and the table of sunlight if it integrates rows of rays (sky_row.h).
std::vector<Need> light_needs(const std::vector<config::Atmosphere>& packets,
                              config::SkyOrders orders, bool reads_sunlight);

// For a table of radiance around a camera (1/sr): the number of points that certify it, and its
// conventions, reference and scale of errors. The table already has its channels' names.
AccuracyRequest sky_table_request(const std::array<int, 2>& size);
void describe_sky_table(Baked& table);

// Describes a table over the sun's cosine, mapped so, and the altitude, whose formula is given, with
// relative errors. The table already has its channels' names.
void describe_sun_table(config::MultipleScatteringMapping mapping, std::string altitude_formula,
                        const Shell& shell, Baked& table);

// Returns E0405 if the asset is made of light of all orders, which would take many minutes: the air
// scatters light very often on its way up, or it is very high above a small planet. The numbers of
// altitudes, of directions and of places along them grow with both.
std::optional<Diagnostic> check_solvable(const config::Atmosphere& atmosphere, const Bake& bake);

}  // namespace skybake
