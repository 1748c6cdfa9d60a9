#include "bakers/preview/cloud_input.h"

#include <algorithm>
#include <variant>

namespace skybake {
namespace {

using config::CloudVolumeBake;
using config::OccupancyBake;

template <class Section>
const Section* section_named(const config::Parameters& parameters, const std::string& name) {
    for (const config::Bake& bake : parameters.bakes) {
        if (bake.name == name) return std::get_if<Section>(&bake.asset);
    }
    return nullptr;
}

const config::Cloud* cloud_of(const config::Parameters& parameters, const CloudVolumeBake* bake) {
    const auto cloud =
        std::find_if(parameters.clouds.begin(), parameters.clouds.end(),
                     [&](const config::Cloud& one) { return bake && one.name == bake->cloud; });
    return cloud == parameters.clouds.end() ? nullptr : &*cloud;
}

void add_occupancy(const PreviewAssets& assets, CloudPreviewInput& input) {
    const config::Parameters& parameters = assets.recipe->parameters;
    for (const PreviewAsset& asset : assets.assets) {
        const auto* bake = section_named<OccupancyBake>(parameters, asset.entry.name);
        if (bake == nullptr || bake->of != input.volume->entry.name || asset.voxels.empty())
            continue;
        input.occupancy = &asset;
        input.occupancy_bake = bake;
        return;
    }
}

void add_sky(const PreviewAssets& assets, CloudPreviewInput& input) {
    input.transmittance = assets.of_kind("transmittance");
    input.multiple_scattering = assets.of_kind("multiple_scattering");
    input.atmosphere = &assets.recipe->parameters.atmosphere;
}

}  // namespace

CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options) {
    CloudPreviewInput input;
    if (!assets.recipe || asset.voxels.empty()) return input;
    const config::Parameters& parameters = assets.recipe->parameters;
    const std::string& name = asset.entry.name;
    if (const auto* grid = section_named<OccupancyBake>(parameters, name)) {
        input.volume_bake = section_named<CloudVolumeBake>(parameters, grid->of);
        input.cloud = cloud_of(parameters, input.volume_bake);
        input.occupancy = &asset;
        input.occupancy_bake = grid;
    } else if (const auto* volume = section_named<CloudVolumeBake>(parameters, name)) {
        input.volume_bake = volume;
        input.cloud = cloud_of(parameters, volume);
        input.volume = &asset;
        add_occupancy(assets, input);
        add_sky(assets, input);
    }
    if (!options.sun_elevations_deg.empty()) {
        const double azimuth = input.suns.front().azimuth_degrees;
        input.suns.clear();
        for (const double elevation : options.sun_elevations_deg) {
            input.suns.push_back({elevation, azimuth});
        }
    }
    input.exposure_stops = options.exposure_stops;
    input.draft = options.draft;
    if (options.draft) {  // of which it makes half
        input.width = 768;
        input.height = 432;
    }
    return input;
}

}  // namespace skybake
