// The grain of clouds of few voxels, such as those of drafts: how much neighbouring pixels differ by nothing
// but the jitter of their samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/render/cloud_camera.h"
#include "tests/preview/clouds.h"
#include "tests/support/cloud_marches.h"
#include "tests/support/scene_reference.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

constexpr std::array<int, 3> kSize = {16, 16, 10};
constexpr double kVoxel_m = 75;
constexpr int kWidth = 40;
constexpr int kHeight = 28;

// Three balls that grow into each other and have edges of a voxel, whose voxels have optical depths of 4.5, as
// those of drafts have.
CloudMedium draft_cloud() {
    constexpr std::array<std::array<double, 4>, 3> balls = {
        {{6.2, 7.1, 4.4, 3.1}, {10.3, 8.7, 3.9, 2.6}, {8.1, 9.2, 6.6, 2.2}}};
    std::vector<float> voxels;
    testing::for_each_voxel(kSize, [&](int x, int y, int z) {
        double density = 0;
        for (const auto& [at_x, at_y, at_z, radius] : balls) {
            const double distance = std::hypot(x + 0.5 - at_x, y + 0.5 - at_y, z + 0.5 - at_z);
            density = std::max(density, std::clamp(radius - distance, 0.0, 1.0));
        }
        voxels.push_back(static_cast<float>(density));
    });
    return test::medium_of({kSize[0] * kVoxel_m, kSize[1] * kVoxel_m, kSize[2] * kVoxel_m}, 1000,
                           kSize, voxels, 0.06);
}

MarchSettings settings_under(const CloudMedium& medium, const SunDirection& sun) {
    const MarchSteps steps = usual_steps(medium, sun);
    MarchSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.camera = {{-60, 60, 1050}, 45, 12, 60};
    settings.sun = sun;
    settings.step_m = steps.step_m;
    settings.light_step_m = steps.light_step_m;
    settings.reach_m = 1500;
    return settings;
}

// Sunlight that the cloud scatters to each pixel, along the ray through its middle: by sums of 768 midpoints, and
// of 192 towards the sun, without jitter.
Image2<double> in_short_steps(const CloudMedium& medium, const MarchSettings& settings) {
    const CameraRays rays(settings.camera, kWidth, kHeight);
    Image2<double> sunlight(kWidth, kHeight, 1);
    testing::for_each_texel(kWidth, kHeight, [&](int x, int y) {
        const ReferenceLayer ray = reference_scene({settings.layer(medium)}, settings.sun,
                                                   settings.camera, rays.through(x, y), 768)
                                       .layers[0];
        *sunlight.texel(x, y) = ray.sun_at_base + ray.sun_at_top;
    });
    return sunlight;
}

// The RMS of a picture, and of what is left of it without the mean of the three by three pixels about each.
struct Energy {
    double all = 0;
    double grain = 0;
};
Energy energy_of(const Image2<double>& picture) {
    Energy energy;
    double pixels = 0;
    for (int y = 1; y + 1 < picture.height; ++y) {
        for (int x = 1; x + 1 < picture.width; ++x) {
            double mean = 0;
            for (int k = 0; k < 9; ++k) mean += *picture.texel(x + k % 3 - 1, y + k / 3 - 1) / 9;
            const double here = *picture.texel(x, y);
            energy.all += here * here;
            energy.grain += (here - mean) * (here - mean);
            ++pixels;
        }
    }
    return {std::sqrt(energy.all / pixels), std::sqrt(energy.grain / pixels)};
}

// The error and the grain that the march adds to a cloud's light under a sun, as shares of the light.
TEST(CloudGrain, IsSmallInCloudsOfFewVoxels) {
    const CloudMedium medium = draft_cloud();
    for (const SunDirection sun : {SunDirection{60, 105}, {20, 105}, {6, 105}}) {
        const MarchSettings settings = settings_under(medium, sun);
        const Image2<double> fine = in_short_steps(medium, settings);
        const Image2<float> marched = march_view(medium, settings, 1).results;
        Image2<double> difference(kWidth, kHeight, 1);
        testing::for_each_texel(kWidth, kHeight, [&](int x, int y) {
            const float* seen = marched.texel(x, y);
            *difference.texel(x, y) = double{seen[0]} + seen[1] - *fine.texel(x, y);
        });
        const Energy error = energy_of(difference);
        const double light = energy_of(fine).all;
        EXPECT_LT(error.grain / light, 0.03) << sun.elevation_degrees;
        EXPECT_LT(error.all / light, 0.05) << sun.elevation_degrees;
    }
}

}  // namespace
}  // namespace skybake
