#include "bakers/registry.h"

#include <array>
#include <variant>

#include "bakers/atmosphere/multiple_scattering_table.h"
#include "bakers/atmosphere/transmittance_table.h"

namespace skybake {

namespace {

using config::Bake;
using config::MultipleScatteringBake;
using config::Outcome;
using config::Parameters;
using config::TransmittanceBake;

constexpr double kMebibyte = 1024.0 * 1024.0;

template <class Asset>
Estimate estimate(const Bake& bake) {
    // Seconds a texel and seconds of certification, measured on Earth.
    constexpr bool kDear = std::is_same_v<Asset, MultipleScatteringBake>;
    constexpr double kSecondsPerTexel = kDear ? 1e-4 : 2e-7;
    constexpr double kCertification = kDear ? 0.1 : 0.05;
    const auto& asset = std::get<Asset>(bake.asset);
    Estimate result;
    result.size = asset.max_error ? std::array<int, 2>{} : asset.size;
    const double texels = static_cast<double>(result.size[0]) * result.size[1];
    const double bytes_per_texel = asset.pixel_type == config::PixelType::half ? 6 : 12;
    result.seconds = texels * kSecondsPerTexel + kCertification;
    result.memory_mib = (texels * (24 + 12 + bytes_per_texel) + 8e6) / kMebibyte;
    result.disk_mib = texels * bytes_per_texel / kMebibyte;
    return result;
}

Outcome<BakedTable> transmittance(const Parameters& parameters, const Bake& bake,
                                  const BakeOptions& options, BakedTable table) {
    return bake_transmittance(make_medium(parameters.atmosphere),
                              std::get<TransmittanceBake>(bake.asset), options, std::move(table));
}

Outcome<BakedTable> multiple_scattering(const Parameters& parameters, const Bake& bake,
                                        const BakeOptions& options, BakedTable table) {
    return bake_multiple_scattering(make_medium(parameters.atmosphere),
                                    std::get<MultipleScatteringBake>(bake.asset), options,
                                    std::move(table));
}

const std::vector<std::string_view> kShellAndProfiles = {
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

std::vector<std::string_view> with(std::vector<std::string_view> patterns,
                                   std::initializer_list<std::string_view> further) {
    patterns.insert(patterns.end(), further);
    return patterns;
}

}  // namespace

std::span<const Baker> bakers() {
    static const std::array<Baker, 2> table = {{
        {"transmittance", 1, kShellAndProfiles, estimate<TransmittanceBake>, transmittance},
        {"multiple_scattering", 1,
         with(kShellAndProfiles, {"atmosphere.ground_albedo", "atmosphere.layers.*.scattering"}),
         estimate<MultipleScatteringBake>, multiple_scattering},
    }};
    return table;
}

const Baker& baker_of(const Bake& bake) {
    // The order of the variant's alternatives is the order of the table.
    return bakers()[bake.asset.index()];
}

Outcome<BakedTable> bake_table(const config::Recipe& recipe, const Bake& bake,
                               const BakeOptions& options) {
    const Baker& baker = baker_of(bake);
    BakedTable table;
    table.name = bake.name;
    table.channel_names = recipe.parameters.wavelengths.size() == 1
                              ? std::vector<std::string>{"Y"}
                              : std::vector<std::string>{"R", "G", "B"};
    std::vector<std::string> patterns(baker.parameters.begin(), baker.parameters.end());
    patterns.push_back("bake." + bake.name + ".*");
    table.parameters = config::parameters_toml(recipe, patterns);
    table.details.emplace_back("baker_version", std::to_string(baker.version));
    return baker.bake(recipe.parameters, bake, options, std::move(table));
}

}  // namespace skybake
