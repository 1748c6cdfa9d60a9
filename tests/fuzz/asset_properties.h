// Checks what must hold of the bakes of every recipe that parses.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/aerial_perspective.h"
#include "config/assets/assets.h"
#include "config/assets/blue_noise.h"
#include "config/assets/bruneton.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_light.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/environment.h"
#include "config/assets/flipbook.h"
#include "config/assets/forward_scattering.h"
#include "config/assets/irradiance.h"
#include "config/assets/noise_volume.h"
#include "config/assets/occupancy.h"
#include "config/assets/optical_depth.h"
#include "config/assets/phase.h"
#include "config/assets/sky_view.h"
#include "config/assets/weather_map.h"
#include "config/sections/noise.h"
#include "tests/fuzz/section_properties.h"

namespace skybake::config::fuzzing {

// Checks the files of a volume of this size.
inline void check_files(const AssetFiles& files, const std::array<int, 3>& size) {
    double voxels = 1;
    for (const int edge : size) {
        require(edge >= 1 && edge <= 16384, "size in range");  // also where it is computed
        voxels *= edge;
    }
    require(voxels <= 68719476736.0, "at most 2^36 voxels");
    require(!files.formats.empty() && files.formats.size() <= 3, "one to three formats");
    for (const FileFormat format : files.formats) {
        require(facts_of(format).holds(files.pixel_type), "formats hold the pixel type");
    }
    require(files.columns >= 0 && files.columns <= size[2], "no more columns than slices");
    require(files.mips >= 1 && files.mips <= 15, "levels in range");
}

inline void check_asset(const NoiseVolumeBake& asset, const Parameters& parameters) {
    require(find_by_name(parameters.noises, asset.noise) != nullptr, "its noise is there");
    check_files(asset, asset.size);
}

inline void check_asset(const WeatherMapBake& asset, const Parameters& parameters) {
    const Noise* noise = find_by_name(parameters.noises, asset.noise);
    require(noise != nullptr, "its noise is there");
    const std::size_t channels = noise->pack == NoisePacking::none ? noise->channels.size() : 1;
    check_files(asset, {asset.size[0], asset.size[1], 1});
    if (asset.content != WeatherContent::amounts) return;
    require(asset.covered.size() == channels && asset.full.size() == channels,
            "each channel has its shares");
    require(asset.streaks.size() == channels, "each channel has its streaks");
    require(asset.yields_to.empty() || asset.yields_to.size() == channels,
            "each channel yields or not");
    for (std::size_t c = 0; c < channels; ++c) {
        require(asset.full[c] <= asset.covered[c], "no more is full than is covered");
    }
}

inline void check_asset(const BlueNoiseBake& asset, const Parameters&) {
    require(asset.mips == 1, "a mask has one level");
    check_files(asset, asset.voxels());
}

inline void check_asset(const ForwardScatteringBake& asset, const Parameters&) {
    check_files(asset, {asset.size[0], asset.size[1], 1});
}

inline void check_asset(const FlipbookBake& asset, const Parameters& parameters) {
    const std::array<int, 3> size = frame_size(first_frame(parameters, asset));
    require(asset.slice >= 0 && asset.slice < size[2], "its slice is there");
    require(asset.mips == 1, "a flipbook has one level");
    check_files(asset, {size[0], size[1], asset.length});
}

inline void check_asset(const CloudVolumeBake& asset, const Parameters& parameters) {
    require(find_by_name(parameters.clouds, asset.cloud) != nullptr, "its cloud is there");
    check_files(asset, asset.size);
}

// Returns the voxels of the cloud volume that an asset is made of.
template <class Asset>
std::array<int, 3> voxels_of_source(const Asset& asset, const Parameters& parameters) {
    const Bake* of = find_by_name(parameters.bakes, asset.of);
    require(of && of->is<CloudVolumeBake>(), "its cloud volume is there");
    return of->as<CloudVolumeBake>().size;
}

// Returns how many cells cover them.
template <class Asset>
std::array<int, 3> cells_of_source(const Asset& asset, const Parameters& parameters) {
    std::array<int, 3> cells = voxels_of_source(asset, parameters);
    for (int& edge : cells) edge = (edge + asset.cell - 1) / asset.cell;
    return cells;
}

template <class Asset>
void check_cells(const Asset& asset, const Parameters& parameters) {
    require(asset.cell >= 1 && asset.cell <= 16 && (asset.cell & (asset.cell - 1)) == 0,
            "a cell is a power of two");
    check_files(asset, cells_of_source(asset, parameters));
    const std::size_t contents = asset.contents.size();
    require(contents == 1 || contents == 3 || contents == 4, "contents make a picture");
}

inline void check_asset(const OccupancyBake& asset, const Parameters& parameters) {
    check_cells(asset, parameters);
}

inline void check_asset(const CloudLightBake& asset, const Parameters& parameters) {
    std::array<int, 3> texels = cells_of_source(asset, parameters);
    if (asset.contents == CloudLightContents::shadow) texels[2] = 1;
    if (asset.max_error) {
        require(asset.mips == 1, "the number of levels is not known");
    } else {
        check_files(asset, texels);
    }
    const std::size_t channels = channels_of(asset);
    require(channels == 1 || channels == 3 || channels == 4, "channels make a picture");
    require(asset.sun_azimuths.empty() || asset.sun_azimuths.size() == asset.sun_elevations.size(),
            "each sun has an azimuth");
    if (is_of_one_sun(asset.contents)) {
        require(asset.sun_elevations.size() == 1, "radiance is of one sun");
    }
    if (asset.contents == CloudLightContents::clear_sky_radiance) {
        require(parameters.atmosphere.top_radius.meters > 0, "there is a sky");
    }
}

inline void check_asset(const CloudDistanceBake& asset, const Parameters& parameters) {
    check_cells(asset, parameters);
    const std::array<int, 3> voxels = voxels_of_source(asset, parameters);
    require(voxels[0] % asset.cell == 0 && voxels[1] % asset.cell == 0, "texels tile the volume");
    require(asset.mips == 1, "it has one level");
    require(asset.range[0].meters <= 0 && asset.range[1].meters > 0, "0 is in its range");
    require(asset.contents.front() == DistanceContent::distance, "the distance is the first");
}

inline void check_layers(const std::vector<std::string>& layers, SkyOrders orders,
                         const Parameters& parameters) {
    require(layers.empty() || orders == SkyOrders::single, "layers scatter once");
    for (const std::string& name : layers) {
        require(find_by_name(parameters.atmosphere.layers, name) != nullptr,
                "its layers are there");
    }
}

// Checks an asset of the air, and the layers whose light it may have.
template <class Asset>
void check_asset(const Asset& asset, const Parameters& parameters) {
    require(parameters.atmosphere.ground_radius.meters > 0, "a sky has an atmosphere");
    if constexpr (requires {
                      asset.orders;
                      asset.layers;
                  }) {
        check_layers(asset.layers, asset.orders, parameters);
    }
}

inline void check_asset(const SkyViewBake& asset, const Parameters& parameters) {
    check_asset<>(asset, parameters);
    require(!asset.sun_elevations.empty() && asset.sun_elevations.size() <= 64, "suns");
}

inline void check_asset(const AerialPerspectiveBake& asset, const Parameters& parameters) {
    check_asset<>(asset, parameters);
    require(holds_colors(parameters) || parameters.wavelengths.size() == 3 ||
                asset.content != AerialContent::in_scatter_and_transmittance,
            "channels make a picture");
    check_files(asset, asset.size);
}

inline void check_asset(const PhaseBake& asset, const Parameters&) {
    require(asset.particles.empty() != asset.layer.empty(), "of particles or of a layer");
}

inline void check_asset(const BrunetonBake& asset, const Parameters& parameters) {
    require(parameters.atmosphere.ground_radius.meters > 0, "a sky has an atmosphere");
    const bool is_flat =
        asset.table == BrunetonTable::transmittance || asset.table == BrunetonTable::irradiance;
    require(is_flat ? asset.size[2] == 1 : asset.nu_size >= 2 && asset.size[0] % asset.nu_size == 0,
            "sub-images that fit");
    require(is_flat || within(asset.sun_cos_zenith_min, -1, 0), "a sun's axis");
    check_files(asset, asset.size);
}

inline void check_asset(const OpticalDepthBake& asset, const Parameters& parameters) {
    require(parameters.atmosphere.ground_radius.meters > 0, "columns are of an atmosphere");
    require(!asset.kinds.empty() && asset.kinds.size() <= 4, "a channel each");
    check_files(asset, asset.size);
}

}  // namespace skybake::config::fuzzing
