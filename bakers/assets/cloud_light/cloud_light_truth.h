// The light that lookups of a cloud_light volume are measured against.
#pragma once

#include <string>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/field/certify.h"
#include "config/assets/cloud_light.h"

namespace skybake {

// Points lie in cells with cloud, those of a map anywhere. `layer`
// outlives it.
struct CloudLightTruth {
    VolumeReference reference;
    VolumeComparison comparison;
    std::string name;
};
CloudLightTruth cloud_light_truth(const cloud_light::CloudLayer& layer,
                                  const config::CloudLightBake& bake, int threads);

}  // namespace skybake
