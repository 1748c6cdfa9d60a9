#include "bakers/assets/bruneton/stored_scattering.h"

#include <algorithm>
#include <utility>

#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/field/baked.h"

namespace skybake {

LightAtPlaces sky_of_scattering(std::vector<std::shared_ptr<const TracedAir>> packets,
                                const config::BrunetonBake& asset, AssetPlaces places,
                                const std::vector<SkySample>& samples) {
    std::vector<Place> at;
    std::vector<double> cosines;
    for (const SkySample& sample : samples) {
        cosines.push_back(std::clamp(sample.direction.cosine_to_sun, -1.0, 1.0));
        at.push_back({{"altitude_km", sample.altitude_km},
                      {"cos_zenith", sample.direction.mu},
                      {"sun_cos_zenith", sample.sun.cosine},
                      {"nu", cosines.back()},
                      {"ground", sample.above_horizon_deg < 0 ? 1 : 0}});
    }
    return [=, packets = std::move(packets), places = std::move(places), at = std::move(at),
            cosines = std::move(cosines)](const Baked& baked, int) {
        std::vector<ScatteringContent> of_packets;
        for (const auto& air : packets) of_packets.emplace_back(air->medium(), asset);
        std::vector<const ScatteringContent*> contents;
        for (const ScatteringContent& packet : of_packets) contents.push_back(&packet);
        const TableContent content(std::move(contents), weights_of(baked.conventions),
                                   asset.solar_irradiance);
        std::vector<Spectrum> light;
        for (const auto& channels : look_up_places(baked, places, at)) {
            Texel texel{};
            std::ranges::copy(channels, texel.begin());
            light.push_back(content.radiance(texel, cosines[light.size()]));
        }
        return light;
    };
}

}  // namespace skybake
