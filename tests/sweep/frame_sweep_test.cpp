// Frames as an axis of sweeps: each variant is one frame of the sequence.
#include <gtest/gtest.h>

#include "bakers/assets/registry/registry.h"
#include "tests/sweep/sweeps.h"

namespace skybake {
namespace {

using testing::job_of;
using testing::run;

const std::string moving =
    "[noise.n]\nperiod = 4\n[noise.n.channels.Y]\ntype = \"alligator\"\nfrequency = 2\n"
    "[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\nformats = [\"bin\"]\n"
    "pixel_type = \"float\"\n";

TEST(FrameSweep, MakesTheFramesOfTheSequence) {
    const TemporaryFolder folder;
    write_bytes(folder / "r.toml", moving);
    const SweepJob job = job_of(folder / "r.toml", {"bake.n.frame=1:5:5"}, folder / "out");
    const auto results = run(job);
    ASSERT_EQ(results.size(), 5u);
    const auto bytes = [&](std::size_t variant) {
        return testing::read_bytes(job.folder / results[variant].name / "n.bin");
    };
    const auto recipe = config::parse_recipe(moving + "frames = 4\n", "r.toml", folder.path(), {});
    ASSERT_TRUE(recipe.value);
    BakeOptions options;
    options.threads = 1;
    for (std::size_t frame = 0; frame < 4; ++frame) {
        EXPECT_EQ(results[frame].name,
                  "000" + std::to_string(frame) + "_frame=" + std::to_string(frame + 1));
        const auto baked =
            bake_asset(*recipe.value, recipe.value->parameters.bakes[frame], options);
        ASSERT_TRUE(baked.value);
        ASSERT_EQ(results[frame].assets.size(), 1u);
        EXPECT_EQ(results[frame].assets[0].content_hash, baked.value->levels[0].content_hash);
        if (frame > 0) {
            EXPECT_NE(bytes(frame), bytes(frame - 1));
        }
    }
    EXPECT_EQ(bytes(4), bytes(0)) << "the fifth frame of four is the first";
}

}  // namespace
}  // namespace skybake
