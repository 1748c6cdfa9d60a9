// Files that a bake wrote as volumes of other bakes: as NanoVDB, and opened once for several assets.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/io/volumes/volume_reader.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using testing::recipe_of;
using testing::TemporaryFolder;
using testing::TestBake;

const std::string cloud_recipe = R"(
[noise.n.channels.Y]
type = "perlin"
frequency = 4
[clouds.c]
noise = "n"
extent = ["640 m", "512 m", "200 m"]
base_altitude = "1 km"
threshold = 0.3
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [40, 32, 20]
pixel_type = "float"
formats = ["nvdb"]
)";

// A NanoVDB file says only the box of its active voxels, and this one is sparse.
const std::string volume_recipe = R"(
[volumes.v]
file = "c.nvdb"
format = "nvdb"
crop_first = [0, 0, 0]
crop_size = [40, 32, 20]
[clouds.c]
volume = "v"
base_altitude = "1 km"
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [40, 32, 20]
pixel_type = "float"
)";

class SharedVolume : public ::testing::Test {
  protected:
    SharedVolume() {
        config::set_volume_probe(read_volume_shape);
        TestBake bake(recipe_of(cloud_recipe), folder_.path());
        EXPECT_EQ(bake.states(), std::vector<AssetState>(1, AssetState::baked));
    }
    ~SharedVolume() override { config::set_volume_probe(nullptr); }

    config::Recipe volume() const { return recipe_of(volume_recipe, folder_.path()); }

    TemporaryFolder folder_;
};

std::string hash_of(const config::Recipe& recipe) {
    const auto baked = bake_asset(recipe, recipe.parameters.bakes[0], {1, Certification::off});
    for (const auto& diagnostic : baked.diagnostics) ADD_FAILURE() << diagnostic.message;
    return baked.value ? baked.value->levels[0].content_hash : "";
}

TEST_F(SharedVolume, OfAnOwnNanoVdbFileIsThatFile) {
    EXPECT_EQ(hash_of(volume()), hash_of(recipe_of(cloud_recipe)));
}

// The second asset finds the volume as the first one opened it, whatever has become of the file.
TEST_F(SharedVolume, IsOpenedOnceForAllAssetsOfARun) {
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
