// Clouds of volumes from recipe to voxels: what was baked and is read back is the same, also as NanoVDB; a file is
// opened once for several assets; and errors say where they are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/io/volumes/volume_reader.h"
#include "config/diagnostics/diagnostic.h"
#include "tests/clouds/cloud_specification.h"
#include "tests/incremental/bakes.h"
#include "tests/noise/every_target.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::recipe_of;
using testing::TestBake;
using States = std::vector<AssetState>;

const std::string bakes = R"(
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [40, 32, 20]
pixel_type = "float"
[bake.o]
asset = "occupancy"
of = "c"
cell = 4
)";

// A cloud of noise, whose file the other recipes read.
const std::string cloud_recipe = R"(
[noise.n.channels.Y]
type = "perlin"
frequency = 4
[clouds.c]
noise = "n"
extent = ["640 m", "512 m", "200 m"]
base_altitude = "1 km"
threshold = 0.3
)" + bakes;

const std::string volume_recipe = R"(
[volumes.v]
file = "c.vdb"
[clouds.c]
volume = "v"
base_altitude = "1 km"
)" + bakes;

class VolumeCloud : public ::testing::Test {
  protected:
    VolumeCloud() { config::set_volume_probe(read_volume_shape); }
    ~VolumeCloud() override { config::set_volume_probe(nullptr); }

    void bake_cloud() const {
        TestBake bake(recipe_of(cloud_recipe), folder_.path());
        ASSERT_EQ(bake.states(), States(2, AssetState::baked));
    }
    config::Recipe volumes(const std::string& text = volume_recipe) const {
        return recipe_of(text, folder_.path());
    }

    TemporaryFolder folder_;
};

std::string hash_of(const config::Recipe& recipe, std::size_t number) {
    const auto baked = bake_asset(recipe, recipe.parameters.bakes[number], {1, Certification::off});
    for (const auto& diagnostic : baked.diagnostics) ADD_FAILURE() << diagnostic.message;
    return baked.value ? baked.value->levels[0].content_hash : "";
}

// The file's voxels are those of the bake, bit for bit, and so are the cells over them.
TEST_F(VolumeCloud, OfAnOwnFileIsThatFile) {
    bake_cloud();
    const config::Recipe noise = recipe_of(cloud_recipe);
    const config::Recipe volume = volumes();
    EXPECT_EQ(hash_of(volume, 0), hash_of(noise, 0));
    EXPECT_EQ(hash_of(volume, 1), hash_of(noise, 1));
}

// The parameters that files carry are a recipe again, for which the file need not be there.
TEST_F(VolumeCloud, RecordsARecipe) {
    bake_cloud();
    const config::Recipe recipe = volumes();
    const std::string text = asset_parameters(recipe, recipe.parameters.bakes[0]);
    std::filesystem::remove(folder_ / "c.vdb");
    const config::Recipe again = recipe_of(text, folder_.path());
    EXPECT_EQ(asset_parameters(again, again.parameters.bakes.at(0)), text);
}

TEST_F(VolumeCloud, SpansWhatTheFileSpans) {
    bake_cloud();
    const config::Cloud& cloud = volumes().parameters.clouds[0];
    EXPECT_DOUBLE_EQ(cloud.extent[0].meters, 640);
    EXPECT_DOUBLE_EQ(cloud.extent[1].meters, 512);
    EXPECT_DOUBLE_EQ(cloud.extent[2].meters, 200);
    EXPECT_EQ(cloud.edge_softness, 0);
}

// Each of these changes must be seen by the test above.
TEST_F(VolumeCloud, IsAnotherOneWhereAnythingIsShifted) {
    bake_cloud();
    const std::string same = hash_of(volumes(), 0);
    for (const char* change : {"up_axis = \"y\"", "scale = 0.999", "border = 1",
                               "crop_first = [1, 0, 0]\ncrop_size = [40, 32, 20]",
                               "crop_first = [0, 0, 0]\ncrop_size = [39, 32, 20]"}) {
        std::string text = volume_recipe;
        text.insert(text.find("[clouds.c]"), change + std::string("\n"));
        EXPECT_NE(hash_of(volumes(text), 0), same) << change;
    }
}

