#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_of;
using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::valid;

Diagnostic fault(const std::string& keys) { return only_diagnostic(cloud_recipe(keys)); }

using Pair = std::array<double, 2>;
using Triple = std::array<int, 3>;

TEST(CloudDecoder, HasItsDefaults) {
    const Cloud cloud = cloud_of("");
    EXPECT_EQ(cloud.name, "c");
    EXPECT_EQ(cloud.noise, "n");
    EXPECT_EQ(cloud.noise_scale, (Triple{1, 1, 1}));
    EXPECT_EQ(cloud.detail, "");
    EXPECT_EQ(cloud.erosion, (Pair{0, 0})) << "nothing erodes";
    EXPECT_EQ(cloud.extent[0].meters, 1000);
    EXPECT_EQ(cloud.extent[1].meters, 2000);
    EXPECT_EQ(cloud.extent[2].meters, 500);
    EXPECT_EQ(cloud.base_altitude.meters, 0);
    EXPECT_EQ(cloud.height_profile.type, HeightProfileType::cumulus);
    EXPECT_EQ(cloud.coverage, 1);
    EXPECT_EQ(cloud.coverage_map.file, "");
    EXPECT_TRUE(cloud.coverage_map.path.empty());
    EXPECT_EQ(cloud.threshold, 0);
    EXPECT_EQ(cloud.edge_softness, 0.05);
    EXPECT_EQ(cloud.threshold_at, ThresholdAt::bake);
    EXPECT_EQ(cloud.channels, CloudChannels::density);
    EXPECT_EQ(cloud.extinction_scale.per_meter, 0.04);
    EXPECT_TRUE(cloud.towers.empty());
    EXPECT_EQ(cloud.scatter.count, 0);
    const Cloud eroded = cloud_of("detail = 'd'");
    EXPECT_EQ(eroded.detail_scale, (Triple{1, 1, 1}));
    EXPECT_EQ(eroded.erosion, (Pair{0.2, 0.35}));
    EXPECT_EQ(eroded.wisp_height, 0.1);
}

TEST(CloudDecoder, DensityIsFullWhereTheFileHoldsIt) {
    EXPECT_FALSE(cloud_of("").full_at);
    EXPECT_EQ(cloud_of("full_at = 0.2").full_at, 0.2);
    EXPECT_EQ(only_diagnostic(cloud_recipe("full_at = 0")).code, "E0110");
    EXPECT_EQ(only_diagnostic(cloud_recipe("full_at = 0.2\nthreshold_at = 'runtime'")).code,
              "E0111");
}

TEST(CloudDecoder, ReadsEveryKey) {
    const Cloud cloud = cloud_of(
        "noise_scale = [4, 5, 1]\ndetail = 'd'\ndetail_scale = 16\nerosion = [0, 0.95]\n"
        "wisp_height = 1\nbase_altitude = '-1.2 km'\ncoverage = '5 %'\nthreshold = 0.35\n"
        "edge_softness = 0\nthreshold_at = 'runtime'\nchannels = 'noise'\n"
        "extinction_scale = '0 /m'\n"
        "height_profile = { type = 'tabulated', table = [[0, 0.0], [0.25, 2]] }\n"
        "coverage_map = { file = 'maps/../a.png', channel = 'R', wrap = 'clamp', "
        "filter = 'nearest', color_space = 'srgb' }\n"
        "scatter = { count = 12, seed = 3, sigma = [0.1, 0.2], aspect = [1, 3], amplitude = [0, 1] "
        "}\n[[clouds.c.towers]]\ncenter = [0.2, -3]\nsigma = [0.03, 0.06]\nrotation = '180 deg'\n"
        "correlation = -0.5\namplitude = 0.4\n");
    EXPECT_EQ(
        testing::to_string(cloud),
        "c n [4, 5, 1] d [16, 16, 16] [0, 0.95] 1 | 1000 2000 500 | -1200 0.05 0.35 0 1 1 0 0\n"
        "5 50 4 1 0:0 0.25:2\nmaps/../a.png a.png R 1 0 1\n   0 1 0\n"
        "12 3 [0.1, 0.2] [1, 3] [0, 1]\n"
        "0 [0.2, -3] [0.03, 0.06] 3.141592653589793 -0.5 0.4");
    const Cloud blended = cloud_of(
        "height_profile = { type = 'blended', cloud_type = 0.5 }\ntype_map = { file = 't.png' }\n");
    EXPECT_EQ(blended.height_profile.cloud_type, 0.5);
    EXPECT_EQ(blended.type_map.path, "t.png");
    EXPECT_EQ(blended.type_map.wrap, MapWrap::repeat);
    EXPECT_EQ(blended.type_map.filter, MapFilter::linear);
    const Cloud scattered = cloud_of("scatter.count = 2");
    EXPECT_EQ(testing::to_string(scattered.scatter), "2 0 [0.02, 0.05] [1, 2] [0.2, 0.5]");
}

