#include "bakers/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "bakers/atmosphere/multiple_scattering_table.h"
#include "bakers/atmosphere/transmittance_table.h"
#include "bakers/core/pixel_type.h"
#include "bakers/core/voxel_boxes.h"
#include "bakers/noise/noise_volume.h"
#include "config/key_path.h"

namespace skybake {

namespace {

using config::Bake;
using config::MultipleScatteringBake;
using config::Noise;
using config::NoiseVolumeBake;
using config::Outcome;
using config::Parameters;
using config::TransmittanceBake;

constexpr double kMebibyte = 1024.0 * 1024.0;

template <class Asset>
Estimate estimate_table(const Parameters&, const Bake& bake) {
    // Seconds a texel and seconds of certification, measured on Earth.
    constexpr bool kDear = std::is_same_v<Asset, MultipleScatteringBake>;
    constexpr double kSecondsPerTexel = kDear ? 1e-4 : 2e-7;
    constexpr double kCertification = kDear ? 0.1 : 0.05;
    const auto& asset = std::get<Asset>(bake.asset);
    const std::array<int, 2> size = asset.max_error ? std::array<int, 2>{} : asset.size;
    Estimate result;
    result.size.assign(size.begin(), size.end());
    const double texels = static_cast<double>(size[0]) * size[1];
    const double bytes_per_texel = asset.pixel_type == config::PixelType::half ? 6 : 12;
    result.seconds = texels * kSecondsPerTexel + kCertification;
    result.memory_mib = (texels * (24 + 12 + bytes_per_texel) + 8e6) / kMebibyte;
    result.disk_mib = texels * bytes_per_texel / kMebibyte;
    return result;
}

const Noise& noise_of(const Parameters& parameters, const NoiseVolumeBake& bake) {
    return *std::find_if(parameters.noises.begin(), parameters.noises.end(),
                         [&](const Noise& noise) { return noise.name == bake.noise; });
}

// Seconds to store a byte, measured with deflate and without.
double seconds_per_byte(config::VolumeFormat format, const NoiseVolumeBake& bake) {
    constexpr double kDeflate = 2e-8;
    constexpr double kCopy = 1e-9;
    if (format == config::VolumeFormat::exr) {
        return bake.compression == config::Compression::none ? kCopy : kDeflate;
    }
    const bool deflates =
        format == config::VolumeFormat::vdb && bake.vdb_compression == config::VdbCompression::zip;
    return deflates ? kDeflate : kCopy;
}

Estimate estimate_noise_volume(const Parameters& parameters, const Bake& bake) {
    constexpr double kSecondsPerOctave = 1e-9;  // and voxel
    const auto& asset = std::get<NoiseVolumeBake>(bake.asset);
    const Noise& noise = noise_of(parameters, asset);
    double octaves = 0;
    for (const config::NoiseChannel& channel : noise.channels) {
        octaves += 1.0 + static_cast<double>(channel.octaves.gains.size() +
                                             channel.worley_octaves.gains.size());
    }
    const std::size_t channels =
        noise.pack == config::NoisePacking::none ? noise.channels.size() : 1;
    double voxels = 0;
    std::array<double, 3> size = {double(asset.size[0]), double(asset.size[1]),
                                  double(asset.size[2])};
    for (int level = 0; level < asset.mips; ++level) {
        voxels += size[0] * size[1] * size[2];
        for (double& side : size) side = std::max(1.0, std::floor(side / 2));
    }
    const double bytes = voxels * static_cast<double>(channels) * bytes_per_value(asset.pixel_type);
    Estimate result;
    result.size.assign(asset.size.begin(), asset.size.end());
    // The voxels are made once to be measured, and again for each file.
    result.seconds =
        voxels * octaves * kSecondsPerOctave * (1.0 + static_cast<double>(asset.formats.size()));
    for (const config::VolumeFormat format : asset.formats) {
        result.seconds += bytes * seconds_per_byte(format, asset);
    }
    // Boxes on their way, as floats and as the file stores them.
    const BoxSequence boxes(asset.size, static_cast<int>(channels));
    const double values = static_cast<double>(boxes.largest_count()) *
                          static_cast<double>(channels) * std::min(box_slots(0), boxes.count());
    result.memory_mib = 32 + values * (4.0 + bytes_per_value(asset.pixel_type)) / kMebibyte;
    result.disk_mib = bytes * static_cast<double>(asset.formats.size()) / kMebibyte;
    return result;
}

BakedTable labelled_table(const Parameters& parameters, AssetLabel label) {
    BakedTable table;
    table.name = std::move(label.name);
    table.channel_names = parameters.wavelengths.size() == 1
                              ? std::vector<std::string>{"Y"}
                              : std::vector<std::string>{"R", "G", "B"};
    table.parameters = std::move(label.parameters);
    table.details = std::move(label.details);
    return table;
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
    return as_asset(bake_multiple_scattering(make_medium(parameters.atmosphere),
                                             std::get<MultipleScatteringBake>(bake.asset), options,
                                             labelled_table(parameters, std::move(label))));
}

Outcome<BakedAsset> noise_volume(const Parameters& parameters, const Bake& bake,
                                 const BakeOptions& options, AssetLabel label) {
    BakedVolume volume;
    volume.name = std::move(label.name);
    volume.parameters = std::move(label.parameters);
    volume.details = std::move(label.details);
    const auto& asset = std::get<NoiseVolumeBake>(bake.asset);
    return as_asset(
        bake_noise_volume(noise_of(parameters, asset), asset, options, std::move(volume)));
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

std::vector<std::string> transmittance_parameters(const Bake&) { return kShellAndProfiles; }

std::vector<std::string> multiple_scattering_parameters(const Bake&) {
    std::vector<std::string> patterns = kShellAndProfiles;
    patterns.emplace_back("atmosphere.ground_albedo");
    patterns.emplace_back("atmosphere.layers.*.scattering");
    return patterns;
}

std::vector<std::string> noise_volume_parameters(const Bake& bake) {
    const std::string noise =
        config::join_path("noise", std::get<NoiseVolumeBake>(bake.asset).noise);
    // Not its `size`, which is but the default of the asset's own.
    return {fmt::format("{}.seed", noise), fmt::format("{}.sampling", noise),
            fmt::format("{}.pack", noise), fmt::format("{}.channels.*.*", noise)};
}

}  // namespace

std::span<const Baker> bakers() {
    static const std::array<Baker, 3> table = {{
        {"transmittance", 1, transmittance_parameters, estimate_table<TransmittanceBake>,
         transmittance},
        {"multiple_scattering", 1, multiple_scattering_parameters,
         estimate_table<MultipleScatteringBake>, multiple_scattering},
        {"noise_volume", 1, noise_volume_parameters, estimate_noise_volume, noise_volume},
    }};
    return table;
}

const Baker& baker_of(const Bake& bake) {
    // The order of the variant's alternatives is the order of the table.
    return bakers()[bake.asset.index()];
}

Outcome<BakedAsset> bake_asset(const config::Recipe& recipe, const Bake& bake,
                               const BakeOptions& options) {
    const Baker& baker = baker_of(bake);
    std::vector<std::string> patterns = baker.parameters(bake);
    patterns.push_back(fmt::format("{}.*", config::join_path("bake", bake.name)));
    AssetLabel label;
    label.name = bake.name;
    label.parameters = config::parameters_toml(recipe, patterns);
    label.details.emplace_back("baker_version", std::to_string(baker.version));
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
