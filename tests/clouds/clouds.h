// Clouds for tests, and random ones.
#pragma once

#include <rapidcheck.h>

#include <numeric>
#include <optional>

#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_plan.h"
#include "bakers/clouds/tower_field.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "tests/clouds/cloud_specification.h"
#include "tests/noise/noises.h"
#include "tests/support/any_values.h"

namespace skybake::test {

// A cloud with what it is made of.
struct CloudCase {
    config::Cloud cloud;
    config::Noise base;
    std::optional<config::Noise> detail;
    cloud::CloudMaps maps;
    std::array<int, 3> size{};

    const config::Noise* detail_noise() const { return detail ? &*detail : nullptr; }
    cloud::CloudPlan plan() const {
        return cloud::make_cloud_plan(cloud, base, detail_noise(), size, maps);
    }
};

// A kilometre each way, full from base to top, thresholded at 0.3 with a soft edge.
inline config::Cloud plain_cloud() {
    config::Cloud cloud;
    cloud.name = "c";
    cloud.noise = "n";
    cloud.extent = {{{1000}, {1000}, {1000}}};
    cloud.height_profile.type = config::HeightProfileType::tabulated;
    cloud.height_profile.table = {{0, 1}};
    cloud.threshold = 0.3;
    cloud.edge_softness = 0.1;
    return cloud;
}

inline CloudCase plain_case(const std::array<int, 3>& size) {
    return {plain_cloud(), noise_of({perlin({{4, 4, 4}, {8, 8, 8}})}), {}, {}, size};
}

inline config::Tower tower(double x, double y, double sigma_x, double sigma_y, double amplitude) {
    config::Tower result;
    result.center = {x, y};
    result.sigma = {sigma_x, sigma_y};
    result.amplitude = amplitude;
    return result;
}

// The voxels of the first channel.
inline std::vector<float> densities_of(const CloudCase& any) {
    const cloud::CloudField field(any.plan());
    return filled(field, {{}, any.size}, field.plan().channels)[0];
}

// Voxels of a box as the specification makes them.
inline Planes specified(const cloud::CloudPlan& plan, const VoxelBox& box) {
    return one_by_one(plan.channels, box,
                      [&](const noise::Voxel& voxel) { return cloud_at(plan, voxel); });
}

// The mean of a field of towers over a grid of places. For smooth periodic functions such means are as
// exact as the function itself, where the grid is fine enough.
inline double mean_over_tile(const cloud::TowerField& field, int rows, int columns) {
    std::vector<double> x;
    for (int i = 0; i < columns; ++i) x.push_back((i + 0.5) / columns);
    double sum = 0;
    for (int j = 0; j < rows; ++j) {
        std::vector<double> row(x.size(), 0.0);
        field.add_row((j + 0.5) / rows, x, row.data());
        sum += std::accumulate(row.begin(), row.end(), 0.0);
    }
    return sum / rows / columns;
}

// A picture of 4 x 3 pixels.
inline cloud::MapLookup small_map(config::MapWrap wrap, config::MapFilter filter) {
    return cloud::MapLookup({4, 3, {0, 1, 0, 0.25f, 1, 0.5f, 0, 0, 0, 0, 0.75f, 1}, ""}, wrap,
                            filter);
}

template <class Choice>
Choice any_choice(int count) {
    return static_cast<Choice>(*rc::gen::inRange(0, count));
}

inline config::Tower any_tower() {
    config::Tower result = tower(any_number(-1, 2), any_number(-1, 2), 0, 0, any_number(0, 2));
    for (double& sigma : result.sigma) {
        sigma = *rc::gen::element(0.0001, 0.003, 0.02, 0.1, 0.4, 1.5, 6.0);
    }
    result.rotation.radians = any_number(-7, 7);
    result.correlation = any_number(-0.99, 0.99);
    return result;
}

inline config::Noise any_cloud_noise() {
    using config::NoiseType;
    const Frequency low = {*rc::gen::inRange(1, 5), *rc::gen::inRange(1, 5),
                           *rc::gen::inRange(1, 4)};
    const Frequency high = {2 * low[0], 2 * low[1], 2 * low[2]};
    config::Noise noise = noise_of({}, *rc::gen::arbitrary<std::uint64_t>());
    noise.pack = *rc::gen::element(config::NoisePacking::none, config::NoisePacking::none,
                                   config::NoisePacking::shape);
    const int channels = noise.pack == config::NoisePacking::shape ? 4 : *rc::gen::element(1, 3, 4);
    for (int i = 0; i < channels; ++i) {
        config::NoiseChannel channel = channel_of(any_choice<NoiseType>(5), {low, high});
        channel.value = any_number(0, 1.5);
        channel.fractal = any_choice<config::NoiseFractal>(4);
        channel.feature = any_choice<config::WorleyFeature>(3);
        channel.value_form = any_choice<config::WorleyValue>(4);
        if (*rc::gen::inRange(0, 4) == 0) channel.remap = {0.2, 0.9, -0.1, 1.2};
        if (*rc::gen::inRange(0, 4) == 0) {
            const double from = any_number(0, 1);
            channel.smoothstep = {from, from + *rc::gen::element(0.1, 1.0)};
        }
        if (*rc::gen::inRange(0, 4) == 0) channel.clamp = {0.1, any_number(0.2, 1)};
        noise.channels.push_back(channel);
    }
    return noise;
}

inline config::HeightProfile any_profile() {
    config::HeightProfile profile;
    profile.type = any_choice<config::HeightProfileType>(6);
    profile.bottom_sharpness = *rc::gen::element(1e-9, 0.1, 50.0, 1e4);
    profile.top_falloff = *rc::gen::element(0.0, 4.0, 100.0);
    profile.cloud_type = any_number(0, 1);
    profile.table = {{0, -0.8}, {0.1, 0}, {0.3, 1.2}, {0.8, 0.4}, {1, -0.2}};
    return profile;
}

inline void let_live(config::TowerLife& tower) {
    tower.life = {any_number(0.01, 0.6), any_number(0, 0.2), any_number(0.01, 0.2)};
    tower.grows_from = *rc::gen::element(0.0, 0.4, 1.0);
}

// Makes towers live and drift, and sets the time of the cloud.
inline void let_live(config::Cloud& cloud) {
    cloud.period = *rc::gen::inRange(1, 100);
    cloud.time = *rc::gen::inRange(-200, 200);
    cloud.drift = {any_number(-2, 2), any_number(-2, 2)};
    for (config::Tower& tower : cloud.towers) {
        let_live(tower);
        tower.born = any_number(0, 1);
    }
}

inline CloudCase any_cloud() {
    CloudCase any;
    config::Cloud& cloud = any.cloud = plain_cloud();
    cloud.height_profile = any_profile();
    cloud.coverage = *rc::gen::element(1.0, 1.0, 0.5, 0.0);
    cloud.noise_scale = {*rc::gen::inRange(1, 4), 1, *rc::gen::inRange(1, 3)};
    cloud.detail_scale = {2, 2, 1};
    cloud.erosion = {any_number(0, 0.95), any_number(0, 0.95)};
    cloud.wisp_height = *rc::gen::element(0.0, 0.1, 1.0);
    cloud.threshold = *rc::gen::element(0.0, 0.1, 0.35, 1.0);
    cloud.edge_softness = *rc::gen::element(0.0, 1e-6, 0.05, 1.0);
    cloud.threshold_at = any_choice<config::ThresholdAt>(2);
    const bool is_full = *rc::gen::inRange(0, 3) == 0;
    if (is_full && cloud.threshold_at == config::ThresholdAt::bake) {
        cloud.full_at = *rc::gen::element(0.01, 0.2, 0.9, 3.0);
    }
    if (cloud.threshold_at == config::ThresholdAt::bake) {
        cloud.water = any_choice<config::CloudWater>(2);
    }
    if (*rc::gen::arbitrary<bool>()) cloud.streaks = {any_number(0, 4000)};
    cloud.channels = any_choice<config::CloudChannels>(2);
    const int towers = *rc::gen::inRange(0, 4);
    for (int i = 0; i < towers; ++i) cloud.towers.push_back(any_tower());
    if (*rc::gen::inRange(0, 3) == 0) let_live(cloud);
    any.base = any_cloud_noise();
    if (*rc::gen::arbitrary<bool>()) any.detail = any_cloud_noise();
    const auto wrap = any_choice<config::MapWrap>(2);
    const auto filter = any_choice<config::MapFilter>(2);
    if (*rc::gen::inRange(0, 3) == 0) any.maps.coverage = small_map(wrap, filter);
    if (*rc::gen::inRange(0, 3) == 0) any.maps.type = small_map(wrap, filter);
    any.size = {*rc::gen::inRange(1, 80), *rc::gen::inRange(1, 40), *rc::gen::inRange(1, 24)};
    return any;
}

}  // namespace skybake::test
