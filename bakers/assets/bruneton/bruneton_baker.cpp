// The baker of asset = "bruneton".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/baker.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/bruneton/scattering_volume.h"
#include "bakers/field/image.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::BrunetonBake;
using config::BrunetonTable;

constexpr auto kAtTexelCentres = TexelConvention::end_points_on_texel_centres;

Outcome<Baked> bake(const Parameters& parameters, const BrunetonBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_bruneton(parameters.atmosphere, asset, options,
                         labelled_sky_volume(parameters, std::move(label)));
}

Estimate estimate(const Parameters&, const BrunetonBake& asset) {
    const bool has_light = asset.table != BrunetonTable::transmittance;
    Estimate result = estimate_volume(asset, asset.size, 4, has_light ? 4e-6 : 2e-7);
    if (has_light) result.seconds += kSecondsToSolve;
    constexpr double kBytesPerVoxel = 4 * sizeof(float);  // all are held
    result.memory_mib += voxels_of(asset.size, 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters& parameters, const BrunetonBake& asset, const StoredTexels&) {
    const Shell shell = shell_of(parameters.atmosphere);
    const std::array<int, 3> size = asset.size;
    const auto flat = [size](double x, double y) {
        return Uvw{texture_coordinate(kAtTexelCentres, x, size[0]),
                   texture_coordinate(kAtTexelCentres, y, size[1]), 0.5};
    };
    if (asset.table == BrunetonTable::transmittance) {
        return single_lookup({"altitude_km", "cos_zenith"}, [shell, flat](const Place& at) {
            const UnitCoordinates x = transmittance_coordinates(shell, at[0].second, at[1].second);
            return flat(x.x_mu, x.x_r);
        });
    }
    if (asset.table == BrunetonTable::irradiance) {
        return single_lookup({"altitude_km", "sun_cos_zenith"}, [shell, flat](const Place& at) {
            return flat(0.5 * (at[1].second + 1), at[0].second / shell.thickness_km);
        });
    }
    const ScatteringMapping mapping(shell, size, asset.nu_size, asset.sun_cos_zenith_min);
    return AssetPlaces{{"altitude_km", "cos_zenith", "sun_cos_zenith", "nu", "ground"},
                       [mapping](const Probe& probe, int) {
                           const Place& at = probe.at;
                           return scattering_lookups(
                               mapping,
                               scattering_place(mapping, at[0].second, at[1].second, at[2].second,
                                                at[3].second, at[4].second != 0));
                       }};
}

AssetLookup flat_lookup(const Shell& shell, const BrunetonBake& asset, const StoredTexels& stored) {
    const std::string thickness_km = glsl_number(shell.thickness_km);
    GlslFunction function;
    if (asset.table == BrunetonTable::transmittance) {
        function.comment = fmt::format(
            "Returns the transmittance from an altitude of 0 to {} km to the top of the air, along "
            "a ray of this zenith angle that does not meet the ground.",
            thickness_km);
        function.arguments = "sampler2D table, float altitude_km, float cos_zenith";
        function.value = fmt::format("transmittance_to_top(table, {}, altitude_km, cos_zenith)",
                                     glsl_shell(shell));
        return {"transmittance", {with_channels(stored.channels, 3, std::move(function))}};
    }
    function.comment = fmt::format(
        "Returns the irradiance by the sky without the sun of a level surface that faces up, times "
        "the solar irradiance. altitude_km is from 0 to {}.",
        thickness_km);
    function.arguments = "sampler2D table, float altitude_km, float sun_cos_zenith";
    function.value =
        fmt::format("bruneton_irradiance(table, {}, altitude_km, sun_cos_zenith)", thickness_km);
    return {"bruneton", {with_channels(stored.channels, 3, std::move(function))}};
}

AssetLookup lookup(const Parameters& parameters, const BrunetonBake& asset,
                   const StoredTexels& stored) {
    const Shell shell = shell_of(parameters.atmosphere);
    if (asset.table == BrunetonTable::transmittance || asset.table == BrunetonTable::irradiance) {
        return flat_lookup(shell, asset, stored);
    }
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the table's channels, of which the first lines above say what the sky is. "
        "altitude_km is from 0 to {}, nu is the cosine of the angle between the view ray and the "
        "direction to the sun, and `ground` says that the view ray meets the ground.",
        glsl_number(shell.thickness_km));
    function.arguments =
        "sampler3D table, float altitude_km, float cos_zenith, float sun_cos_zenith, float nu, "
        "bool ground";
    function.value = fmt::format(
        "bruneton_scattering(table, {}, altitude_km, cos_zenith, sun_cos_zenith, nu, ground, {}, "
        "{})",
        glsl_shell(shell), glsl_number(asset.sun_cos_zenith_min), glsl_number(asset.nu_size));
    return {"bruneton", {with_channels(stored.channels, 4, std::move(function))}};
}

// The sub-images along u stay whole.
void draft(BrunetonBake& asset, int) {
    if (asset.table == BrunetonTable::transmittance || asset.table == BrunetonTable::irradiance) {
        return;
    }
    const int suns = asset.size[0] / asset.nu_size;
    asset.size = {asset.nu_size * std::min(suns, 16), std::min(asset.size[1], 64),
                  std::min(asset.size[2], 16)};
    asset.mips = 1;
}

}  // namespace

const Baker<config::BrunetonBake>& baker(BakerTag<config::BrunetonBake>) {
    static const Baker<config::BrunetonBake> row = {.version = 3,
                                                    .bake = bake,
                                                    .estimate = estimate,
                                                    .places = places,
                                                    .lookup = lookup,
                                                    .draft = draft};
    return row;
}

}  // namespace skybake
