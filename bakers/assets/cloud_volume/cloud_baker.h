// What the baker of a cloud's volume shares with those of assets that are made of it.
#pragma once

#include <vector>

#include "bakers/assets/baker.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/cloud.h"

namespace skybake {

// As if the cloud filled its box: what of it is empty takes less.
Estimate estimate_cloud_volume(const config::Parameters& parameters,
                               const config::CloudVolumeBake& asset);

// The pictures laid over it.
std::vector<InputFile> cloud_volume_inputs(const config::Parameters& parameters,
                                           const config::CloudVolumeBake& asset);

// Of a volume of this extent over the cloud's base.
AssetPlaces cloud_places(const config::Cloud& cloud, const Uvw& extent_m);

Uvw extent_m_of(const config::Cloud& cloud);

}  // namespace skybake
