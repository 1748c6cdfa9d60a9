// The asset cloud_volume: the density of a cloud over its extent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/assets/registry/baker.h"
#include "bakers/clouds/cloud_plan.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/math/bake_options.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "config/sections/volume.h"

namespace skybake {

struct Baked;

// The inputs of a cloud besides its own parameters.
struct CloudInputs {
    const Noise* base = nullptr;               // null if the cloud is made of a volume
    const config::VolumeFile* file = nullptr;  // null if it is made of noise, or has grown
    std::optional<cloud::CloudVolume> volume;  // of `file`, or what has grown
    const Noise* detail = nullptr;             // null if the cloud names none
    cloud::CloudMaps maps;
    std::optional<double> coverage;  // the one that gives the cloud its cover
    std::shared_ptr<const convection::GrownCloud> grown = {};  // null: it has not grown
};

// All that the voxels of a volume depend on, and all that the coverage of one with `cover` does.
NeedKey key_of_voxels(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs);
NeedKey key_of_coverage(const Parameters& parameters, const CloudVolumeBake& bake);

// Returns the plan of a cloud at a size.
cloud::CloudPlan plan_of_cloud(const Cloud& cloud, const CloudInputs& inputs,
                               const std::array<int, 3>& size);

// Returns the cloud's definition, which that of a volume filters for voxels of a size.
cloud::CloudReference reference_of_cloud(const Cloud& cloud, const CloudInputs& inputs,
                                         const std::array<int, 3>& size);

// Returns the threshold that a lookup of the stored values must exceed to count as cloud.
float filtered_threshold(const Cloud& cloud);

// Returns `volume`, which comes with name and parameters, with the voxels on demand and all else
// that the cloud's files state, except what finish_volume adds.
Baked make_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
                        Baked volume);

// The voxels of a volume, and the opened file or the growth that they come from, if they do. The volume
// shares both with the assets that are made of it.
std::vector<Need> needs_of_voxels(const Parameters& parameters, const CloudVolumeBake& asset);

// Returns the same with voxels that the first pass over them holds in memory, as far as
// options.held_voxel_bytes allows it.
Baked hold_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake, const CloudInputs& inputs,
                        const BakeOptions& options, Baked volume);

// Bakes the same, surveyed and certified. Returns E0401 or E0402 for a voxel that the pixel type
// cannot hold, and neither value nor diagnostics after an interruption.
Outcome<Baked> bake_cloud_volume(const Cloud& cloud, const CloudVolumeBake& bake,
                                 const CloudInputs& inputs, const BakeOptions& options,
                                 Baked volume);

// The following functions are shared by the baker of cloud volumes and those of assets made from
// them.

// Estimates the cost as if the cloud filled its box; empty regions take less.
Estimate estimate_cloud_volume(const Parameters& parameters, const CloudVolumeBake& asset);

// Returns the pictures that are laid over the cloud, and the files of the volume that it is made of.
std::vector<InputFile> cloud_volume_inputs(const Parameters& parameters,
                                           const CloudVolumeBake& asset);

// Returns the places of a volume of this extent over the cloud's base.
AssetPlaces cloud_places(const Cloud& cloud, const Uvw& extent_m);

// The cloud of a volume, as the volume spans it.
Cloud spanned_cloud(const Parameters& parameters, const CloudVolumeBake& asset);

Uvw extent_m_of(const Cloud& cloud);
// The lower corner of its tile.
Uvw corner_m_of(const Cloud& cloud);

// A statement of GLSL that declares its lower corner and its edges, `corner` and `tile`, in metres.
std::string cloud_box_glsl(const Cloud& cloud);

// The function of a march through a volume that `cells` tell about: a `call` up to the place, and what
// stands before it.
GlslFunction march_function(std::string_view cells, const std::string& call, std::string before);

}  // namespace skybake
