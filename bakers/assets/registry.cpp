#include "bakers/assets/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <variant>

#include "bakers/air/particles/check_particles.h"
#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/named_parameters.h"
#include "bakers/assets/noise_volume/noise_volume.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/assets/phase/phase_table.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/strip_orders.h"
#include "config/sections/cloud_channels.h"
#include "config/text/key_path.h"

namespace skybake {

namespace {

using config::Bake;
using config::Cloud;
using config::CloudVolumeBake;
using config::MultipleScatteringBake;
using config::Noise;
using config::NoiseVolumeBake;
using config::OccupancyBake;
using config::Outcome;
using config::Parameters;
using config::TransmittanceBake;

std::vector<std::string> colour_names(const Parameters& parameters) {
    if (parameters.wavelengths.size() == 1) return {"Y"};
    return {"R", "G", "B"};
}

// Of all assets of an atmosphere; their bakers add what the values are.
Conventions sky_conventions(const Parameters& parameters) {
    Conventions conventions;
    conventions.length_unit = "km";
    conventions.coefficient_unit = "1/km";
    for (const config::Length& wavelength : parameters.wavelengths) {
        conventions.wavelengths_nm.push_back(to_digits(wavelength.meters * 1e9, 12));
    }
    return conventions;
}

BakedTable labelled_table(const Parameters& parameters, AssetLabel label) {
    BakedTable table;
    table.conventions = sky_conventions(parameters);
    table.name = std::move(label.name);
    table.channel_names = colour_names(parameters);
    table.parameters = std::move(label.parameters);
    table.details = std::move(label.details);
    return table;
}

BakedVolume labelled_volume(AssetLabel label) {
    BakedVolume volume;
    volume.name = std::move(label.name);
    volume.parameters = std::move(label.parameters);
    volume.details = std::move(label.details);
    return volume;
}

BakedVolume labelled_sky_volume(const Parameters& parameters, AssetLabel label) {
    BakedVolume volume = labelled_volume(std::move(label));
    volume.conventions = sky_conventions(parameters);
    return volume;
}

template <class Baked>
Outcome<BakedAsset> as_asset(Outcome<Baked> baked) {
    Outcome<BakedAsset> outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (baked.value) outcome.value = std::move(*baked.value);
    return outcome;
}

Outcome<BakedAsset> transmittance(const Parameters& parameters, const Bake& bake,
                                  const BakeOptions& options, AssetLabel label) {
    return as_asset(bake_transmittance(make_medium(parameters.atmosphere),
                                       std::get<TransmittanceBake>(bake.asset), options,
                                       labelled_table(parameters, std::move(label))));
}

Outcome<BakedAsset> multiple_scattering(const Parameters& parameters, const Bake& bake,
                                        const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<MultipleScatteringBake>(bake.asset);
    BakedTable table = labelled_table(parameters, std::move(label));
    if (asset.method == config::MultipleScatteringMethod::solved) {
        return as_asset(bake_solved_scattering(parameters.atmosphere, parameters.scene, asset,
                                               options, std::move(table)));
    }
    return as_asset(bake_multiple_scattering(make_medium(parameters.atmosphere), asset, options,
                                             std::move(table)));
}

Outcome<BakedAsset> phase(const Parameters& parameters, const Bake& bake,
                          const BakeOptions& options, AssetLabel label) {
    return as_asset(bake_phase(parameters, std::get<config::PhaseBake>(bake.asset), options,
                               labelled_table(parameters, std::move(label))));
}

Outcome<BakedAsset> bruneton(const Parameters& parameters, const Bake& bake,
                             const BakeOptions& options, AssetLabel label) {
    return as_asset(bake_bruneton(parameters.atmosphere, std::get<config::BrunetonBake>(bake.asset),
                                  options, labelled_sky_volume(parameters, std::move(label))));
}

Outcome<BakedAsset> columns(const Parameters& parameters, const Bake& bake,
                            const BakeOptions& options, AssetLabel label) {
    return as_asset(bake_columns(parameters.atmosphere,
                                 std::get<config::OpticalDepthBake>(bake.asset), options,
                                 labelled_sky_volume(parameters, std::move(label))));
}

Outcome<BakedAsset> noise_volume(const Parameters& parameters, const Bake& bake,
                                 const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<NoiseVolumeBake>(bake.asset);
    return as_asset(bake_noise_volume(noise_named(parameters, asset.noise), asset, options,
                                      labelled_volume(std::move(label))));
}

Outcome<BakedAsset> cloud_volume(const Parameters& parameters, const Bake& bake,
                                 const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<CloudVolumeBake>(bake.asset);
    BakedVolume volume = labelled_volume(std::move(label));
    const Outcome<CloudInputs> inputs = cloud_inputs(parameters, asset, volume.details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    return as_asset(bake_cloud_volume(cloud_named(parameters, asset.cloud), asset, *inputs.value,
                                      options, std::move(volume)));
}

Outcome<BakedAsset> occupancy_grid(const Parameters& parameters, const Bake& bake,
                                   const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<OccupancyBake>(bake.asset);
    const auto& of = std::get<CloudVolumeBake>(bake_named(parameters, asset.of).asset);
    const Cloud& cloud = cloud_named(parameters, of.cloud);
    BakedVolume volume = labelled_volume(std::move(label));
    const Outcome<CloudInputs> inputs = cloud_inputs(parameters, of, volume.details);
    if (!inputs.value) return {{}, inputs.diagnostics};
    const BakedVolume voxels = make_cloud_volume(cloud, of, *inputs.value, {});
    return as_asset(
        bake_occupancy({voxels, filtered_threshold(cloud)}, asset, options, std::move(volume)));
}

const std::vector<std::string> kShellAndProfiles = {
    "wavelengths",
    "atmosphere.ground_radius",
    "atmosphere.top_radius",
    "atmosphere.layers.*.profile",
    "atmosphere.layers.*.scale_height",
    "atmosphere.layers.*.center_altitude",
    "atmosphere.layers.*.half_width",
    "atmosphere.layers.*.bottom_altitude",
    "atmosphere.layers.*.top_altitude",
    "atmosphere.layers.*.table",
    "atmosphere.layers.*.extinction",
};

void add_particles(const std::string& name, std::vector<std::string>& patterns) {
    patterns.push_back(fmt::format("{}.*", config::join_path("particles", name)));
}

// Coefficients of layers of particles follow from these.
void add_layer_particles(const config::Layer& layer, std::vector<std::string>& patterns) {
    if (layer.phase != config::Phase::mie) return;
    const std::string path = config::join_path("atmosphere.layers", layer.name);
    for (const char* key : {"phase", "particles", "number_density"}) {
        patterns.push_back(fmt::format("{}.{}", path, key));
    }
    add_particles(layer.particles.particles.name, patterns);
}

void add_layer_particles(const Parameters& parameters, std::vector<std::string>& patterns) {
    for (const config::Layer& layer : parameters.atmosphere.layers) {
        add_layer_particles(layer, patterns);
    }
}

std::vector<std::string> transmittance_parameters(const Parameters& parameters, const Bake&) {
    std::vector<std::string> patterns = kShellAndProfiles;
    add_layer_particles(parameters, patterns);
    return patterns;
}

std::vector<std::string> multiple_scattering_parameters(const Parameters& parameters,
                                                        const Bake& bake) {
    std::vector<std::string> patterns = kShellAndProfiles;
    add_layer_particles(parameters, patterns);
    patterns.emplace_back("atmosphere.ground_albedo");
    patterns.emplace_back("atmosphere.layers.*.scattering");
    if (std::get<MultipleScatteringBake>(bake.asset).method ==
        config::MultipleScatteringMethod::solved) {
        patterns.emplace_back("atmosphere.layers.*.phase");
        patterns.emplace_back("atmosphere.layers.*.g");
        patterns.emplace_back("scene.altitude");
        patterns.emplace_back("scene.sun_elevation");
    }
    return patterns;
}

// Of a noise and those of its channels. Not its `size`, which is but the default of a bake's.
void add_noise(const Noise& noise, std::span<const config::NoiseChannel> channels,
               std::vector<std::string>& patterns) {
    const std::string path = config::join_path("noise", noise.name);
    for (const char* key : {"seed", "sampling", "pack"}) {
        patterns.push_back(fmt::format("{}.{}", path, key));
    }
    for (const config::NoiseChannel& channel : channels) {
        patterns.push_back(fmt::format("{}.channels.{}.*", path, channel.name));
    }
}

std::vector<std::string> noise_volume_parameters(const Parameters& parameters, const Bake& bake) {
    std::vector<std::string> patterns;
    const Noise& noise = noise_named(parameters, std::get<NoiseVolumeBake>(bake.asset).noise);
    add_noise(noise, noise.channels, patterns);
    return patterns;
}

std::vector<std::string> cloud_volume_parameters(const Parameters& parameters, const Bake& bake) {
    const Cloud& cloud = cloud_named(parameters, std::get<CloudVolumeBake>(bake.asset).cloud);
    const std::string path = config::join_path("clouds", cloud.name);
    std::vector<std::string> patterns = {fmt::format("{}.*", path), fmt::format("{}.*.*", path),
                                         fmt::format("{}.towers.*.*", path)};
    const Noise& base = noise_named(parameters, cloud.noise);
    add_noise(base, config::used_channels(base, cloud.channels), patterns);
    if (!cloud.detail.empty() && cloud.detail != cloud.noise) {
        const Noise& detail = noise_named(parameters, cloud.detail);
        add_noise(detail, config::used_channels(detail, config::CloudChannels::density), patterns);
    }
    return patterns;
}

std::vector<std::string> occupancy_parameters(const Parameters& parameters, const Bake& bake) {
    const Bake& volume = bake_named(parameters, std::get<OccupancyBake>(bake.asset).of);
    std::vector<std::string> patterns = cloud_volume_parameters(parameters, volume);
    const std::string path = config::join_path("bake", volume.name);
    // Not what its files are like.
    for (const char* key : {"asset", "cloud", "size", "extent", "pixel_type"}) {
        patterns.push_back(fmt::format("{}.{}", path, key));
    }
    return patterns;
}

// Asks for all of an atmosphere.
std::vector<std::string> sky_parameters(const Parameters& parameters, const Bake&) {
    std::vector<std::string> patterns = {"wavelengths", "atmosphere.*", "atmosphere.layers.*.*"};
    add_layer_particles(parameters, patterns);
    return patterns;
}

// Particles or a layer, and nothing else of the atmosphere but what makes it a whole one.
std::vector<std::string> phase_parameters(const Parameters& parameters, const Bake& bake) {
    const auto& asset = std::get<config::PhaseBake>(bake.asset);
    std::vector<std::string> patterns = {"wavelengths"};
    if (!asset.particles.empty()) {
        add_particles(asset.particles, patterns);
        return patterns;
    }
    patterns.emplace_back("atmosphere.*");
    patterns.push_back(fmt::format("{}.*", config::join_path("atmosphere.layers", asset.layer)));
    for (const config::Layer& layer : parameters.atmosphere.layers) {
        if (layer.name == asset.layer) add_layer_particles(layer, patterns);
    }
    return patterns;
}

std::unique_ptr<const SkyLight> light_of_view(const config::Atmosphere& atmosphere,
                                              const config::SkyViewBake& asset,
                                              const BakeOptions& options) {
    const bool from_strips =
        asset.sky == config::SkyMethod::strips && asset.orders != config::SkyOrders::single;
    if (!from_strips) {
        return std::make_unique<SkyLight>(atmosphere, asset.orders, asset.layers, options);
    }
    SkyMedium medium = make_sky_medium(atmosphere);
    auto strips = std::make_unique<StripOrders>(medium, options);
    return std::make_unique<SkyLight>(std::move(medium), asset.orders, std::move(strips));
}

Outcome<BakedAsset> sky_view(const Parameters& parameters, const Bake& bake,
                             const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<config::SkyViewBake>(bake.asset);
    const auto light = light_of_view(parameters.atmosphere, asset, options);
    if (options.cancelled()) return {};
    if (const auto problem = light->problem(label.name)) return {{}, {*problem}};
    return as_asset(
        bake_sky_view(*light, asset, options, labelled_table(parameters, std::move(label))));
}

Outcome<BakedAsset> aerial_perspective(const Parameters& parameters, const Bake& bake,
                                       const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<config::AerialPerspectiveBake>(bake.asset);
    const bool has_light = asset.content != config::AerialContent::transmittance;
    const SkyLight light(parameters.atmosphere,
                         has_light ? asset.orders : config::SkyOrders::single, asset.layers,
                         options);
    if (options.cancelled()) return {};
    if (const auto problem = light.problem(label.name)) return {{}, {*problem}};
    return as_asset(bake_aerial_perspective(light, asset, options, colour_names(parameters),
                                            labelled_sky_volume(parameters, std::move(label))));
}

Outcome<BakedAsset> irradiance(const Parameters& parameters, const Bake& bake,
                               const BakeOptions& options, AssetLabel label) {
    const auto& asset = std::get<config::IrradianceBake>(bake.asset);
    const SkyLight light(parameters.atmosphere, orders_of(asset), asset.layers, options);
    if (options.cancelled()) return {};
    if (const auto problem = light.problem(label.name)) return {{}, {*problem}};
    return as_asset(
        bake_irradiance(light, asset, options, labelled_table(parameters, std::move(label))));
}

std::vector<InputFile> no_inputs(const Parameters&, const Bake&) { return {}; }

std::vector<InputFile> cloud_volume_inputs(const Parameters& parameters, const Bake& bake) {
    const Cloud& cloud = cloud_named(parameters, std::get<CloudVolumeBake>(bake.asset).cloud);
    std::vector<InputFile> files;
    for (const config::CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
        if (!map->file.empty()) files.push_back({map->file, map->path});
    }
    return files;
}

std::vector<InputFile> occupancy_inputs(const Parameters& parameters, const Bake& bake) {
    return cloud_volume_inputs(parameters,
                               bake_named(parameters, std::get<OccupancyBake>(bake.asset).of));
}

}  // namespace

std::span<const Baker> bakers() {
    static const std::array<Baker, 11> table = {{
        {"transmittance", 2, transmittance_parameters, no_inputs, estimate_transmittance,
         transmittance},
        {"multiple_scattering", 2, multiple_scattering_parameters, no_inputs,
         estimate_multiple_scattering, multiple_scattering},
        {"sky_view", 2, sky_parameters, no_inputs, estimate_sky_view, sky_view},
        {"aerial_perspective", 2, sky_parameters, no_inputs, estimate_aerial_perspective,
         aerial_perspective},
        {"irradiance", 2, sky_parameters, no_inputs, estimate_irradiance, irradiance},
        {"phase", 2, phase_parameters, no_inputs, estimate_phase, phase},
        {"bruneton", 2, sky_parameters, no_inputs, estimate_bruneton, bruneton},
        {"optical_depth", 2, sky_parameters, no_inputs, estimate_columns, columns},
        {"noise_volume", 2, noise_volume_parameters, no_inputs, estimate_noise_volume,
         noise_volume},
        {"cloud_volume", 2, cloud_volume_parameters, cloud_volume_inputs, estimate_cloud_volume,
         cloud_volume},
        {"occupancy", 2, occupancy_parameters, occupancy_inputs, estimate_occupancy,
         occupancy_grid},
    }};
    return table;
}

const Baker& baker_of(const Bake& bake) {
    // The order of the variant's alternatives is the order of the table.
    return bakers()[bake.asset.index()];
}

std::string asset_parameters(const config::Recipe& recipe, const Bake& bake) {
    std::vector<std::string> patterns = baker_of(bake).parameters(recipe.parameters, bake);
    patterns.push_back(fmt::format("{}.*", config::join_path("bake", bake.name)));
    return config::parameters_toml(recipe, patterns);
}

Outcome<BakedAsset> bake_asset(const config::Recipe& recipe, const Bake& bake,
                               const BakeOptions& options) {
    std::vector<config::Diagnostic> problems = check_particles(recipe.parameters);
    if (!problems.empty()) return {{}, std::move(problems)};
    const Baker& baker = baker_of(bake);
    AssetLabel label;
    label.name = bake.name;
    label.parameters = asset_parameters(recipe, bake);
    label.details.emplace_back("baker_version", static_cast<double>(baker.version));
    return baker.bake(recipe.parameters, bake, options, std::move(label));
}

Outcome<BakedTable> bake_table(const config::Recipe& recipe, const Bake& bake,
                               const BakeOptions& options) {
    Outcome<BakedAsset> baked = bake_asset(recipe, bake, options);
    Outcome<BakedTable> outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (baked.value) outcome.value = std::get<BakedTable>(std::move(*baked.value));
    return outcome;
}

}  // namespace skybake
