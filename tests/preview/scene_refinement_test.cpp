// Tests which pixels of a picture have more samples than one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bakers/render/scene_march.h"
#include "tests/preview/scenes.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

CloudMedium clumps(const std::array<double, 3>& extent_m, const std::array<int, 3>& size,
                   double filled, double extinction_per_m) {
    return test::medium_of(extent_m, 800, size, test::clumped_voxels(size, 5, filled),
                           extinction_per_m);
}

SceneFrame frame_of(int width, int height) {
    return test::frame_from({0, 0, 100}, 50, width, height);
}

// Four samples are nearer to a fine march than one, and alike where nothing is thin.
TEST(SceneRefinement, RemovesGrain) {
    const CloudMedium thin = clumps({1000, 1000, 500}, {8, 8, 8}, 0.6, 0.002);
    const SunDirection sun = {40, 80};
    const auto rms_with = [&](Refinement refinement) {
        SceneFrame frame = frame_of(48, 32);
        const auto march = [&](double step_m) {
            return SceneMarch({{&thin, step_m, step_m, 9000}}, sun, true, true, 1)
                .march(frame, 1, nullptr)
                .results;
        };
        frame.refinement = Refinement::all;
        const Image2<float> fine = march(5);
        frame.refinement = refinement;
        const Image2<float> coarse = march(160);
        double sum = 0;
        for (std::size_t i = 6; i < fine.texels.size(); i += 8) {
            const double error = double{coarse.texels[i]} - fine.texels[i];
            sum += error * error;
        }
        return std::sqrt(sum * 8 / static_cast<double>(fine.texels.size()));
    };
    const double one = rms_with(Refinement::none);
    EXPECT_LT(rms_with(Refinement::all), 0.6 * one);
    EXPECT_LT(rms_with(Refinement::thin), 0.65 * one);
    EXPECT_GT(one, 1e-3);
}

// One layer as one sample in each pixel shows it: channels as in MarchedScene.
struct OneSample {
    const Image2<float>& seen;

    double through(int x, int y) const { return seen.texel(x, y)[6]; }
    double sunlight(int x, int y) const { return seen.texel(x, y)[0] + seen.texel(x, y)[1]; }
    // Beside the picture are its outermost pixels.
    std::array<int, 2> within(int x, int y) const {
        return {std::clamp(x, 0, seen.width - 1), std::clamp(y, 0, seen.height - 1)};
    }
    // Along a row or a column a neighbour's transmittance is a 16th away, or the transmittance a 64th from the mean
    // of both neighbours', or the sunlight a 32nd of the greater from theirs.
    bool stands_out(int x, int y, int dx, int dy) const {
        const auto [x0, y0] = within(x - dx, y - dy);
        const auto [x1, y1] = within(x + dx, y + dy);
        const double mean = (sunlight(x0, y0) + sunlight(x1, y1)) / 2;
        return std::fabs(through(x, y) - through(x0, y0)) > 1.0 / 16 ||
               std::fabs(through(x, y) - through(x1, y1)) > 1.0 / 16 ||
               std::fabs(through(x, y) - (through(x0, y0) + through(x1, y1)) / 2) > 1.0 / 64 ||
               std::fabs(sunlight(x, y) - mean) > std::max(sunlight(x, y), mean) / 32;
    }
    bool stands_out(int x, int y) const { return stands_out(x, y, 1, 0) || stands_out(x, y, 0, 1); }
};

// Each pixel has the bits of the picture with one sample everywhere or of that with four. Returns the share
// of pixels that have four.
double refined_share(const CloudMedium& medium) {
    const SceneMarch march({{&medium, 20, 20, 9000}}, {40, 80}, true, true, 1);
    const auto marched = [&](Refinement refinement) {
        SceneFrame frame = frame_of(96, 64);
        frame.refinement = refinement;
        return march.march(frame, 1, nullptr);
    };
    const Image2<float> one = marched(Refinement::none).results;
    const Image2<float> four = marched(Refinement::all).results;
    const MarchedScene thin = marched(Refinement::thin);
    int refined = 0;
    int differences = 0;
    testing::for_each_texel(one.width, one.height, [&](int x, int y) {
        const bool needs = OneSample{one}.stands_out(x, y);
        const float* wanted = (needs ? four : one).texel(x, y);
        EXPECT_TRUE(std::equal(wanted, wanted + one.channels, thin.results.texel(x, y)))
            << x << " " << y;
        refined += needs ? 1 : 0;
        differences += std::equal(wanted, wanted + one.channels, one.texel(x, y)) ? 0 : 1;
    });
    EXPECT_EQ(thin.refined_pixels, refined);
    EXPECT_GT(differences, refined / 2);
    return double(refined) / (one.width * one.height);
}

TEST(SceneRefinement, TakesFourSamplesWhereOneShowsGrainOrEdges) {
    const double share = refined_share(clumps({1800, 1800, 500}, {18, 18, 5}, 0.35, 0.05));
    EXPECT_GT(share, 0.25);
    EXPECT_LT(share, 0.9);
    // A veil without edges, through which nine tenths of the light come, in steps that
    // show hardly any grain.
    EXPECT_LT(refined_share(clumps({1800, 1800, 500}, {1, 1, 1}, 1, 4e-4)), 0.2);
}

// The four samples of a pixel lie within it: their mean is between the least and the most that one sample
// each of 8 by 8 parts of the pixel shows.
TEST(SceneRefinement, SamplesLieWithinTheirPixel) {
    const CloudMedium medium = clumps({1800, 1800, 500}, {18, 18, 5}, 0.35, 0.02);
    const SceneMarch march({{&medium, 4, 20, 9000}}, {40, 80}, false, true, 1);
    constexpr int kParts = 8;
    SceneFrame frame = frame_of(24, 16);
    frame.refinement = Refinement::all;
    const Image2<float> four = march.march(frame, 1, nullptr).results;
    const Image2<float> parts = march.march(frame_of(24 * kParts, 16 * kParts), 1, nullptr).results;
    double widest = 0;
    testing::for_each_texel(four.width, four.height, [&](int x, int y) {
        float least = 1;
        float most = 0;
        for (int k = 0; k < kParts * kParts; ++k) {
            const float through = parts.texel(x * kParts + k % kParts, y * kParts + k / kParts)[6];
            least = std::min(least, through);
            most = std::max(most, through);
        }
        EXPECT_GE(four.texel(x, y)[6], least - 0.01F) << x << " " << y;
        EXPECT_LE(four.texel(x, y)[6], most + 0.01F) << x << " " << y;
        widest = std::max(widest, double{most} - double{least});
    });
    EXPECT_GT(widest, 0.5);
}

}  // namespace
}  // namespace skybake