TEST_F(VolumeCloud, IsBakedAnewOnlyWhereItsFileChanges) {
    bake_cloud();
    testing::write_bytes(folder_ / "v.vdb", testing::read_bytes(folder_ / "c.vdb"));
    std::string text = volume_recipe;
    text.replace(text.find("c.vdb"), 5, "v.vdb");
    TestBake bake(volumes(text), folder_ / "out");
    EXPECT_EQ(bake.states(), States(2, AssetState::baked));
    EXPECT_EQ(bake.states(), States(2, AssetState::up_to_date));
    std::string other = cloud_recipe;
    other.replace(other.find("threshold = 0.3"), 15, "threshold = 0.4");
    TestBake changed(recipe_of(other), folder_.path());
    ASSERT_EQ(changed.states(), States(2, AssetState::baked));
    testing::write_bytes(folder_ / "v.vdb", testing::read_bytes(folder_ / "c.vdb"));
    EXPECT_EQ(bake.states(), States(2, AssetState::baked));
    EXPECT_EQ(bake.states(), States(2, AssetState::up_to_date));
    EXPECT_EQ(hash_of(bake.recipe, 0), hash_of(recipe_of(other), 0));
}

TEST_F(VolumeCloud, NamesItsFileAmongTheRecipesInputs) {
    bake_cloud();
    const std::vector<std::filesystem::path> inputs = volumes().inputs;
    EXPECT_NE(std::find(inputs.begin(), inputs.end(), folder_ / "c.vdb"), inputs.end());
}

// With detail, erosion, a threshold and coverage: kernels equal the specification bit for bit, what is
// known to be empty is, and the definition in double precision is near.
TEST_F(VolumeCloud, IsShapedAsCloudsOfNoiseAre) {
    config::Noise detail;
    detail.name = "d";
    config::NoiseChannel channel;
    channel.name = "Y";
    channel.octaves.frequencies = {{4, 4, 4}};
    channel.octaves.gains = {1};
    detail.channels = {channel};
    config::Cloud cloud;
    cloud.volume = "v";
    cloud.detail = "d";
    cloud.erosion = {0.2, 0.35};
    cloud.wisp_height = 0.3;
    cloud.extent = {config::Length{100}, config::Length{100}, config::Length{50}};
    cloud.threshold = 0.3;
    cloud.edge_softness = 0.2;
    cloud.coverage = 0.9;
    cloud::CloudVolume volume;
    volume.source.size = {23, 20, 9};
    volume.source.largest = 1;
    volume.source.voxels = std::make_shared<testing::FunctionVoxels>(testing::sample_voxel);
    const std::array<int, 3> size = {37, 19, 11};
    const cloud::CloudField field(make_cloud_plan(cloud, volume, &detail, size, {}));
    const cloud::CloudReference reference(cloud, volume, &detail, size, {});
    test::on_every_target([&](const char* name) {
        const std::vector<float> made = testing::planes_of(field, {{}, size}, 1)[0];
        std::size_t i = 0;
        double worst = 0;
        int cloudy = 0;
        testing::for_each_voxel(size, [&](int x, int y, int z) {
            const float found = made[i++];
            EXPECT_EQ(found, cloud_at(field.plan(), {x, y, z})[0]) << name;
            const double wanted =
                reference({(x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2]})[0];
            worst = std::max(worst, std::abs(wanted - double{found}));
            if (found > 0) ++cloudy;
        });
        EXPECT_LT(worst, 1e-5) << name;
        EXPECT_GT(cloudy, 100);
    });
}

// --- Hard cases ---------------------------------------------------------------------------------

std::string raw_recipe(const std::string& size, const std::string& of_bake) {
    return fmt::format(R"(
[volumes.v]
file = "v.raw"
format = "raw"
size = {}
voxel_size = ["10 m", "20 m", "30 m"]
[clouds.c]
volume = "v"
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = {}
pixel_type = "float"
[bake.o]
asset = "occupancy"
of = "c"
cell = 1
)",
                       size, of_bake);
}

TEST_F(VolumeCloud, MayBeEmpty) {
    testing::write_bytes(folder_ / "v.raw", std::string(4 * 60, '\0'));
    for (const char* size : {"[5, 4, 3]", "[7, 2, 3]", "[1, 1, 1]"}) {
        const config::Recipe recipe = volumes(raw_recipe("[5, 4, 3]", size));
        const auto baked =
            bake_asset(recipe, recipe.parameters.bakes[0], {1, Certification::quick});
        ASSERT_TRUE(baked.value) << baked.diagnostics.at(0).message;
        EXPECT_EQ(baked.value->levels[0].statistics[0].max, 0);
        EXPECT_NE(hash_of(recipe, 1), "");
    }
}

