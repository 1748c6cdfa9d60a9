// The parts that assets of a sky's light share: how the light is checked before use, and what their
// tables state.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/intermediates.h"

namespace skybake {

// Returns make(light), of a SkyLight or of SkyLights. If the bake was interrupted while the light was solved for, returns nothing;
// if the solution is invalid, returns E0405 for the asset of that name.
template <class Light, class Make>
config::Outcome<Baked> bake_of_light(const Light& light, const std::string& name,
                                     const BakeOptions& options, const Make& make) {
    if (options.cancelled()) return {};
    if (const auto problem = light.problem(name)) return {{}, {*problem}};
    return make(light);
}

// Return the solved light of an asset, of all packets of wavelengths or of one, which it needs unless it shows light that was scattered
// once, and the table of sunlight if it integrates rows of rays (sky_row.h).
std::vector<Need> light_needs(const config::Parameters& parameters, config::SkyOrders orders,
                              bool reads_sunlight);
std::vector<Need> light_needs(const config::Atmosphere& atmosphere, config::SkyOrders orders,
                              bool reads_sunlight);

// For a table of radiance around a camera (1/sr): the number of points that certify it, and its
// conventions, reference and scale of errors. The table already has its channels' names.
AccuracyRequest sky_table_request(const std::array<int, 2>& size);
void describe_sky_table(Baked& table);

}  // namespace skybake