TEST(CloudDecoder, ValuesHaveRanges) {
    for (const char* keys : {"noise_scale = 0",
                             "noise_scale = [1, 1, 1025]",
                             "detail = 'd'\nerosion = [0.96, 0.1]",
                             "detail = 'd'\nerosion = [nan, 0.1]",
                             "detail = 'd'\nwisp_height = 1.1",
                             "base_altitude = '2e8 m'",
                             "coverage = 1.01",
                             "coverage = -0.1",
                             "threshold = -1",
                             "threshold = 2e6",
                             "edge_softness = 1e-7",
                             "edge_softness = -1",
                             "edge_softness = inf",
                             "extinction_scale = '-1 /m'",
                             "extinction_scale = '2e6 /m'",
                             "height_profile = { type = 'thesis', top_falloff = -1 }",
                             "height_profile = { type = 'blended', cloud_type = 2 }",
                             "height_profile = { type = 'tabulated', table = [[1.5, 1]] }",
                             "height_profile = { type = 'tabulated', table = [[0.5, -2e6]] }",
                             "scatter.count = -1",
                             "scatter.count = 100001",
                             "scatter.sigma = [0, 1]",
                             "scatter.aspect = [0.5, 1]",
                             "scatter.aspect = [1, 101]",
                             "scatter.amplitude = [-1, 1]",
                             "coverage_map = { file = '' }"}) {
        EXPECT_EQ(fault(keys).code, "E0110") << keys;
    }
    EXPECT_EQ(only_diagnostic("[clouds.c]\nnoise = 'n'\nextent = ['0 m', '1 m', '1 m']\n"
                              "[noise.n.channels.Y]\ntype = 'worley'\n")
                  .code,
              "E0110");
    EXPECT_TRUE(
        fault("edge_softness = 1e-7").label.starts_with("must be 0 or in [1e-06, 1000000]"));
    EXPECT_EQ(fault("coverage_map = { file = '' }").message,
              "`clouds.c.coverage_map.file` is empty");
}

TEST(CloudDecoder, TowersHaveRanges) {
    const auto tower = [](const std::string& keys) {
        return "[clouds.c.towers.big]\n" + keys + "\n";
    };
    const std::string whole = "center = [0, 0]\nsigma = [1, 1]\namplitude = 1\n";
    EXPECT_EQ(cloud_of(tower(whole)).towers.at(0).name, "big");
    EXPECT_EQ(fault(tower(whole + "correlation = 1")).code, "E0110");
    EXPECT_EQ(fault(tower(whole + "correlation = -0.9999995")).code, "E0110");
    EXPECT_EQ(fault(tower(whole + "rotation = 0.5")).code, "E0107");
    EXPECT_EQ(fault(tower("center = [0, 16.1]\nsigma = [1, 1]\namplitude = 1")).code, "E0110");
    EXPECT_EQ(fault(tower("center = [0, 0]\nsigma = [0, 1]\namplitude = 1")).code, "E0110");
    EXPECT_EQ(fault(tower("center = [0, 0]\nsigma = [1, 17]\namplitude = 1")).code, "E0110");
    EXPECT_EQ(fault(tower("center = [0, 0]\nsigma = [1, 1]\namplitude = -1")).code, "E0110");
    EXPECT_EQ(fault(tower("center = [0]\nsigma = [1, 1]\namplitude = 1")).code, "E0108");
    const Diagnostic missing = fault(tower("center = [0, 0]\nsigma = [1, 1]"));
    EXPECT_EQ(missing.code, "E0105");
    EXPECT_EQ(missing.message, "`clouds.c.towers.big.amplitude` is missing");
    EXPECT_EQ(missing.where.line, 4);
    EXPECT_EQ(fault("towers = [3]").message, "`clouds.c.towers.0` must be a table, not 3");
    EXPECT_EQ(fault("towers = 3").code, "E0103");
}

