// The asset cloud_volume: a cloud over its extent.
#pragma once

#include <string>
#include <vector>

#include "bakers/assets/baker.h"
#include "bakers/clouds/cloud_plan.h"
#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake {

// What a cloud is made of besides its own parameters.
struct CloudInputs {
    const config::Noise* base = nullptr;
    const config::Noise* detail = nullptr;  // null where the cloud names none
    cloud::CloudMaps maps;
};

// What a lookup of the stored values must exceed to be something.
float filtered_threshold(const config::Cloud& cloud);

// What a cloud's files say and its voxels on demand: `volume`, which has a name and parameters,
// with all the rest but what finish_volume adds.
Baked make_cloud_volume(const config::Cloud& cloud, const config::CloudVolumeBake& bake,
                        const CloudInputs& inputs, Baked volume);

// The same, surveyed and certified. E0401, E0402: a voxel that the pixel type cannot hold. No value
// and no diagnostics after an interruption.
config::Outcome<Baked> bake_cloud_volume(const config::Cloud& cloud,
                                         const config::CloudVolumeBake& bake,
                                         const CloudInputs& inputs, const BakeOptions& options,
                                         Baked volume);

// What the baker of a cloud's volume shares with those of assets that are made of it.

// As if the cloud filled its box: what of it is empty takes less.
Estimate estimate_cloud_volume(const config::Parameters& parameters,
                               const config::CloudVolumeBake& asset);

// The pictures laid over it.
std::vector<InputFile> cloud_volume_inputs(const config::Parameters& parameters,
                                           const config::CloudVolumeBake& asset);

// Of a volume of this extent over the cloud's base.
AssetPlaces cloud_places(const config::Cloud& cloud, const Uvw& extent_m);

// The cloud of a volume, as the volume spans it.
config::Cloud spanned_cloud(const config::Parameters& parameters,
                            const config::CloudVolumeBake& asset);

Uvw extent_m_of(const config::Cloud& cloud);

// A statement of GLSL that declares its lower corner and its edges, `corner` and `tile`, in metres.
std::string cloud_box_glsl(const config::Cloud& cloud);

}  // namespace skybake
