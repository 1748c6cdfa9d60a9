#include "bakers/assets/sky/solvable_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/math/vectors.h"
#include "config/assets/assets.h"
#include "config/sections/layer.h"

namespace skybake {

using config::Bake;
using config::Diagnostic;

namespace {

// Whether the asset is made of light of all orders.
bool is_of_all_orders(const Bake& bake) {
    const auto scatters_again = [](const auto* asset) {
        return asset != nullptr && asset->orders != config::SkyOrders::single;
    };
    const bool is_closure = bake.find<config::MultipleScatteringBake>() != nullptr;
    const auto* irradiance = bake.find<config::IrradianceBake>();
    const auto* bruneton = bake.find<config::BrunetonBake>();
    const auto* light = bake.find<config::CloudLightBake>();
    return scatters_again(bake.find<config::SkyViewBake>()) ||
           scatters_again(bake.find<config::EnvironmentBake>()) ||
           scatters_again(bake.find<config::AerialPerspectiveBake>()) ||
           (irradiance != nullptr && irradiance->content != config::IrradianceContent::direct) ||
           is_closure ||
           (bruneton != nullptr && bruneton->table != config::BrunetonTable::transmittance) ||
           (light != nullptr && light->contents == config::CloudLightContents::clear_sky_radiance);
}

config::Length thickness_of(const config::Atmosphere& atmosphere) {
    return {atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
}

// Returns the zenith optical depth of scattering, of the channel where it is largest.
double scattering_depth(const config::Atmosphere& atmosphere) {
    std::vector<double> depths(atmosphere.ground_albedo.size(), 0.0);
    for (const config::Layer& given : atmosphere.layers) {
        if (!given.enabled) continue;
        const config::Layer layer = with_coefficients(given);
        const double column = config::density_column(layer, thickness_of(atmosphere));
        for (std::size_t c = 0; c < layer.scattering.size() && c < depths.size(); ++c) {
            depths[c] += column * layer.scattering[c].per_meter;
        }
    }
    return *std::ranges::max_element(depths);
}

Diagnostic unsolvable(std::string message, std::string label) {
    Diagnostic fault;
    fault.code = "E0405";
    fault.message = std::move(message);
    fault.label = std::move(label);
    return fault;
}

}  // namespace

std::optional<Diagnostic> check_solvable(const config::Atmosphere& atmosphere, const Bake& bake) {
    constexpr double kGreatestDepth = 100;
    constexpr double kGreatestThickness = 100;  // in radii of the ground
    if (!is_of_all_orders(bake)) return std::nullopt;
    const double depth = scattering_depth(atmosphere);
    if (depth > kGreatestDepth) {
        return unsolvable(
            fmt::format("`{}`: the air scatters over a zenith optical depth of {:.3g}; light of "
                        "all orders is made for up to {}",
                        bake.name, depth, kGreatestDepth),
            "use smaller scattering coefficients: is the unit right?");
    }
    const double thickness = thickness_of(atmosphere).meters / atmosphere.ground_radius.meters;
    if (thickness > kGreatestThickness) {
        return unsolvable(
            fmt::format("`{}`: the air is {:.3g} times as high as the ground's radius; light of "
                        "all orders is made for up to {} times",
                        bake.name, thickness, kGreatestThickness),
            "use a larger ground_radius or a smaller top_radius: are the units right?");
    }
    return std::nullopt;
}

}  // namespace skybake
