// The baker of asset = "bruneton".
#include <algorithm>
#include <array>
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
    static const Baker<config::BrunetonBake> row = {
        .version = 2, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