TEST(CloudDecoder, TowersMayBeDomes) {
    const std::string whole =
        "[[clouds.c.towers]]\nshape = 'dome'\nfoot = ['1 km', '-20 m', '0 m']\n"
        "size = ['800 m', '0.6 km', '0.4 km']\namplitude = 1\n";
    const Tower plain = cloud_of(whole).towers.at(0);
    EXPECT_EQ(plain.shape, TowerShape::dome);
    EXPECT_EQ(plain.foot[1].meters, -20);
    EXPECT_EQ(plain.size[2].meters, 400);
    EXPECT_EQ(static_cast<const DomeShape&>(plain), DomeShape{});
    const Tower all = cloud_of(whole +
                               "widest = 0.5\nlean = [0.2, -1]\nlobes = 7\n"
                               "lobe_size = [0.1, 0.2]\nseed = 9\nrotation = '180 deg'\n")
                          .towers.at(0);
    EXPECT_EQ(static_cast<const DomeShape&>(all), (DomeShape{0.5, {0.2, -1}, 7, {0.1, 0.2}}));
    EXPECT_EQ(all.seed, 9u);
    EXPECT_EQ(fault(whole + "sigma = [0.1, 0.1]").code, "E0111");
    EXPECT_EQ(fault(whole + "lean = [0, 11]").code, "E0110");
    EXPECT_EQ(fault(whole + "widest = 1.1").code, "E0110");
    EXPECT_EQ(fault(whole + "lobes = -1").code, "E0110");
    EXPECT_EQ(fault("[[clouds.c.towers]]\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = 1\n"
                    "lobes = 3\n")
                  .code,
              "E0111");
    EXPECT_EQ(fault("[clouds.c.scatter]\nshape = 'dome'\nsigma = [0.1, 0.2]\n").code, "E0111");
    EXPECT_EQ(fault("[clouds.c.scatter]\nshape = 'dome'\nwidth = ['2 m', '1 m']\n").code, "E0113");
    EXPECT_EQ(fault("[[clouds.c.towers]]\nshape = 'dome'\nfoot = ['0 m', '0 m', '0 m']\n"
                    "size = ['1e7 m', '1 km', '0.4 km']\namplitude = 1\n")
                  .code,
              "E0110");
    EXPECT_EQ(fault("[clouds.c.scatter]\nshape = 'dome'\nwidth = ['1 m', '1e7 m']\n").code,
              "E0110");
    EXPECT_EQ(fault("[clouds.c.scatter]\nshape = 'dome'\ncount = 100000\nlobes = 10\n").code,
              "E0110");
    const TowerScatter scatter = cloud_of("scatter = { shape = 'dome', count = 2 }").scatter;
    EXPECT_EQ(scatter.width[1].meters, 900);
    EXPECT_EQ(scatter.slenderness, (Pair{0.6, 1}));
}

