// The published curve beside that of the program's pictures (bakers/render/tone_curve.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "bakers/render/tone_curve.h"
#include "tests/lookups/gpu.h"
#include "tests/support/loops.h"

namespace skybake {
namespace gpu::film_lookups {
#include "lookups/film.glsl.h"
}  // namespace gpu::film_lookups

namespace {

using gpu::vec3;

constexpr int kEdge = 32;

// Means of bytes, over the thresholds of many pixels.
std::array<double, 3> bytes_shown(const vec3& light) {
    Image2<float> field(kEdge, kEdge, 3);
    testing::for_each_texel(kEdge, kEdge,
                            [&](int x, int y) { std::copy_n(&light.x, 3, field.texel(x, y)); });
    const Picture picture = tone_mapped(field, 1, ToneCurve::film);
    std::array<double, 3> means{};
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) means[i % 3] += picture.rgb[i];
    for (double& mean : means) mean /= kEdge * kEdge;
    return means;
}

// Light of all hues from a thousandth of white to a thousand times white, some of it beyond what a screen
// shows, and none.
TEST(FilmLookup, ShowsLightAsPicturesDo) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> stops(-10, 10);
    std::uniform_real_distribution<float> share(-0.3F, 1);
    for (int i = 0; i < 500; ++i) {
        std::array<float, 3> channels = {share(random), share(random), 1};
        std::shuffle(channels.begin(), channels.end(), random);
        const float scale = i == 0 ? 0 : std::exp2(stops(random));
        const vec3 light = scale * vec3(channels[0], channels[1], channels[2]);
        const vec3 shown =
            255.0F *
            gpu::film_lookups::srgb_of(gpu::film_lookups::film(gpu::film_lookups::in_gamut(light)));
        const std::array<double, 3> bytes = bytes_shown(light);
        EXPECT_NEAR(double{shown.x}, bytes[0], 0.1) << i;
        EXPECT_NEAR(double{shown.y}, bytes[1], 0.1) << i;
        EXPECT_NEAR(double{shown.z}, bytes[2], 0.1) << i;
    }
}

}  // namespace
}  // namespace skybake
