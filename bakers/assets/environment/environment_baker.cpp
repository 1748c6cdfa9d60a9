// The baker of asset = "environment".
#include <algorithm>
#include <array>
#include <utility>

#include "bakers/assets/baker.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/sky_asset.h"
#include "bakers/light/sky_light.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentBake;
using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const EnvironmentBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLight light(parameters.atmosphere, asset.orders, asset.layers, options);
    return bake_of_light(light, label.name, options, [&](const SkyLight& found) {
        return bake_environment(found, asset, options,
                                labelled_table(parameters, std::move(label)));
    });
}

Estimate estimate(const Parameters&, const EnvironmentBake& asset) {
    return estimate_texels(asset, asset.size, 3e-6, 0.3 + seconds_to_solve(asset.orders));
}

AssetPlaces places(const Parameters&, const EnvironmentBake&, const StoredTexels&) {
    return single_lookup({"azimuth_deg", "elevation_deg"}, [](const Place& at) {
        return Uvw{at[0].second / 360 + 0.5, 0.5 - at[1].second / 180, 0.5};
    });
}

void draft(EnvironmentBake& asset, int) {
    asset.size = {std::min(asset.size[0], 128), std::min(asset.size[1], 64)};
}

}  // namespace

const Baker<EnvironmentBake>& baker(BakerTag<EnvironmentBake>) {
    static const Baker<EnvironmentBake> row = {
        .version = 1, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
