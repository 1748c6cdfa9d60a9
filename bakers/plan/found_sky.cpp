#include "bakers/plan/found_sky.h"

#include <vector>

#include "bakers/assets/bruneton/stored_scattering.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/render/sky_view.h"
#include "config/assets/bruneton.h"

namespace skybake {

namespace {

AssetPlaces places_of(const config::Parameters& parameters, const BakedAsset& asset) {
    return baker_of(*asset.bake).places(parameters, *asset.bake, stored_texels(asset.baked));
}

}  // namespace

std::vector<Spectrum> SkyOfWay::find(const SkyWay& way,
                                     const std::vector<const BakedAsset*>& assets,
                                     double& fetches) const {
    switch (way.how) {
        case config::SkyBy::march:
            return march(way, assets, fetches);
        case config::SkyBy::fetch:
            fetches = 2;  // of the two sub-images next to the angle to the sun
            return fetch(*assets.front());
        case config::SkyBy::picture:
            fetches = 1;
            return look_up(*assets.front());
    }
    return {};
}

std::vector<Spectrum> SkyOfWay::march(const SkyWay& way,
                                      const std::vector<const BakedAsset*>& assets,
                                      double& fetches) const {
    std::vector<PreviewAsset> stored;
    for (const BakedAsset* asset : assets) {
        stored.push_back({describe(asset->baked), asset->baked.image(), {}});
    }
    const bool is_single = stored.size() == 1;
    const auto tables = make_sky_tables(stored[0], is_single ? nullptr : &stored[1]);
    fetches = way.steps * (is_single ? 1.0 : 1.0 + moment_count(tables.value->degree));
    // The views show the air alone.
    SkyMedium over_black_ground = truth_.medium();
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    const Shell shell = shell_of(over_black_ground.air);
    std::vector<SkyRay> rays;
    for (const SkySample& view : truth_.views()) {
        rays.push_back(camera_ray(shell, view.altitude_km, view.sun, view.direction).in_air);
    }
    return truth_.as_compared(
        march_sky(over_black_ground, *tables.value, rays, way.steps, threads_));
}

std::vector<Spectrum> SkyOfWay::fetch(const BakedAsset& asset) const {
    const auto& bake = asset.bake->as<config::BrunetonBake>();
    return sky_of_scattering({truth_.air()}, bake, places_of(parameters_, asset), truth_.views())(
        asset.baked, threads_);
}

// The picture of the view's sun has no parallax, so that cameras at other altitudes see
// it where the same share of their sky is.
std::vector<Spectrum> SkyOfWay::look_up(const BakedAsset& asset) const {
    std::vector<Place> at;
    for (const SkySample& view : truth_.views()) {
        at.push_back({{"azimuth_deg", view.azimuth_deg},
                      {"above_horizon_deg", view.above_horizon_deg},
                      {"sun_elevation_deg", view.sun_elevation_deg}});
    }
    const auto places = [&](const StoredTexels&) { return places_of(parameters_, asset); };
    return light_looked_up(places, std::move(at))(asset.baked, threads_);
}

}  // namespace skybake
