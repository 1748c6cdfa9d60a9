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
        require(within(scattering, 0, extinction), "extinction from scattering up");
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
    }
}

inline void check_octaves(const NoiseOctaves& octaves) {
    require(!octaves.frequencies.empty() && octaves.frequencies.size() <= 16, "1 to 16 octaves");
    require(octaves.gains.size() == octaves.frequencies.size(), "one gain per octave");
    double sum = 0;
    for (const double gain : octaves.gains) {
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
    if (channel.warp_strength != 0) {
        require(channel.type != NoiseType::constant && channel.type != NoiseType::curl,
                "what is displaced has a place");
        check_octaves(channel.warp_octaves);
    }
    require(std::fabs(channel.remap[1] - channel.remap[0]) >= 1e-6, "remap has a slope");
    if (channel.smoothstep) {
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
}

template <class T>
const T* find_by_name(const std::vector<T>& things, const std::string& name) {
    for (const T& thing : things) {
        if (thing.name == name) return &thing;
    }
    return nullptr;
}

inline void check_profile(const HeightProfile& profile) {
    require(profile.table.empty() == (profile.type != HeightProfileType::tabulated),
            "a table where the profile is one");
    double before = -1;
    for (const HeightPoint& point : profile.table) {
        require(point.height > before, "heights increase");
        before = point.height;
    }
}

inline void check_scaled(const Noise& noise, const std::array<int, 3>& scale) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
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
        require(strength == 0 || detail != nullptr, "only a detail erodes");
    }
    require(!cloud.full_at || cloud.threshold_at == ThresholdAt::bake,
            "full from a density in the file on");
    require(cloud.type_map.file.empty() || cloud.height_profile.type == HeightProfileType::blended,
            "a map of types where types are blended");
    for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
        require(map->file.empty() == map->path.empty(), "a map has a path");
    }
    check_profile(cloud.height_profile);
}

}  // namespace skybake::config::fuzzing