TEST_F(VolumeCloud, MayBeOneVoxel) {
    const float value = 0.75F;
    testing::write_bytes(folder_ / "v.raw", {reinterpret_cast<const char*>(&value), sizeof value});
    const config::Recipe recipe = volumes(raw_recipe("[1, 1, 1]", "[1, 1, 1]"));
    const auto baked = bake_asset(recipe, recipe.parameters.bakes[0], {1, Certification::quick});
    ASSERT_TRUE(baked.value);
    EXPECT_EQ(baked.value->levels[0].statistics[0].max, 0.75);
    EXPECT_DOUBLE_EQ(recipe.parameters.clouds[0].extent[2].meters, 30);
}

// --- Errors -------------------------------------------------------------------------------------

using Errors = std::vector<std::string>;

TEST_F(VolumeCloud, ErrorsSayWhereTheyAre) {
    const auto errors = [&](const std::string& text) {
        std::vector<std::string> errors;
        for (const auto& found : config::parse_recipe(text, "r.toml", folder_.path()).diagnostics) {
            if (found.severity != config::Severity::error) continue;
            errors.push_back(fmt::format("{} {}:{} {}; {}", found.code, found.where.line,
                                         found.where.column, found.message, found.label));
        }
        return errors;
    };
    const std::string missing = (folder_ / "c.vdb").string();
    const std::string recipe = "[volumes.v]\nfile = \"c.vdb\"\n[clouds.c]\nvolume = \"v\"\n";
    EXPECT_EQ(errors(recipe),
              Errors{"E0300 2:8 cannot read `" + missing + "`: No such file or directory; "});
    testing::write_bytes(folder_ / "c.vdb", "no such file at all");
    EXPECT_EQ(errors(recipe), Errors{"E0304 2:8 cannot read `" + missing +
                                     "` as a VDB file: it does not begin as a VDB file; "});
    testing::write_bytes(folder_ / "c.vdb", "NanoVDB1, as other programs write it");
    EXPECT_EQ(errors(recipe),
              Errors{"E0304 2:8 cannot read `" + missing +
                     "` as a VDB file: it is a NanoVDB file: write format = \"nvdb\"; "});
}

// The same cloud as a NanoVDB file, which says only the box of its active voxels, and is sparse.
class NanoVdbCloud : public VolumeCloud {
  protected:
    NanoVdbCloud() {
        std::string text = cloud_recipe;
        text.replace(text.find("[bake.o]"), std::string::npos, "formats = [\"nvdb\"]\n");
        TestBake bake(recipe_of(text), folder_.path());
        EXPECT_EQ(bake.states(), States(1, AssetState::baked));
    }
    config::Recipe volume() const {
        std::string text = volume_recipe;
        text.replace(text.find("file = \"c.vdb\""), 14,
                     "file = \"c.nvdb\"\nformat = \"nvdb\"\ncrop_first = [0, 0, 0]\n"
                     "crop_size = [40, 32, 20]");
        return volumes(text);
    }
};

TEST_F(NanoVdbCloud, OfAnOwnFileIsThatFile) {
    EXPECT_EQ(hash_of(volume(), 0), hash_of(recipe_of(cloud_recipe), 0));
}

// The second asset finds the volume as the first one opened it, whatever has become of the file.
TEST_F(NanoVdbCloud, IsOpenedOnceForAllAssetsOfARun) {
    const config::Recipe recipe = volume();
    const config::Parameters& parameters = recipe.parameters;
    const auto& asset = parameters.bakes[0].as<config::CloudVolumeBake>();
    Intermediates shared(1 << 20);
    const auto first = shared.expect(needs_of_voxels(parameters, asset));
    const auto second = shared.expect(needs_of_voxels(parameters, asset));
    const BakeOptions options{.intermediates = &shared};
    Facts details;
    const auto one = cloud_inputs(parameters, asset, details, options);
    std::filesystem::remove(folder_ / "c.nvdb");
    const auto other = cloud_inputs(parameters, asset, details, options);
    ASSERT_TRUE(one.value && other.value);
    EXPECT_EQ(one.value->volume->source.voxels, other.value->volume->source.voxels);
    EXPECT_FALSE(cloud_inputs(parameters, asset, details).value) << "it is gone";
}

}  // namespace
}  // namespace skybake
