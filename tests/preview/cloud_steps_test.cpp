// Steps that grow with the distance, and samples that share their light: laws of homogeneous slabs, and pictures
// beside those of short, equal steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/render/scene_view.h"
#include "tests/preview/scenes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using namespace test;

// The optical depth of a homogeneous slab is its own, but for one step at either of its faces.
TEST(CloudSteps, ASlabLetsThroughWhatBeerSaysAtAnyGrowth) {
    SceneFrame frame = frame_from({0, 0, 100}, 60, 16, 16);
    const CameraRays rays(frame.camera, frame.width, frame.height);
    for (const auto& [sigma, growth] : {std::pair{2e-4, 0.0},
                                        {2e-4, 0.1},
                                        {2e-4, 1.0},
                                        {2e-4, 6.0},
                                        {2e-5, 0.0},
                                        {5e-3, 0.0},
                                        {5e-3, 1.0}}) {
        const CloudMedium slab = medium_of({1000, 1000, 600}, 500, {8, 8, 6},
                                           std::vector<float>(8 * 8 * 6, 1.0F), sigma);
        frame.step_growth = growth;
        const Image2<float> seen = SceneMarch({{&slab, 2, 20, 30000}}, {40, 70}, false, true, 1)
                                       .march(frame, 1, nullptr)
                                       .results;
        double mean = 0;
        double least_steps = 1e9;
        testing::for_each_texel(frame.width, frame.height, [&](int x, int y) {
            const double z = rays.through(x, y).z;
            const double far_m = 1000 / z;
            const double step_m = std::sqrt(4 + 8 * growth * rays.pixel() * far_m);
            const double depth = sigma * 600 / z;
            const double made = -std::log(double{seen.texel(x, y)[6]});
            EXPECT_NEAR(made, depth, sigma * step_m + 1e-4) << sigma << " " << growth << " " << z;
            mean += (made / depth - 1) / (frame.width * frame.height);
            least_steps = std::min(least_steps, 600 / z / step_m);
        });
        EXPECT_NEAR(mean, 0, 0.1 / least_steps) << growth;  // jitter leaves no bias
        EXPECT_GT(least_steps, 5);
    }
}

// Marches towards the sun whose steps grow add up the whole way through a homogeneous slab, as equal steps do.
TEST(CloudSteps, GrowingStepsTowardsTheSunMissNothingOfASlab) {
    const CloudMedium slab = medium_of({1000, 1000, 600}, 500, {20, 20, 12},
                                       std::vector<float>(20 * 20 * 12, 1.0F), 2e-3);
    const SceneFrame frame = frame_from({0, 0, 100}, 60, 16, 16);
    for (const double elevation : {70.0, 40.0}) {
        const auto light_with = [&](int growth) {
            const Image2<float> seen =
                SceneMarch({{&slab, 10, 10, 30000, growth}}, {elevation, 70}, true, true, 1)
                    .march(frame, 1, nullptr)
                    .results;
            double sum = 0;
            for (std::size_t i = 0; i < seen.texels.size(); i += 8) {
                sum += double{seen.texels[i]} + seen.texels[i + 1];
            }
            return sum;
        };
        const double equal = light_with(1);
        EXPECT_GT(equal, 0);
        EXPECT_NEAR(light_with(kLightGrowth) / equal, 1, 0.02) << elevation;
    }
}

// A field without edges, of cells of 1.2 km, in a layer 600 m high. Its voxels are as thin as those of altocumulus.
CloudMedium rolling_layer() {
    constexpr std::array<int, 3> kSize = {64, 64, 16};
    std::vector<float> voxels;
    const auto wave = [](double turns) { return std::sin(2 * M_PI * turns); };
    testing::for_each_voxel(kSize, [&](int x, int y, int z) {
        const double u = (x + 0.5) / kSize[0];
        const double v = (y + 0.5) / kSize[1];
        const double height = (z + 0.5) / kSize[2];
        const double field = wave(2 * u + 0.2 * wave(v)) * wave(2 * v + 0.3 * wave(3 * u)) +
                             0.3 * wave(7 * u + height) * wave(6 * v - height);
        voxels.push_back(
            static_cast<float>(std::max(field * (1 - std::fabs(2 * height - 1)), 0.0)));
    });
    CloudMedium medium = medium_of({2400, 2400, 600}, 1500, kSize, voxels, 0.0065);
    medium.variation = varied_tiles(medium);
    return medium;
}

