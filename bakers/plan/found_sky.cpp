#include "bakers/plan/found_sky.h"

#include <memory>
#include <utility>

#include "bakers/assets/bruneton/stored_scattering.h"
#include "bakers/assets/multiple_scattering/stored_orders.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/plan/stored_sky.h"
#include "config/assets/bruneton.h"
#include "config/assets/multiple_scattering.h"

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
    MarchedTables tables{truth_.medium(), assets[0]->baked, places_of(parameters_, *assets[0])};
    std::unique_ptr<const HigherOrders> orders;
    int of_step = 1;
    if (assets.size() > 1) {
        const auto& bake = assets[1]->bake->as<config::MultipleScatteringBake>();
        orders = stored_orders(parameters_, bake, truth_.medium(), assets[1]->baked.image());
        tables.orders = orders.get();
        of_step += tables_of(bake);
    }
    fetches = static_cast<double>(way.steps) * of_step;
    return truth_.as_compared(march_sky(tables, truth_.views(), way.steps, threads_));
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