TEST(CloudDecoder, BoundsStandInOrder) {
    const Diagnostic diagnostic = fault("scatter.sigma = [0.2, 0.1]");
    EXPECT_EQ(diagnostic.code, "E0113");
    EXPECT_EQ(diagnostic.where.line, 4);
    EXPECT_EQ(cloud_of("scatter.sigma = [0.1, 0.1]").scatter.sigma, (Pair{0.1, 0.1}));
}

TEST(CloudDecoder, HeightTablesIncrease) {
    const auto table = [](const std::string& rows) {
        return fault("height_profile = { type = 'tabulated', table = " + rows + " }");
    };
    EXPECT_EQ(table("[]").code, "E0114");
    EXPECT_EQ(table("[]").label, "give at least one [height, value] pair");
    EXPECT_EQ(table("[[0.5, 1], [0.5, 2]]").code, "E0114");
    EXPECT_EQ(table("[[0.5, 1], [0.5, 2]]").message,
              "`clouds.c.height_profile.table` has heights that do not increase: 0.5 after 0.5");
    EXPECT_EQ(table("[[0.5, 1], [0.6]]").code, "E0114");
    EXPECT_EQ(table("3").code, "E0103");
    EXPECT_EQ(cloud_of("height_profile = { type = 'tabulated', table = [[0.5, 1]] }")
                  .height_profile.table.size(),
              1u);
    EXPECT_EQ(fault("height_profile = { type = 'tabulated' }").code, "E0105");
}

TEST(CloudDecoder, ItsNoisesAreThere) {
    const Diagnostic slip = only_diagnostic(
        "[clouds.c]\nnoise = 'wips'\nextent = ['1 m', '1 m', '1 m']\n"
        "[noise.wisps.channels.Y]\ntype = 'worley'\n");
    EXPECT_EQ(slip.code, "E0130");
    EXPECT_EQ(slip.message, "`clouds.c.noise`: the recipe has no [noise.wips]");
    EXPECT_EQ(slip.label, "did you mean `wisps`?");
    EXPECT_EQ(slip.where.line, 2);
    const Diagnostic detail = fault("detail = 'x'");
    EXPECT_EQ(detail.code, "E0130");
    EXPECT_EQ(detail.label, "this recipe has d, n");
    const auto missing = testing::parse("[clouds.c]\n").diagnostics;
    EXPECT_EQ(testing::codes_and_places(missing),
              (std::vector<std::string>{"E0105 1:9", "E0105 1:9"}));
}

TEST(CloudDecoder, KeysOfErosionNeedADetail) {
    for (const char* key : {"erosion = [0.1, 0.2]", "detail_scale = 2", "wisp_height = 0.2"}) {
        const Diagnostic diagnostic = fault(key);
        EXPECT_EQ(diagnostic.code, "E0111") << key;
        EXPECT_EQ(diagnostic.where.line, 4);
        EXPECT_EQ(fault(std::string("detail = ''\n") + key).code, "E0111") << key;
    }
    EXPECT_EQ(fault("erosion = [0.1, 0.2]").message,
              "`clouds.c.erosion` belongs to clouds.c.detail, and there is none");
    EXPECT_EQ(testing::parse(cloud_recipe("detail = 3\nerosion = [0.1, 0.2]")).diagnostics.size(),
              1u)
        << "a detail at fault passes for one";
    EXPECT_EQ(cloud_of("detail = 'd'\nerosion = [0.1, 0.2]", {"clouds.c.detail=\"\""}).erosion,
              (Pair{0, 0}))
        << "to take the detail away takes its keys away";
}

TEST(CloudDecoder, AMapOfTypesNeedsABlend) {
    const Diagnostic diagnostic =
        fault("type_map = { file = 't.png' }\nheight_profile = { type = 'stratus' }");
    EXPECT_EQ(diagnostic.code, "E0111");
    EXPECT_EQ(diagnostic.where.line, 4);
    EXPECT_EQ(diagnostic.label, "type = \"stratus\" comes from test.toml:5");
    EXPECT_EQ(fault("type_map = { file = 't.png' }").label,
              "type = \"cumulus\" comes from the default");
    EXPECT_EQ(fault("coverage_map = {}").code, "E0105");
    EXPECT_EQ(fault("coverage_map = 'a.png'").code, "E0103");
    EXPECT_EQ(fault("height_profile = { cloud_type = 1 }").code, "E0111");
}

