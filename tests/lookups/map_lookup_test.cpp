// Weather maps, and masks of blue noise.
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::map_lookups {
#include "lookups/blue_noise.glsl.h"
#include "lookups/weather_map.glsl.h"
}  // namespace gpu::map_lookups

namespace {

using gpu::vec2;
using gpu::vec3;

TEST(WeatherMapLookup, FloatLosesLittle) {
    const test::BakedLookup baked = test::bake_all(
        "[noise.n.channels.Y]\ntype = 'perlin'\nfrequency = [5, 4, 1]\noctaves = 2\n"
        "[bake.a]\nasset = 'weather_map'\nnoise = 'n'\nsize = [48, 32]\nformats = ['exr']\n"
        "covered = 0.7\npixel_type = 'float'\n");
    const Texture texture = texture_of(baked.asset());
    const vec2 tile(8, 4);
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const vec2 p(dice.uniform(-20, 20), dice.uniform(-20, 20));
        const double found = double{gpu::map_lookups::weather_map({texture}, p, tile).x};
        loss.add(found - filtered(texture, {double{p.x} / 8, double{p.y} / 4, 0.5})[0]);
    });
    expect_little_loss(lost, baked.asset().certificate);
}

TEST(WeatherMapLookup, LessIsCoveredByLess) {
    using gpu::map_lookups::weather_map_cover;
    EXPECT_EQ(weather_map_cover(0.3f, 1), 0.3f);
    EXPECT_EQ(weather_map_cover(1, 0.25f), 1);
    EXPECT_EQ(weather_map_cover(0.7f, 0.25f), 0);
    EXPECT_NEAR(weather_map_cover(0.875f, 0.25f), 0.5, 1e-6);
    EXPECT_EQ(weather_map_cover(1, 0), 0);
}

TEST(WeatherMapLookup, DirectionsAreTakenBack) {
    const vec3 found = gpu::map_lookups::weather_map_direction({0.5f, 1, 0});
    EXPECT_EQ(found, vec3(0, 1, -1));
}

// Every pixel and frame near and far, also where a division by the size is not exact.
TEST(BlueNoiseLookup, IsTheTexelOfThePixelAroundTheMask) {
    for (const char* size : {"size = [24, 20]\nframes = 7\n", "size = [49, 41]\nframes = 3\n",
                             "size = [16, 16]\nframes = 1\n"}) {
        const test::BakedLookup baked = test::bake_all(
            std::string("[bake.a]\nasset = 'blue_noise'\n") + size, Certification::off);
        const Texture texture = texture_of(baked.asset());
        const std::array<int, 3> n = texture.size;
        for (int frame = -9; frame < 20; ++frame) {
            for (int y = -60; y < 130; y += 7) {
                for (int x = -60; x < 4000; x += 13) {
                    const std::array<int, 3> at = {((x % n[0]) + n[0]) % n[0],
                                                   ((y % n[1]) + n[1]) % n[1],
                                                   ((frame % n[2]) + n[2]) % n[2]};
                    const gpu::vec4 found = gpu::map_lookups::blue_noise(
                        {texture}, gpu::size_of(texture), vec2(x + 0.5, y + 0.5),
                        static_cast<float>(frame));
                    ASSERT_EQ(found.x, texture.texel(at, 0)) << x << " " << y << " " << frame;
                }
            }
        }
    }
}

TEST(BlueNoiseLookup, BytesAreSpreadWithoutBothEnds) {
    double sum = 0;
    for (int code = 0; code < 256; ++code) {
        const float value = gpu::map_lookups::blue_noise_between(static_cast<float>(code) / 255);
        EXPECT_NEAR(value, (code + 0.5) / 256, 1e-7);
        sum += double{value};
    }
    EXPECT_NEAR(sum / 256, 0.5, 1e-6);
}

}  // namespace
}  // namespace skybake
