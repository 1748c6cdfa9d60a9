// A cloud that grows does so once for all runs that share a cache, and colours are fitted once.
#include <filesystem>
#include <set>

#include "bakers/convection/convection.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/cache_folder.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
namespace fs = std::filesystem;

const std::string cumulus = R"(
[clouds.cumulus]
shape = "convection"
extent = ["1.6 km", "1.6 km", "0.8 km"]
base_altitude = "1 km"
[clouds.cumulus.convection]
cells = [8, 8, 8]
mixed_layer = "300 m"
inversion = "600 m"
patches = 3
minutes = 8
[bake.cumulus]
asset = "cloud_volume"
cloud = "cumulus"
size = [16, 16, 16]
formats = ["bin"]
)";

const std::string air = R"(
preset = "earth"
wavelengths = "best 3"
[bake.cumulus]
asset = "sky_view"
orders = "single"
sun_elevations = ["5 deg"]
size = [4, 4]
)";

// Counts what it finds and what it is given.
class CountedBytes : public CachedBytes {
  public:
    using CachedBytes::CachedBytes;
    std::optional<std::string> find(const Name& name) override {
        names.insert(name.parameters);
        auto bytes = CachedBytes::find(name);
        found += bytes.has_value() ? 1 : 0;
        return bytes;
    }
    void keep(const Name& name, std::string_view bytes) override {
        ++grown;
        CachedBytes::keep(name, bytes);
    }

    std::set<std::string> names;
    int found = 0;
    int grown = 0;
};

class KeptGrowth : public ::testing::Test {
  protected:
    // Returns the voxels of a bake with these settings, into a folder of its own.
    std::string baked(const std::vector<std::string>& settings, KeptBytes* kept) {
        TestBake bake(recipe_of(text_, {}, settings), folder_ / std::to_string(bakes_++));
        bake.bake.kept = kept;
        EXPECT_TRUE(bake.run().value.has_value());
        return read_bytes(bake.bake.folder / file_);
    }

    TemporaryFolder folder_;
    CountedBytes kept_{folder_ / "cache"};
    std::string text_ = cumulus, file_ = "cumulus.bin";
    int bakes_ = 0;
};

TEST_F(KeptGrowth, ServesOtherSizesAndRuns) {
    const std::vector<std::string> finer = {"bake.cumulus.size=[24, 24, 16]",
                                            "clouds.cumulus.extinction_scale=\"90 /km\""};
    const std::string alone = baked(finer, nullptr);
    EXPECT_NE(alone.find_first_not_of('\0'), std::string::npos);
    baked({}, &kept_);
    EXPECT_EQ(kept_.grown, 1);
    EXPECT_EQ(baked(finer, &kept_), alone);
    EXPECT_EQ(kept_.found, 1);
    EXPECT_EQ(kept_.grown, 1);
    const auto entries = cache_entries(folder_ / "cache");
    ASSERT_EQ(entries.value->size(), 1U);
    EXPECT_EQ(entries.value->at(0).kind, "convection");
    EXPECT_TRUE(verify_cache(folder_ / "cache").value->damaged.empty());
}

TEST_F(KeptGrowth, HasAFriendInFittedColours) {
    text_ = air;
    file_ = "cumulus.exr";
    const std::string alone = baked({"bake.cumulus.size=[8, 4]"}, nullptr);
    baked({}, &kept_);
    EXPECT_EQ(baked({"bake.cumulus.size=[8, 4]"}, &kept_), alone);
    EXPECT_EQ(kept_.found, 1);
    EXPECT_EQ(kept_.grown, 1);
    baked({"color.white='space'"}, &kept_);
    EXPECT_EQ(kept_.grown, 2);
}

TEST_F(KeptGrowth, GrowsAgainWhatIsDamaged) {
    const std::string whole = baked({}, &kept_);
    const fs::path file = cache_entries(folder_ / "cache").value->at(0).folder / "convection";
    std::string bytes = read_bytes(file);
    for (const std::size_t length : {bytes.size(), bytes.size() / 2}) {
        std::string damaged = bytes.substr(0, length);
        damaged[length / 3] ^= 0x40;
        write_bytes(file, damaged);
        EXPECT_EQ(baked({}, &kept_), whole);
        EXPECT_EQ(read_bytes(file), bytes);  // the whole one has taken its place
    }
    EXPECT_EQ(kept_.found, 0);
    EXPECT_EQ(kept_.grown, 3);
}

TEST_F(KeptGrowth, HasAKeyOfAllThatItDependsOn) {
    const std::vector<std::string> changes = {"cells=[10, 8, 8]",
                                              "mixed_layer='500 m'",
                                              "inversion='700 m'",
                                              "instability=1",
                                              "temperature=285",
                                              "humidity=0.6",
                                              "wind=[1, 0]",
                                              "wind_above=[1, 0]",
                                              "patches=2",
                                              "warmth=0.5",
                                              "patch_width=['200 m', '900 m']",
                                              "seed=2",
                                              "minutes=7"};
    baked({}, &kept_);
    for (const std::string& change : changes) {
        baked({"clouds.cumulus.convection." + change}, &kept_);
    }
    baked({"clouds.cumulus.base_altitude=\"2 km\""}, &kept_);
    baked({R"(clouds.cumulus.extent=["1.6 km", "1.7 km", "0.8 km"])"}, &kept_);
    EXPECT_EQ(kept_.names.size(), changes.size() + 3);
    EXPECT_EQ(kept_.grown, static_cast<int>(changes.size()) + 3);
    EXPECT_EQ(kept_.found, 0);
}

// Bytes of a length that no growth has.
TEST_F(KeptGrowth, BelievesNoOtherLength) {
    class Other : public KeptBytes {
      public:
        std::optional<std::string> find(const Name&) override { return std::string(12, 'x'); }
        void keep(const Name&, std::string_view) override {}
    } other;
    EXPECT_EQ(baked({}, &other), baked({}, nullptr));
}

}  // namespace
}  // namespace skybake
