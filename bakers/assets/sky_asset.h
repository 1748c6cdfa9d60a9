// What the assets that show the light of a sky share: how the light is made, and what their tables
// say of it.
#pragma once

#include <array>
#include <utility>

#include "bakers/assets/asset_label.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/sky_light.h"

namespace skybake {

// make(light), unless the bake was interrupted while the light was solved for or what was found is
// no light: then nothing, or E0405 of the asset of that name.
template <class Make>
config::Outcome<Baked> bake_of_light(const SkyLight& light, const std::string& name,
                                     const BakeOptions& options, const Make& make) {
    if (options.cancelled()) return {};
    if (const auto problem = light.problem(name)) return {{}, {*problem}};
    return make(light);
}

// A table of radiance around a camera (1/sr): how many points certify it, and its conventions,
// reference and scale of errors. The table has its channels' names.
AccuracyRequest sky_table_request(const std::array<int, 2>& size);
void describe_sky_table(Baked& table);

}  // namespace skybake