TEST(CloudDecoder, ScaledFrequenciesHaveARange) {
    const auto with_noise = [](const std::string& keys, const std::string& noise) {
        return "[clouds.c]\nnoise = 'n'\nextent = ['1 m', '1 m', '1 m']\n" + keys +
               "\n[noise.n.channels.Y]\ntype = 'worley'\n" + noise;
    };
    EXPECT_EQ(valid(with_noise("noise_scale = [1, 1, 1024]", "frequency = 1024"))
                  .parameters.clouds.size(),
              1u);
    const Diagnostic diagnostic =
        only_diagnostic(with_noise("noise_scale = [1, 1, 1024]", "frequency = [1, 1, 1025]"));
    EXPECT_EQ(diagnostic.code, "E0128");
    EXPECT_EQ(diagnostic.where.line, 4);
    EXPECT_EQ(diagnostic.message,
              "`clouds.c.noise_scale` times frequency 1025 of noise `n` is 1049600");
    // Only the first channel goes into a density, all of them into channels = "noise".
    const std::string more =
        "[noise.n.channels.R]\ntype = 'worley'\nfrequency = 4\n[noise.n.channels.G]\n"
        "type = 'worley'\nfrequency = 4096\n[noise.n.channels.B]\ntype = 'worley'\n"
        "[clouds.c]\nnoise = 'n'\nnoise_scale = 1000\nextent = ['1 m', '1 m', '1 m']\n";
    EXPECT_EQ(valid(more).parameters.clouds.size(), 1u);
    EXPECT_EQ(only_diagnostic(more + "channels = 'noise'\n").code, "E0128");
}

TEST(CloudDecoder, NamesAreBare) {
    EXPECT_EQ(only_diagnostic("[clouds.'a b']\nnoise = 'n'\nextent = ['1 m', '1 m', '1 m']\n"
                              "[noise.n.channels.Y]\ntype = 'worley'\n")
                  .code,
              "E0117");
    EXPECT_EQ(only_diagnostic("clouds = 3\n[noise.n.channels.Y]\ntype = 'worley'\n").code, "E0103");
    EXPECT_EQ(fault("nois_scale = 3").label, "did you mean `noise_scale`?");
    EXPECT_EQ(fault("tower = 3").label, "did you mean `towers`?");
}

// Maps are looked for as includes are: beside the file that names them.
TEST(CloudDecoder, MapsLieBesideTheirRecipe) {
    const testing::TemporaryFolder folder;
    folder.write("parts/map.toml", "clouds.c.coverage_map.file = '../maps/a.png'\n");
    folder.write("parts/type.toml", "clouds.c.type_map.file = 'b.png'\n");
    const auto file = folder.write(
        "main.toml", "include = ['parts/map.toml', 'parts/type.toml']\n" +
                         cloud_recipe("height_profile.type = 'blended'") +
                         "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n");
    const auto outcome =
        load_recipe(file, std::vector<std::string>{"clouds.c.type_map.file=c.png"});
    ASSERT_TRUE(outcome.value);
    const Cloud& cloud = outcome.value->parameters.clouds.at(0);
    EXPECT_EQ(cloud.coverage_map.path, folder.path() / "maps/a.png");
    EXPECT_EQ(cloud.coverage_map.file, "../maps/a.png");
    EXPECT_EQ(cloud.type_map.path, folder.path() / "c.png") << "settings: beside the recipe";
    const auto& inputs = outcome.value->inputs;
    ASSERT_EQ(inputs.size(), 5u);
    EXPECT_EQ(inputs[3], cloud.coverage_map.path);
    EXPECT_EQ(inputs[4], cloud.type_map.path);
}

}  // namespace
}  // namespace skybake::config
