#include <gtest/gtest.h>

#include <set>

#include "bakers/assets/registry/registry.h"
#include "bakers/workspace/sweep/variants.h"
#include "tests/sweep/sweeps.h"

namespace skybake {

namespace {

using Strings = std::vector<std::string>;

config::Sweep sweep_of(const std::string& path, const Strings& values) {
    config::SweepAxis axis{{path}, {}};
    for (const std::string& value : values) axis.rows.push_back({{value, value}});
    return {{axis}};
}

std::string first_name(const std::string& path, const std::string& value) {
    const config::Sweep sweep = sweep_of(path, {value});
    return VariantNames(sweep).name(0);
}

TEST(VariantNames, ThePathsAreAsShortAsTheyCanBe) {
    EXPECT_EQ(distinguishing_names({"clouds.c.threshold", "noise.n.seed"}),
              (Strings{"threshold", "seed"}));
    EXPECT_EQ(distinguishing_names({"noise.n.seed", "noise.m.seed", "clouds.c.coverage"}),
              (Strings{"n.seed", "m.seed", "coverage"}));
    EXPECT_EQ(
        distinguishing_names({"clouds.c.convection.seed", "clouds.d.convection.seed", "a.seed"}),
        (Strings{"c.convection.seed", "d.convection.seed", "a.seed"}));
    EXPECT_EQ(distinguishing_names({"preset"}), (Strings{"preset"}));
}

TEST(VariantNames, AreReadableAndSafeEverywhere) {
    EXPECT_EQ(first_name("clouds.c.threshold", "0.35"), "0000_threshold=0.35");
    EXPECT_EQ(first_name("clouds.c.base_altitude", "8 km"), "0000_base_altitude=8km");
    EXPECT_EQ(first_name("atmosphere.layers.m.scattering", "4e-6 /m"), "0000_scattering=4e-6perm");
    EXPECT_EQ(first_name("bake.v.size", "[16, 16, 8]"), "0000_size=16,16,8");
    EXPECT_EQ(first_name("clouds.c.coverage", "30 %"), "0000_coverage=30pct");
    EXPECT_EQ(first_name("a.\"sea fog\".g", "x:y*z"), "0000_g=x-y-z");
    for (const char c : first_name("a.b", "../x\\y:z*?\n\u00e9|<>$`'\"")) {
        EXPECT_NE(std::string("abcdefghijklmnopqrstuvwxyz0123456789_=.,+-").find(c),
                  std::string::npos)
            << c;
    }
    const std::string longest = first_name("a.b", std::string(300, 'x'));
    EXPECT_EQ(longest.size(), 100u);
    EXPECT_EQ(first_name("a.b", std::string(92, 'x') + "...").back(), 'x');
}

TEST(VariantNames, AreUniqueAndSortLikeTheirNumbers) {
    const config::Sweep sweep = sweep_of("a.b", Strings(12000, "same"));
    const VariantNames names(sweep);
    std::set<std::string> all;
    for (int i = 0; i < 12000; ++i) all.insert(names.name(i));
    EXPECT_EQ(all.size(), 12000u);
    EXPECT_EQ(*all.begin(), "00000_b=same");
    EXPECT_EQ(*all.rbegin(), "11999_b=same");
}

// Frames as an axis of sweeps: each variant is one frame of the sequence.

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
