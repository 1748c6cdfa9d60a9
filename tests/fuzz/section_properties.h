// Checks what must hold of the layers, noises and clouds of every recipe that parses.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "config/sections/cloud.h"
#include "config/sections/layer.h"
#include "config/sections/noise.h"
#include "config/sections/parameters.h"
#include "config/sections/particles.h"
#include "config/sections/volume.h"

namespace skybake::config::fuzzing {

inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
}

inline bool within(double value, double minimum, double maximum) {
    return value >= minimum && value <= maximum;  // false for NaN
}
inline void check_layer(const Layer& layer, std::size_t channels) {
    require(layer.enabled, "only enabled layers are left");
    if (layer.phase == Phase::mie) {
        require(layer.scattering.empty() && layer.extinction.empty(), "coefficients of particles");
        require(layer.particles.wavelengths.size() == channels, "particles at each wavelength");
        require(!layer.particles.kinds.empty(), "at least one kind of spheres");
        for (const SphereKind& kind : layer.particles.kinds) {
            require(kind.number_density.per_cubic_meter > 0, "numbers of spheres above 0");
        }
        return;
    }
    require(layer.scattering.size() == channels, "one scattering coefficient per channel");
    require(layer.extinction.size() == channels, "one extinction coefficient per channel");
    for (std::size_t i = 0; i < channels; ++i) {
        const double scattering = layer.scattering[i].per_meter;
        const double extinction = layer.extinction[i].per_meter;
        require(within(scattering, 0, 1e6), "scattering in range");
        require(within(extinction, scattering, 1e6), "extinction from scattering up");
    }
    require(std::fabs(layer.g) < 1, "g in (-1, 1)");
    if (layer.profile == Profile::exponential) {
        require(within(layer.scale_height.meters, 1e-3, 1e9), "scale height in range");
    }
    if (layer.profile == Profile::tent) {
        require(within(layer.half_width.meters, 1e-3, 1e9), "half width in range");
    }
    if (layer.profile == Profile::slab) {
        require(layer.top_altitude.meters > layer.bottom_altitude.meters, "slab has a thickness");
    }
    if (layer.profile == Profile::tabulated) {
        require(layer.table.size() >= 2, "at least two entries");
        require(layer.table[0].altitude.meters >= 0, "no negative altitude");
        for (std::size_t i = 1; i < layer.table.size(); ++i) {
            require(layer.table[i].altitude.meters > layer.table[i - 1].altitude.meters,
                    "altitudes increase");
        }
        for (const DensityPoint& point : layer.table) {
            require(within(point.density, 0, 1e6), "density in range");
        }
    }
}

inline void check_octaves(const NoiseOctaves& octaves) {
    require(!octaves.frequencies.empty() && octaves.frequencies.size() <= 16, "1 to 16 octaves");
    require(octaves.gains.size() == octaves.frequencies.size(), "one gain per octave");
    for (const auto& frequency : octaves.frequencies) {
        for (const int cells : frequency)
            require(cells >= 1 && cells <= 1048576, "frequency in range");
    }
    double sum = 0;
    for (const double gain : octaves.gains) {
        require(within(gain, 0, 1e10), "gain in range");
        sum += gain;
    }
    require(sum > 0, "octaves weigh something");
}

inline void check_channel(const NoiseChannel& channel) {
    if (channel.type == NoiseType::constant) {
        require(channel.octaves.frequencies.empty(), "a constant has no octaves");
    } else {
        check_octaves(channel.octaves);
    }
    if (channel.type == NoiseType::perlin_worley) check_octaves(channel.worley_octaves);
    require(within(channel.warp_strength, -16, 16), "warp in range");
    if (channel.warp_strength != 0) {
        require(channel.type != NoiseType::constant && channel.type != NoiseType::curl,
                "what is displaced has a place");
        check_octaves(channel.warp_octaves);
    }
    require(within(channel.value, -1e6, 1e6), "value in range");
    for (const double bound : channel.remap) require(within(bound, -1e6, 1e6), "remap in range");
    require(std::fabs(channel.remap[1] - channel.remap[0]) >= 1e-6, "remap has a slope");
    require(within(channel.bias, 0.001, 0.999), "bias in range");
    if (channel.smoothstep) {
        for (const double edge : *channel.smoothstep) {
            require(within(edge, -1e6, 1e6), "smoothstep in range");
        }
        require((*channel.smoothstep)[1] - (*channel.smoothstep)[0] >= 1e-6, "smoothstep rises");
    }
    require(channel.clamp[0] <= channel.clamp[1], "clamp in order");
}

