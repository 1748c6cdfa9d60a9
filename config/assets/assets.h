// This header is the list of all assets. A folder of bakers/assets makes each of them.
#pragma once

#include <tuple>

#include "config/assets/aerial_perspective.h"
#include "config/assets/asset.h"
#include "config/assets/blue_noise.h"
#include "config/assets/bruneton.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_light.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/environment.h"
#include "config/assets/flipbook.h"
#include "config/assets/forward_scattering.h"
#include "config/assets/irradiance.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/noise_volume.h"
#include "config/assets/occupancy.h"
#include "config/assets/optical_depth.h"
#include "config/assets/phase.h"
#include "config/assets/sky_view.h"
#include "config/assets/transmittance.h"
#include "config/assets/weather_map.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// The assets stand in the order in which the documentation shows them.
using Assets =
    std::tuple<TransmittanceBake, MultipleScatteringBake, SkyViewBake, EnvironmentBake,
               AerialPerspectiveBake, IrradianceBake, PhaseBake, BrunetonBake, OpticalDepthBake,
               NoiseVolumeBake, WeatherMapBake, BlueNoiseBake, CloudVolumeBake, CloudLightBake,
               ForwardScatteringBake, CloudDistanceBake, FlipbookBake, OccupancyBake>;

// Calls `use` with a Tag of each asset, in order.
template <class Use>
void for_each_asset(const Use& use) {
    [&use]<class... Asset>(const std::tuple<Asset...>*) {
        (use(Tag<Asset>{}), ...);
    }(static_cast<const Assets*>(nullptr));
}

// Calls `use` with the asset of a bake.
template <class Use>
void visit_asset(const Bake& bake, const Use& use) {
    for_each_asset([&]<class Asset>(Tag<Asset>) {
        if (const Asset* asset = bake.find<Asset>()) use(*asset);
    });
}

}  // namespace skybake::config