// Where light was solved for, marches towards the sun end soon, and the depth from there is looked up: the light
// is that of whole marches.
TEST(CloudSteps, SolvedDepthsGoOnWhereNearMarchesEnd) {
    CloudMedium layer = rolling_layer();
    layer.variation = {};
    const BakeOptions options{.threads = 2};
    const cloud_light::MarchLight within(layer, cloud_light::kCellsOfPicture, options);
    const SceneFrame frame = frame_from({0, 0, 100}, 60, 32, 32);
    for (const SunDirection& sun : {SunDirection{70, 70}, SunDirection{25, 160}}) {
        const auto solved = within.under(sun, options);
        ASSERT_TRUE(solved);
        const auto seen_with = [&](int growth) {
            return SceneMarch({{&layer, 20, 20, 30000, growth, &*solved}}, sun, true, true, 1)
                .march(frame, 1, nullptr)
                .results;
        };
        const Image2<float> whole = seen_with(1);
        const Image2<float> near = seen_with(kLightGrowth);
        double squares = 0;
        double sum = 0;
        for (std::size_t i = 0; i < whole.texels.size(); i += 8) {
            const double light = double{whole.texels[i]} + whole.texels[i + 1];
            squares += std::pow(double{near.texels[i]} + near.texels[i + 1] - light, 2);
            sum += light;
        }
        const double pixels = 32.0 * 32;
        EXPECT_LT(std::sqrt(squares / pixels), 0.02 * sum / pixels) << sun.elevation_degrees;
    }
}

// Bytes of a screen: white is 1 / exposure.
std::vector<double> shown(const Image2<float>& radiance, double exposure) {
    std::vector<double> bytes;
    for (const float value : radiance.texels) {
        const double light = 1 - std::exp(-exposure * double{value});
        bytes.push_back(
            255 * (light < 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055));
    }
    return bytes;
}

struct NamedPicture {
    Image2<float> radiance;
    std::int64_t fetches = 0;
};
// From below, under a sun at the side, of pixels as wide as those of 720 across 50 degrees.
NamedPicture picture_with(const CloudMedium& layer, const MarchSteps& steps, double growth,
                          int light_growth = 1) {
    SceneFrame frame = frame_from({300, 100, 200}, 9, 96, 64);
    frame.camera.horizontal_field_degrees = 6.7;
    frame.refinement = Refinement::all;
    frame.step_growth = growth;
    const SunDirection sun = {25, 150};
    SceneRenderer renderer({{&layer, steps.step_m, steps.light_step_m, 40000, light_growth}},
                           {earth().medium, earth().tables}, sun, 1);
    const CloudView view = renderer.render(frame, 1);
    return {view.radiance, view.fetches.samples + view.fetches.light_samples};
}

// The steps of pictures beside equal steps of half a voxel's edge, in 255ths of white; and steps that are far
// too long, which the same bound refuses.
TEST(CloudSteps, PicturesAreThoseOfShortEqualSteps) {
    const CloudMedium layer = rolling_layer();
    const SunDirection sun = {25, 150};
    MarchSteps fine = usual_steps(layer, sun);
    fine.step_m /= 2;
    fine.light_step_m /= 2;
    const NamedPicture reference = picture_with(layer, fine, 0);
    double brightest = 0;
    for (const float value : reference.radiance.texels) {
        brightest = std::max(brightest, double{value});
    }
    const double exposure = 1.5 / brightest;
    const std::vector<double> wanted = shown(reference.radiance, exposure);
    const MarchSteps steps = picture_steps(layer, sun);
    const NamedPicture made = picture_with(layer, steps, kStepGrowth, kLightGrowth);
    EXPECT_LT(rms_difference(shown(made.radiance, exposure), wanted), 1);
    EXPECT_LT(5 * made.fetches, reference.fetches);
    MarchSteps coarse = steps;
    coarse.step_m *= 6;
    const NamedPicture too_coarse = picture_with(layer, coarse, kStepGrowth, kLightGrowth);
    EXPECT_GT(rms_difference(shown(too_coarse.radiance, exposure), wanted), 1);
}

}  // namespace
}  // namespace skybake