inline void check_noise(const Noise& noise) {
    std::string letters;
    for (const NoiseChannel& channel : noise.channels) {
        letters += channel.name;
        check_channel(channel);
    }
    require(letters == "Y" || letters == "R" || letters == "RGB" || letters == "RGBA",
            "channels of a picture");
    require(noise.pack != NoisePacking::shape || letters == "RGBA", "shape packs R, G, B, A");
    require(noise.pack != NoisePacking::detail || letters == "RGB", "detail packs R, G, B");
    for (const int voxels : noise.size) require(voxels >= 1 && voxels <= 16384, "size in range");
}

template <class T>
const T* find_by_name(const std::vector<T>& things, const std::string& name) {
    for (const T& thing : things) {
        if (thing.name == name) return &thing;
    }
    return nullptr;
}

inline void check_profile(const HeightProfile& profile) {
    require(within(profile.bottom_sharpness, 0, 1e6), "sharpness in range");
    require(within(profile.top_falloff, 0, 1e6), "falloff in range");
    require(within(profile.cloud_type, 0, 1), "cloud type in range");
    require(profile.table.empty() == (profile.type != HeightProfileType::tabulated),
            "a table where the profile is one");
    double before = -1;
    for (const HeightPoint& point : profile.table) {
        require(point.height > before && within(point.height, 0, 1), "heights increase");
        require(within(point.value, -1e6, 1e6), "values in range");
        before = point.height;
    }
}

inline void check_tower(const Tower& tower) {
    for (const double tiles : tower.center) require(within(tiles, -16, 16), "center in range");
    for (const double tiles : tower.sigma) require(within(tiles, 1e-6, 16), "sigma in range");
    require(std::fabs(tower.correlation) <= 0.999999, "correlation in range");
    require(std::isfinite(tower.rotation.radians), "rotation is a number");
    require(within(tower.amplitude, 0, 1e6), "amplitude in range");
}

inline void check_scaled(const Noise& noise, const std::array<int, 3>& scale) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        require(scale[axis] >= 1 && scale[axis] <= 1024, "scale in range");
        if (noise.channels.empty()) continue;
        for (const auto& frequency : noise.channels[0].octaves.frequencies) {
            require(frequency[axis] * scale[axis] <= 1048576, "scaled frequency in range");
        }
    }
}

inline void check_cloud(const Cloud& cloud, const Parameters& parameters) {
    const Noise* noise = find_by_name(parameters.noises, cloud.noise);
    const bool is_of_volume = find_by_name(parameters.volumes, cloud.volume) != nullptr;
    const bool grows = cloud.shape == CloudShape::convection;
    require((noise != nullptr) + is_of_volume + grows == 1, "one thing gives it its shape");
    if (noise) check_scaled(*noise, cloud.noise_scale);
    const Noise* detail = find_by_name(parameters.noises, cloud.detail);
    require(detail != nullptr || cloud.detail.empty(), "its detail is there");
    if (detail) check_scaled(*detail, cloud.detail_scale);
    for (const double strength : cloud.erosion) {
        require(within(strength, 0, detail ? 0.95 : 0), "only a detail erodes");
    }
    for (const Length edge : cloud.extent)
        require(within(edge.meters, 1e-3, 1e8), "extent in range");
    require(within(cloud.base_altitude.meters, -1e8, 1e8), "altitude in range");
    require(within(cloud.coverage, 0, 1) && within(cloud.wisp_height, 0, 1), "shares in range");
    require(within(cloud.threshold, 0, 1e6), "threshold in range");
    require(cloud.edge_softness == 0 || within(cloud.edge_softness, 1e-6, 1e6),
            "softness in range");
    require(!cloud.full_at ||
                (within(*cloud.full_at, 1e-6, 1e6) && cloud.threshold_at == ThresholdAt::bake),
            "full in range, of densities in the file");
    require(within(cloud.extinction_scale.per_meter, 0, 1e6), "extinction in range");
    require(cloud.type_map.file.empty() || cloud.height_profile.type == HeightProfileType::blended,
            "a map of types where types are blended");
    for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
        require(map->file.empty() == map->path.empty(), "a map has a path");
    }
    check_profile(cloud.height_profile);
    for (const Tower& tower : cloud.towers) check_tower(tower);
}

}  // namespace skybake::config::fuzzing
