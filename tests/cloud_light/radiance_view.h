// Pictures of a layer of clouds from outside: marched with the lookups that are published for runtimes,
// and by paths of light.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/field/interpolation.h"
#include "bakers/occupancy/cell_grid.h"
#include "tests/support/loops.h"

namespace skybake::test {

struct LightTextures {
    std::array<int, 3> depth_size{};
    std::vector<float> depth;  // to the sun
    std::array<int, 3> size{};
    std::vector<std::vector<float>> of_sun;  // coefficients of sun_radiance
    std::vector<std::vector<float>> of_sky;  // and of sky_radiance
    std::vector<std::vector<float>> of_ground;
    std::vector<float> forward;  // factors of forward_scattering, if there are any
};

// The default of asset = "forward_scattering".
inline constexpr std::array<int, 3> kForwardSize = {128, 64, 1};
inline std::vector<float> forward_texels(const cloud_light::CloudScattering& scattering,
                                         int degree) {
    const forward_scattering::SmallAngles light(scattering, degree);
    const Image2<double> texels = bake_texels(forward_scattering::forward_model(light), 0,
                                              {kForwardSize[0], kForwardSize[1]}, {});
    return {texels.texels.begin(), texels.texels.end()};
}

using VoxelTaps = std::array<VoxelTap, 8>;

inline double looked_up(const std::vector<float>& texels, const VoxelTaps& taps,
                        const std::array<int, 3>& size) {
    double sum = 0;
    for (const VoxelTap& tap : taps) {
        sum += tap.weight *
               double{texels[occupancy::index_of(size, tap.voxel[0], tap.voxel[1], tap.voxel[2])]};
    }
    return sum;
}

// The factor of light that is scattered once: examples/lookups/forward_scattering.glsl.
inline double forward_factor(const LightTextures& textures, double offset, double depth) {
    if (textures.forward.empty()) return 1;
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const std::array<double, 3> uvw = {
        texture_coordinate(kConvention, std::sqrt(std::sqrt(offset / 2)), kForwardSize[0]),
        texture_coordinate(kConvention, forward_scattering::depth_coordinate(depth),
                           kForwardSize[1]),
        0.5};
    return looked_up(textures.forward, trilinear_taps(kForwardSize, uvw, {false, false, false}),
                     kForwardSize);
}

// The light of a march from a face of the layer, in steps of at most `step` voxels: that of
// examples/lookups/cloud_light.glsl. `passed` is the share of the background that is seen.
inline double marched(const cloud_light::CloudLayer& layer, const LightTextures& textures,
                      const cloud_light::CloudScattering& scattering,
                      const cloud_light::LayerSources& sources, int degree, const glm::dvec3& place,
                      const glm::dvec3& look, double step, double& passed) {
    const double share = cloud_light::scaled(scattering, degree).extinction_share;
    const double nu = glm::dot(look, sources.sun_direction);
    const double phase = cloud_light::phase_value(scattering, 1 - nu, 1 + nu);
    const Harmonics values = harmonics(-look);
    const glm::dvec3 along = cloud_light::in_voxels(layer, look);
    const double length = (look.z > 0 ? layer.size[2] - place.z : -place.z) / along.z;
    const int steps =
        static_cast<int>(std::ceil(length * std::fmax(glm::length(along), 1e-9) / step));
    double light = 0;
    passed = 1;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 at = place + along * (length * (i + 0.5) / steps);
        const double depth = share * cloud_light::extinction_at(layer, at) * length / steps;
        if (depth == 0) continue;
        std::array<double, 3> uvw{};
        for (std::size_t a = 0; a < 3; ++a) uvw[a] = at[a] / layer.size[a];
        const std::array<bool, 3> repeats = {true, true, false};
        const VoxelTaps taps = trilinear_taps(textures.size, uvw, repeats);
        const double sun_depth = looked_up(
            textures.depth, trilinear_taps(textures.depth_size, uvw, repeats), textures.depth_size);
        double in = sources.sun * scattering.albedo * phase / share * std::exp(-share * sun_depth) *
                    forward_factor(textures, 1 - nu, sun_depth);
        for (std::size_t c = 0; c < textures.of_sun.size(); ++c) {
            in += sources.sun * values[c] * looked_up(textures.of_sun[c], taps, textures.size);
        }
        for (std::size_t c = 0; c < textures.of_sky.size(); ++c) {
            in += sources.sky * values[c] * looked_up(textures.of_sky[c], taps, textures.size);
        }
        for (std::size_t c = 0; c < textures.of_ground.size(); ++c) {
            in +=
                sources.ground * values[c] * looked_up(textures.of_ground[c], taps, textures.size);
        }
        light += passed * (1 - std::exp(-depth)) * in;
        passed *= std::exp(-depth);
    }
    if (look.z < 0) return light + passed * sources.ground;
    return light + passed * sources.sky * (sources.sky_shape ? sources.sky_shape(look) : 1);
}

// The textures of a slab that the sun or, where there is none, the sky lights.
inline LightTextures textures_of(const cloud_light::CloudLayer& layer,
                                 const cloud_light::SolvedRadiance& solved,
                                 const cloud_light::LayerSources& sources) {
    const double towards_sun = sources.sun > 0 ? layer.voxel_m[2] / sources.sun_direction.z : 0;
    LightTextures textures;
    textures.size = textures.depth_size = layer.size;
    testing::for_each_voxel(layer.size, [&](int, int, int z) {
        textures.depth.push_back(static_cast<float>(layer.optics.extinction_per_m * towards_sun *
                                                    (layer.size[2] - z - 0.5)));
    });
    auto& lit = sources.sun > 0 ? textures.of_sun : textures.of_sky;
    for (std::size_t c = 0; c < solved.scattered.count(); ++c) {
        lit.push_back(cloud_light::values_of(solved.scattered, c));
    }
    return textures;
}

// Solves for the light of a slab and marches it from outside, as a runtime does.
inline double marched_from_outside(const cloud_light::CloudLayer& layer,
                                   const cloud_light::CloudScattering& scattering,
                                   const cloud_light::LayerSources& sources,
                                   const glm::dvec3& look) {
    using namespace cloud_light;
    LayerSources of_strength_1 = sources;
    if (sources.sun > 0) of_strength_1.sun = 1;
    const SolvedRadiance solved =
        solve_radiance(layer, place_grid(layer.size, 1, false), scattering, kMostDegree,
                       of_strength_1, {.threads = 2});
    EXPECT_LE(solved.change, kLargestChange);
    double passed = 1;
    return marched(layer, textures_of(layer, solved, sources), scattering, sources, kMostDegree,
                   {1, 1, look.z < 0 ? layer.size[2] : 0}, look, 0.5, passed);
}

}  // namespace skybake::test
