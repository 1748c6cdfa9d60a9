// Noises for tests, and their voxels: as the specification and as the kernels make them.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_plan.h"
#include "config/sections/noise.h"
#include "tests/noise/noise_specification.h"
#include "tests/support/comparisons.h"
#include "tests/support/volumes.h"

namespace skybake::test {

using Frequency = std::array<int, 3>;

// Octaves of these frequencies, each of half the weight of the one before.
inline config::NoiseOctaves octaves_of(const std::vector<Frequency>& frequencies) {
    config::NoiseOctaves octaves;
    for (const Frequency& frequency : frequencies) {
        octaves.gains.push_back(octaves.gains.empty() ? 1 : octaves.gains.back() / 2);
        octaves.frequencies.push_back(frequency);
    }
    return octaves;
}

inline config::NoiseChannel channel_of(config::NoiseType type,
                                       const std::vector<Frequency>& frequencies) {
    config::NoiseChannel channel;
    channel.name = "Y";
    channel.type = type;
    channel.octaves = octaves_of(frequencies);
    if (type == config::NoiseType::perlin_worley) channel.worley_octaves = channel.octaves;
    return channel;
}

inline config::NoiseChannel perlin(const std::vector<Frequency>& frequencies,
                                   config::NoiseFractal fractal = config::NoiseFractal::fbm) {
    config::NoiseChannel channel = channel_of(config::NoiseType::perlin, frequencies);
    channel.fractal = fractal;
    return channel;
}

inline config::NoiseChannel worley(const std::vector<Frequency>& frequencies,
                                   config::WorleyFeature feature = config::WorleyFeature::f1,
                                   config::WorleyValue value_form = config::WorleyValue::distance) {
    config::NoiseChannel channel = channel_of(config::NoiseType::worley, frequencies);
    channel.feature = feature;
    channel.value_form = value_form;
    return channel;
}

inline config::NoiseChannel curl(const std::vector<Frequency>& frequencies,
                                 config::CurlComponent component) {
    config::NoiseChannel channel = channel_of(config::NoiseType::curl, frequencies);
    channel.component = component;
    return channel;
}

inline config::Noise noise_of(std::vector<config::NoiseChannel> channels, std::uint64_t seed = 7) {
    config::Noise noise;
    noise.name = "n";
    noise.seed = seed;
    noise.channels = std::move(channels);
    return noise;
}

// The same with channels that are named as those of pictures.
inline config::Noise picture_of(std::vector<config::NoiseChannel> channels) {
    config::Noise noise = noise_of(std::move(channels));
    const auto names = testing::channel_names(static_cast<int>(noise.channels.size()));
    for (std::size_t c = 0; c < names.size(); ++c) noise.channels[c].name = names[c];
    return noise;
}

// Noises that have all kinds of channels between them.
inline std::vector<config::Noise> noises_of_all_kinds(const std::vector<Frequency>& frequencies,
                                                      std::uint64_t seed = 7) {
    using config::WorleyFeature;
    using config::WorleyValue;
    return {noise_of({perlin(frequencies), perlin(frequencies, config::NoiseFractal::ridged),
                      channel_of(config::NoiseType::perlin_worley, frequencies),
                      curl(frequencies, config::CurlComponent::x)},
                     seed),
            noise_of({worley(frequencies),
                      worley(frequencies, WorleyFeature::f2, WorleyValue::one_minus_distance),
                      worley(frequencies, WorleyFeature::f2_minus_f1,
                             WorleyValue::one_minus_distance_squared),
                      curl(frequencies, config::CurlComponent::y)},
                     seed)};
}

// A channel that is displaced, by two octaves of curl noise unless something else is given.
inline config::NoiseChannel displaced(config::NoiseChannel channel, double strength,
                                      config::NoiseWarp by = config::NoiseWarp::curl) {
    channel.warp_strength = strength;
    channel.warp_by = by;
    channel.warp_octaves = octaves_of({{3, 2, 4}, {6, 5, 7}});
    return channel;
}

inline config::NoiseChannel alligator(const std::vector<Frequency>& frequencies) {
    return channel_of(config::NoiseType::alligator, frequencies);
}

// The place of a voxel in the tile, of any integer, as the reference takes it.
inline std::array<double, 3> place_of(const std::array<noise::TileAxis, 3>& axes,
                                      const noise::Voxel& voxel) {
    std::array<double, 3> place;
    for (std::size_t i = 0; i < 3; ++i) {
        place[i] = static_cast<double>(2 * voxel[i] + axes[i].offset) / (2.0 * axes[i].size);
    }
    return place;
}

using Planes = std::vector<std::vector<float>>;  // [channel][voxel], x fastest

// Voxels of a box as `at` finds them one by one.
template <class At>
Planes one_by_one(int channels, const VoxelBox& box, const At& at) {
    Planes planes(static_cast<std::size_t>(channels));
    testing::for_each_voxel(box.size, [&](int x, int y, int z) {
        const std::vector<float> values =
            at(noise::Voxel{box.origin[0] + x, box.origin[1] + y, box.origin[2] + z});
        for (std::size_t c = 0; c < planes.size(); ++c) planes[c].push_back(values[c]);
    });
    return planes;
}

inline Planes specified(const noise::NoisePlan& plan, const VoxelBox& box) {
    return one_by_one(plan.output_channels(), box,
                      [&](const noise::Voxel& voxel) { return noise_at(plan, voxel); });
}

// The value beyond a box's end, which must not be overwritten.
inline constexpr float kCanary = -12345.0f;
inline constexpr std::size_t kCanaries = 64;

// Fills as the kernels do. The last kCanaries of each channel lie beyond the box.
inline Planes filled_with_canaries(const VoxelSource& source, const VoxelBox& box, int channels) {
    const std::size_t count = static_cast<std::size_t>(box.count()) + kCanaries;
    Planes planes(static_cast<std::size_t>(channels), std::vector<float>(count, kCanary));
    std::vector<float*> targets;
    for (auto& plane : planes) targets.push_back(plane.data());
    source.fill(box, targets);
    return planes;
}

inline Planes filled(const VoxelSource& source, const VoxelBox& box, int channels) {
    Planes planes = filled_with_canaries(source, box, channels);
    for (auto& plane : planes) plane.resize(static_cast<std::size_t>(box.count()));
    return planes;
}

inline Planes whole(const noise::NoisePlan& plan) {
    const VoxelBox all{{}, {plan.axes[0].size, plan.axes[1].size, plan.axes[2].size}};
    return filled(noise::NoiseField(plan), all, plan.output_channels());
}

inline Planes whole(const config::Noise& noise, const std::array<int, 3>& size) {
    return whole(noise::make_noise_plan(noise, size));
}

// How many floats lie from one to the other.
inline std::int64_t ulps_between(float a, float b) {
    const auto ordered = [](float value) {
        const auto bits = std::bit_cast<std::int32_t>(value);
        return bits >= 0 ? std::int64_t{bits} : std::int64_t{INT32_MIN} - bits;
    };
    return std::abs(ordered(a) - ordered(b));
}

}  // namespace skybake::test
