// A sheet of pictures: a cloud in sunlight by paths, and what each family of ways makes of it.
#pragma once

#include <string>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/math/bake_options.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/cloud_views.h"
#include "bakers/plan/cloud_ways.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"

namespace skybake {

// Returns a PNG with a row for the truth and one for each of the clouds, under up to two suns of the
// scene, which shine from the right. The camera looks up at the layer or, where all cameras are above
// it, down. `layer` has the finest voxels. Diagnostics are those of png_bytes. After an interruption the
// picture must not be used.
config::Outcome<std::string> cloud_sheet(const config::Cloud& cloud,
                                         const cloud_light::CloudLayer& layer,
                                         const CloudRange& range,
                                         const std::vector<BakedWay<CloudWay>>& clouds,
                                         const BakeOptions& options);

}  // namespace skybake
