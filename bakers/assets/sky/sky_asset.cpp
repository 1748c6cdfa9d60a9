#include "bakers/assets/sky/sky_asset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/light/shared_light.h"
#include "bakers/math/relative_error.h"
#include "config/assets/assets.h"
#include "config/sections/layer.h"

namespace skybake {

std::vector<Need> light_needs(const std::vector<config::Atmosphere>& packets,
                              config::SkyOrders orders, bool reads_sunlight) {
    std::vector<Need> needs;
    for (const config::Atmosphere& packet : packets) {
        if (orders != config::SkyOrders::single) {
            needs.push_back(need_of(LightRequest{.atmosphere = packet}));
        }
        if (reads_sunlight) needs.push_back(need_of(sunlight_request(packet, orders)));
    }
    return needs;
}

AccuracyRequest sky_table_request(const std::array<int, 2>& size) {
    AccuracyRequest request;
    request.size = size;
    request.quick = {256, 1};
    request.full = {4096, 1};
    request.quick_search = {36, 56, 6, 6, 56};
    request.full_search = {512, 256, 64, 32, 4096};
    return request;
}

void describe_sky_table(Baked& table) {
    table.conventions.angle_unit = "deg";
    table.conventions.radiance_unit = "1/sr";
    table.conventions.solar_irradiance.assign(table.channel_names.size(), 1);
    table.certificate.reference = "quadrature of each ray, exact sunlight and transmittance";
    table.certificate.scale = kRelativeErrorScale;
}

void describe_sun_table(config::MultipleScatteringMapping mapping, std::string altitude_formula,
                        const Shell& shell, Baked& table) {
    const bool twilight = mapping == config::MultipleScatteringMapping::twilight;
    table.mapping = twilight ? "twilight" : "hillaire";
    table.axes = {{"sun_cos_zenith",
                   twilight ? "x = (1 + sign(mu_s) sqrt(|mu_s|)) / 2" : "x = (mu_s + 1) / 2",
                   "end points on texel centres", -1, 1},
                  {"altitude_km", std::move(altitude_formula), "end points on texel centres", 0,
                   shell.thickness_km}};
    table.axes[0].constants = {{"first", 0.0}, {"share", 1.0}};
    table.axes[1].constants = shell_constants(shell);
    table.conventions.angle_unit = "cosine";
    table.conventions.solar_irradiance.assign(table.channel_names.size(), 1);
    table.certificate.scale = kRelativeErrorScale;
}

namespace {

// Whether the asset is made of light of all orders.
bool is_of_all_orders(const Bake& bake) {
    const auto scatters_again = [](const auto* asset) {
        return asset != nullptr && asset->orders != config::SkyOrders::single;
    };
    const bool is_closure = bake.find<config::MultipleScatteringBake>() != nullptr;
    const auto* irradiance = bake.find<config::IrradianceBake>();
    const auto* bruneton = bake.find<BrunetonBake>();
    const auto* light = bake.find<CloudLightBake>();
    return scatters_again(bake.find<config::SkyViewBake>()) ||
           scatters_again(bake.find<config::EnvironmentBake>()) ||
           scatters_again(bake.find<config::AerialPerspectiveBake>()) ||
           (irradiance != nullptr && irradiance->content != config::IrradianceContent::direct) ||
           is_closure || (bruneton != nullptr && bruneton->table != BrunetonTable::transmittance) ||
           (light != nullptr && light->contents == CloudLightContents::clear_sky_radiance);
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

}  // namespace

std::optional<Diagnostic> check_solvable(const config::Atmosphere& atmosphere, const Bake& bake) {
    constexpr double kGreatestDepth = 100;
    constexpr double kGreatestThickness = 100;  // in radii of the ground
    if (!is_of_all_orders(bake)) return std::nullopt;
    const double depth = scattering_depth(atmosphere);
    if (depth > kGreatestDepth) {
        return diagnosis("E0405",
                         fmt::format("`{}`: the air scatters over a zenith optical depth of "
                                     "{:.3g}; light of all orders is made for up to {}",
                                     bake.name, depth, kGreatestDepth),
                         "use smaller scattering coefficients: is the unit right?");
    }
    const double thickness = thickness_of(atmosphere).meters / atmosphere.ground_radius.meters;
    if (thickness > kGreatestThickness) {
        return diagnosis(
            "E0405",
            fmt::format("`{}`: the air is {:.3g} times as high as the ground's radius; light of "
                        "all orders is made for up to {} times",
                        bake.name, thickness, kGreatestThickness),
            "use a larger ground_radius or a smaller top_radius: are the units right?");
    }
    return std::nullopt;
}

}  // namespace skybake
