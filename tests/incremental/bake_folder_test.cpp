#include "bakers/workspace/bake_folder.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <thread>

#include "bakers/io/files/output_folder.h"
#include "bakers/workspace/asset_cache.h"
#include "tests/incremental/bakes.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
namespace fs = std::filesystem;

using States = std::vector<AssetState>;
constexpr AssetState up_to_date = AssetState::up_to_date;
constexpr AssetState copied = AssetState::copied;
constexpr AssetState baked = AssetState::baked;

std::map<std::string, fs::file_time_type> time_stamps(const fs::path& folder) {
    std::map<std::string, fs::file_time_type> result;
    for (const auto& entry : fs::directory_iterator(folder)) {
        result[entry.path().filename().string()] = entry.last_write_time();
    }
    return result;
}

class BakeFolder : public ::testing::Test {
  protected:
    // A bake of the small recipe with these settings.
    TestBake with(const std::vector<std::string>& settings, const std::string& name = "out") const {
        return TestBake(recipe_of(small_recipe, {}, settings), folder / name);
    }

    const TemporaryFolder folder;
    TestBake bake{recipe_of(small_recipe), folder / "out"};
};

TEST_F(BakeFolder, MakesEverythingOnceAndNothingTwice) {
    EXPECT_EQ(bake.states(), (States{baked, baked, baked}));
    const auto before = time_stamps(folder / "out");
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, up_to_date}));
    EXPECT_EQ(time_stamps(folder / "out"), before);  // the manifest's, too
}

TEST_F(BakeFolder, MakesJustWhatDependsOnAChange) {
    EXPECT_TRUE(bake.run().value);
    const auto before = time_stamps(folder / "out");
    TestBake second = with({"atmosphere.ground_albedo=0.125"});
    EXPECT_EQ(second.states(), (States{up_to_date, baked, up_to_date}));
    ASSERT_EQ(second.observer.reasons.size(), 3U);
    EXPECT_TRUE(second.observer.reasons[0].empty());
    EXPECT_EQ(second.observer.reasons[1],
              (std::vector<std::string>{
                  "atmosphere.ground_albedo [0.3, 0.3, 0.3] → [0.125, 0.125, 0.125]"}));
    const auto after = time_stamps(folder / "out");
    EXPECT_EQ(after.at("transmittance.exr"), before.at("transmittance.exr"));
    EXPECT_NE(after.at("multiple_scattering.exr"), before.at("multiple_scattering.exr"));
}

// Smoke, whose colours four wavelengths do not tell. All assets have the same, which is said once.
TEST(BakeFolders, WhatAssetsShareIsSaidOnce) {
    const TemporaryFolder folder;
    const std::string sky = "asset = 'environment'\nsize = [4, 2]\nsun_elevation = '20 deg'\n";
    TestBake bake(recipe_of("preset = 'earth'\n[atmosphere.layers.aerosol]\noptical_depth = 0.6\n"
                            "angstrom_exponent = 1.6\nsingle_scattering_albedo = 0.86\n[bake.a]\n" +
                            sky + "[bake.b]\n" + sky),
                  folder / "out");
    bake.bake.certification = Certification::quick;
    const auto baked = bake.run();
    ASSERT_TRUE(baked.value);
    int warnings = 0;
    for (const auto& diagnostic : baked.diagnostics) {
        if (diagnostic.code == "W0222") ++warnings;
    }
    EXPECT_EQ(warnings, 1);
    for (const FinishedAsset& asset : baked.value->assets) {
        EXPECT_NE(asset.entry.error->advice.find("best 8"), std::string::npos) << asset.entry.name;
    }
}

TEST_F(BakeFolder, ADamagedMissingOrForeignFileIsMadeAgain) {
    EXPECT_TRUE(bake.run().value);
    const fs::path table = folder / "out/transmittance.exr";
    const std::string whole = read_bytes(table);
    std::string damaged = whole;
    damaged[damaged.size() / 2] ^= 1;
    write_bytes(table, damaged);
    fs::remove(folder / "out/shape.bin");
    EXPECT_EQ(bake.states(), (States{baked, up_to_date, baked}));
    EXPECT_EQ(bake.observer.reasons[0],
              (std::vector<std::string>{"transmittance.exr does not match manifest.json"}));
    EXPECT_EQ(bake.observer.reasons[2], (std::vector<std::string>{"shape.bin cannot be read"}));
    EXPECT_EQ(read_bytes(table), whole);
}

// Outputs, the manifest that claims them among them, moved out of the folder and linked to.
void link_outputs(const fs::path& folder, const fs::path& far) {
    fs::create_directory(far);
    for (const char* name : {"transmittance.exr", "shape.exr", "shape.bin", "manifest.json"}) {
        fs::rename(folder / name, far / name);
        fs::create_symlink(far / name, folder / name);
    }
}

TEST_F(BakeFolder, LinksAreReplacedAndNotFollowed) {
    AssetCache cache(folder / "cache");
    EXPECT_TRUE(bake.run().value);
    link_outputs(folder / "out", folder / "far");
    std::map<std::string, std::string> before;
    for (const auto& file : fs::directory_iterator(folder / "far")) {
        before[file.path().filename()] = read_bytes(file.path());
    }
    const std::vector<std::string> other = {"atmosphere.layers.mie.scale_height=1 km",
                                            "noise.shape.seed=9"};
    TestBake changed = with(other);
    changed.bake.sources = {&cache};
    EXPECT_EQ(changed.states(), (States{baked, baked, baked}));
    for (const auto& [name, bytes] : before) {
        EXPECT_EQ(read_bytes(folder / "far" / name), bytes) << name;
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "out" / name))) << name;
        EXPECT_NE(read_bytes(folder / "out" / name), bytes) << name;
    }

    // Nor by copies from a cache.
    EXPECT_TRUE(with({}, "second").run().value);
    link_outputs(folder / "second", folder / "further");
    TestBake copied_there = with(other, "second");
    copied_there.bake.sources = {&cache};
    EXPECT_EQ(copied_there.states(), (States{copied, copied, copied}));
    for (const auto& [name, bytes] : before) {
        if (name == "manifest.json") continue;  // it holds times
        EXPECT_EQ(read_bytes(folder / "further" / name), bytes) << name;
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "second" / name))) << name;
    }
}

// Without a manifest that claims them, by --force alone.
TEST_F(BakeFolder, ForceReplacesLinksAndNotTheirTargets) {
    write_bytes(folder / "far", "of somebody else");
    fs::create_directory(folder / "out");
    const std::vector<std::string> names = {"transmittance.exr", "shape.bin", "manifest.json"};
    for (const std::string& name : names) fs::create_symlink("../far", folder / "out" / name);
    EXPECT_EQ(first_code(bake.run().diagnostics), "E0303");
    bake.bake.force = true;
    EXPECT_EQ(bake.states(), (States{baked, baked, baked}));
    EXPECT_EQ(read_bytes(folder / "far"), "of somebody else");
    for (const std::string& name : names) {
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "out" / name))) << name;
    }
}

// A bake that was killed before its manifest got its name leaves a journal. It is believed of files that
// are as it says, up to where it ends, and of no others.
TEST(BakeFolders, AJournalTellsWhatAKilledBakeHadNamed) {
    const TemporaryFolder folder;
    TestBake bake(recipe_of(small_recipe), folder.path());
    ASSERT_TRUE(bake.run().value);
    const std::string text = read_bytes(folder / "manifest.json");
    const std::string journal = ".manifest.json.skybake-1-0.tmp";
    const auto killed = [&](const std::string& told) {
        fs::remove(folder / "manifest.json");
        write_bytes(folder / journal, told);
    };
    killed(text);
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, up_to_date}));
    EXPECT_EQ(folder.names(),
              (std::vector<std::string>{"manifest.json", "multiple_scattering.exr", "shape.bin",
                                        "shape.exr", "transmittance.exr"}));
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, up_to_date}));
    killed(text + text.substr(0, text.size() / 2));
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, up_to_date}));

    // Half of an asset's files: they are skybake's, and it is made again.
    killed(text);
    fs::remove(folder / "shape.bin");
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, baked}));

    // A file of somebody else, and a journal that somebody has changed.
    killed(text);
    write_bytes(folder / "transmittance.exr", "of somebody else");
    EXPECT_EQ(first_code(bake.run().diagnostics), "E0303");
    EXPECT_EQ(read_bytes(folder / "transmittance.exr"), "of somebody else");
    fs::remove(folder / "transmittance.exr");
    std::string changed = text;
    changed.replace(changed.find("\"kind\": \""), 9, "\"kind\": \"x");
    killed(changed);
    EXPECT_EQ(first_code(bake.run().diagnostics), "E0303");
}

// Another recipe finds the files that a killed bake has named, and may prune them.
TEST(BakeFolders, AJournalsFilesAreRetired) {
    const TemporaryFolder folder;
    TestBake bake(recipe_of(small_recipe), folder.path());
    ASSERT_TRUE(bake.run().value);
    fs::rename(folder / "manifest.json", folder / ".manifest.json.skybake-1-0.tmp");
    TestBake other(recipe_of("preset = 'earth_hillaire'\n[bake.transmittance]\nsize = [32, 8]\n"),
                   folder.path());
    other.bake.prune = true;
    EXPECT_EQ(other.states(), States{up_to_date});
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"manifest.json", "transmittance.exr"}));
}

TEST_F(BakeFolder, LeftOversGoWhereNothingIsStale) {
    EXPECT_TRUE(bake.run().value);
    const auto before = time_stamps(folder / "out");
    write_bytes(folder / "out/.transmittance.exr.skybake-1-0.tmp", "half");
    write_bytes(folder / "out/.of_another_recipe.exr.skybake-1-0.tmp", "half");
    EXPECT_EQ(bake.states(), (States{up_to_date, up_to_date, up_to_date}));
    EXPECT_EQ(time_stamps(folder / "out"), before);
}

TEST_F(BakeFolder, IncrementalAndCleanBakesEndWithTheSameFiles) {
    const std::vector<std::string> settings = {"atmosphere.ground_albedo=0.7",
                                               "noise.shape.seed=9"};
    EXPECT_TRUE(with({}, "grown").run().value);
    EXPECT_TRUE(with(settings, "grown").run().value);
    EXPECT_TRUE(with(settings, "clean").run().value);
    for (const char* file :
         {"transmittance.exr", "multiple_scattering.exr", "shape.exr", "shape.bin"}) {
        EXPECT_EQ(read_bytes(folder / "grown" / file), read_bytes(folder / "clean" / file)) << file;
    }
}

TEST_F(BakeFolder, AnotherCertificationIsAnotherAsset) {
    EXPECT_TRUE(bake.run().value);
    bake.bake.certification = Certification::off;
    EXPECT_EQ(bake.states(), (States{baked, baked, baked}));
    EXPECT_EQ(bake.observer.reasons[0], (std::vector<std::string>{"--certify quick → off"}));
}

// A noise beyond what unorm8 holds: found after the tables have been baked.
const std::vector<std::string> failing = {"noise.shape.channels.Y.type=constant",
                                          "noise.shape.channels.Y.value=2",
                                          "bake.shape.pixel_type=unorm8", "bake.shape.formats=bin"};

TEST_F(BakeFolder, AFailureLeavesOutItsAssetAlone) {
    EXPECT_TRUE(bake.run().value);
    const auto before = time_stamps(folder / "out");
    std::vector<std::string> settings = failing;
    settings.push_back("atmosphere.ground_albedo=0.1");
    TestBake bad = with(settings);
    bad.bake.prune = true;
    const auto outcome = bad.run();
    ASSERT_FALSE(outcome.diagnostics.empty());
    // A table this small is warned of before.
    EXPECT_EQ(outcome.diagnostics.back().code, "E0402");
    ASSERT_TRUE(outcome.value.has_value());
    ASSERT_EQ(outcome.value->assets.size(), 2U);
    EXPECT_EQ(outcome.value->assets[0].state, AssetState::up_to_date);
    EXPECT_EQ(outcome.value->assets[1].state, AssetState::baked);
    // The folder's files of the asset stay, and so does its entry.
    const auto after = time_stamps(folder / "out");
    for (const char* file : {"shape.exr", "shape.bin", "transmittance.exr"}) {
        EXPECT_EQ(after.at(file), before.at(file)) << file;
    }
    EXPECT_NE(after.at("multiple_scattering.exr"), before.at("multiple_scattering.exr"));
    TestBake again = with({"atmosphere.ground_albedo=0.1"});
    EXPECT_EQ(again.states(), (States{up_to_date, up_to_date, up_to_date}));
}

TEST_F(BakeFolder, WithoutAnyAssetTheFolderStaysAsItWas) {
    const auto only_shape = [&](const std::vector<std::string>& settings) {
        auto bake =
            std::make_unique<TestBake>(recipe_of(small_recipe, {}, settings), folder / "new/deep");
        std::erase_if(bake->bake.bakes, [](const auto& one) { return one.name != "shape"; });
        return bake;
    };
    EXPECT_FALSE(only_shape(failing)->run().value.has_value());
    EXPECT_FALSE(fs::exists(folder / "new"));
    EXPECT_TRUE(only_shape({})->run().value.has_value());
    const auto before = time_stamps(folder / "new/deep");
    EXPECT_FALSE(only_shape(failing)->run().value.has_value());
    EXPECT_EQ(time_stamps(folder / "new/deep"), before);
}

TEST_F(BakeFolder, AnInterruptionLeavesTheFolderAsItWas) {
    for (const char* asset : {"transmittance", "multiple_scattering", "shape", "manifest.json"}) {
        bake.observer = RememberingObserver();
        bake.observer.cancel_at = asset;
        const auto outcome = bake_folder(bake.bake, bake.observer);
        EXPECT_FALSE(outcome.value.has_value()) << asset;
        EXPECT_TRUE(outcome.diagnostics.empty()) << asset;
        EXPECT_EQ(folder.names(), std::vector<std::string>{}) << asset;
    }
}

TEST_F(BakeFolder, WhatARecipeNoLongerAsksForStaysAndMayComeBack) {
    EXPECT_TRUE(bake.run().value);
    TestBake less = with({"bake.shape.formats=exr"});
    const auto first = test::without_errors(less.run());
    ASSERT_EQ(first.retired.size(), 1U);
    EXPECT_EQ(first.retired[0].path, "shape.bin");
    EXPECT_TRUE(fs::exists(folder / "out/shape.bin"));
    EXPECT_EQ(less.run().value->manifest, WriteResult::unchanged);
    const auto back = bake.run();
    ASSERT_TRUE(back.value.has_value());  // no file of somebody else's
    EXPECT_TRUE(back.value->retired.empty());
    EXPECT_TRUE(less.run().value);
    fs::remove(folder / "out/shape.bin");
    EXPECT_TRUE(less.run().value->retired.empty());
}

// Two tables, and a noise that leaves the recipe: shape.exr and shape.bin are retired.
const std::string two_tables = R"(
preset = "earth_hillaire"
[bake.transmittance]
size = [16, 8]
[bake.depth]
asset = "transmittance"
content = "optical_depth"
size = [16, 8]
)";
const std::string and_a_noise = R"(
[noise.shape.channels.Y]
type = "worley"
frequency = 2
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [8, 8, 8]
formats = ["exr", "bin"]
)";

class Pruning : public ::testing::Test {
  protected:
    Pruning() {
        less.bake.certification = Certification::off;
        less.bake.prune = true;
        TestBake all(recipe_of(two_tables + and_a_noise), folder / "out");
        all.bake.certification = Certification::off;
        EXPECT_TRUE(all.run().value);
    }
    bool has(const char* name) const {
        return fs::exists(fs::symlink_status(folder / "out" / name));
    }

    const TemporaryFolder folder;
    TestBake less{recipe_of(two_tables), folder / "out"};
};

std::vector<std::string> paths_of(const std::vector<RetiredFile>& files) {
    std::vector<std::string> paths;
    for (const RetiredFile& file : files) paths.push_back(file.path);
    return paths;
}

TEST_F(Pruning, RemovesRetiredFiles) {
    const auto plan = plan_folder(less.bake);
    ASSERT_TRUE(plan.value.has_value());
    EXPECT_EQ(paths_of(plan.value->pruned), (std::vector<std::string>{"shape.exr", "shape.bin"}));
    EXPECT_TRUE(has("shape.exr"));  // a plan changes nothing
    const auto outcome = test::without_errors(less.run());
    EXPECT_EQ(paths_of(outcome.pruned), (std::vector<std::string>{"shape.exr", "shape.bin"}));
    EXPECT_TRUE(outcome.retired.empty());
    EXPECT_FALSE(has("shape.exr") || has("shape.bin"));
    EXPECT_TRUE(has("transmittance.exr"));
    EXPECT_TRUE(read_manifest(folder / "out").value->retired.empty());
}

TEST_F(Pruning, KeepsWhatWasChangedByHand) {
    write_bytes(folder / "out/shape.bin", "painted over");
    const std::string elsewhere = (folder / "elsewhere.exr").string();
    fs::rename(folder / "out/shape.exr", elsewhere);
    fs::create_symlink(elsewhere, folder / "out/shape.exr");
    write_bytes(folder / "out/mine.bin", "mine");
    const auto outcome = test::without_errors(less.run());
    EXPECT_TRUE(outcome.pruned.empty());
    EXPECT_EQ(paths_of(outcome.retired), (std::vector<std::string>{"shape.exr", "shape.bin"}));
    EXPECT_TRUE(has("shape.exr") && has("shape.bin") && has("mine.bin"));
    EXPECT_TRUE(fs::exists(elsewhere));
}

// A bake of a part keeps the entries that it does not name, whether the recipe has them or not.
TEST_F(Pruning, APartRemovesNothingElse) {
    less.bake.bakes = {less.recipe.parameters.bakes[0]};
    const auto outcome = test::without_errors(less.run());
    EXPECT_TRUE(outcome.pruned.empty());
    EXPECT_TRUE(has("shape.exr") && has("depth.exr"));
}

// A bake leaves plain files alone: a manifest that names one in a folder was altered.
TEST_F(Pruning, StaysInTheFolder) {
    std::string manifest = read_bytes(folder / "out/manifest.json");
    fs::create_directory(folder / "out/deeper");
    fs::rename(folder / "out/shape.bin", folder / "out/deeper/shape.bin");
    const std::size_t at = manifest.find("\"shape.bin\"");
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, 11, "\"deeper/shape.bin\"");
    write_bytes(folder / "out/manifest.json", manifest);
    const auto outcome = less.run();
    ASSERT_TRUE(outcome.value.has_value());
    EXPECT_TRUE(has("deeper/shape.bin"));
}

// Time is booked where it is spent, none of it twice, and none on a certificate that is not made.
TEST(BakeFolders, BooksTheTimeOfEachPart) {
    const TemporaryFolder folder;
    const std::string sky =
        "wavelengths = 'best 3'\n[bake.psi]\nasset = 'multiple_scattering'\nmethod = 'solved'\n"
        "size = [8, 8]\n[bake.view]\nasset = 'sky_view'\nsun_elevations = ['5 deg']\n"
        "size = [8, 8]\n"
        "[bake.sun]\nasset = 'transmittance'\nsize = [8, 8]\n";
    TestBake bake(recipe_of("preset = 'earth'\n" + sky), folder / "out");
    bake.bake.certification = Certification::off;
    const auto started = std::chrono::steady_clock::now();
    const auto outcome = bake.run();
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - started;
    ASSERT_TRUE(outcome.value.has_value());
    double sum = 0;
    for (const FinishedAsset& asset : outcome.value->assets) {
        const BakeSeconds& spent = asset.entry.timing.bake;
        EXPECT_GT(spent.texels, 0) << asset.entry.name;
        EXPECT_EQ(spent.certificate, 0) << asset.entry.name;
        sum += spent.made() + asset.entry.timing.write_s;
    }
    EXPECT_LE(sum, all.count());
    const auto spent = [&](std::size_t i) { return outcome.value->assets[i].entry.timing.bake; };
    EXPECT_GT(spent(0).light, 0);
    EXPECT_GT(spent(0).colors, 0);
    EXPECT_EQ(spent(2).light, 0) << "a transmittance needs no light";
    EXPECT_EQ(spent(2).colors, 0) << "and has no colours";
}

TEST_F(BakeFolder, BooksCertificatesApart) {
    const auto outcome = test::without_errors(bake.run());
    for (const FinishedAsset& asset : outcome.assets) {
        EXPECT_GT(asset.entry.timing.bake.certificate, 0);
        EXPECT_GT(asset.entry.timing.bake.texels, 0);
    }
}

TEST_F(BakeFolder, APartialBakeKeepsTheOtherEntries) {
    EXPECT_TRUE(bake.run().value);
    bake.bake.bakes = {bake.recipe.parameters.bakes[1]};
    EXPECT_EQ(bake.states(), (States{up_to_date}));
    EXPECT_EQ(read_manifest(folder / "out").value->assets.size(), 3U);
    TestBake other = with({"atmosphere.ground_albedo=0.1"});
    other.bake.bakes = {other.recipe.parameters.bakes[0]};
    const auto mixed = other.run();
    ASSERT_TRUE(mixed.value.has_value());
    ASSERT_EQ(mixed.diagnostics.size(), 1U);  // multiple scattering, not the noise
    EXPECT_EQ(mixed.diagnostics[0].code, "W0303");
    EXPECT_NE(mixed.diagnostics[0].message.find("ground_albedo"), std::string::npos);
}

TEST(BakeFolders, APictureThatChangesDuringTheBakeIsNoticed) {
    const TemporaryFolder folder;
    const auto picture = [](const char* name) {
        return read_bytes(fs::path(SKYBAKE_TEST_DATA) / "maps" / name);
    };
    write_bytes(folder / "coverage.png", picture("grey16.png"));
    const std::string text =
        "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 4\n[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1 km\"]\ncoverage_map = { file = \"coverage.png\" }\n"
        "[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\n"
        "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [8, 8, 4]\n"
        "formats = \"bin\"\n";
    TestBake bake(recipe_of(text, folder.path()), folder / "out");
    // After the plan, before the cloud is baked.
    class Changer : public RememberingObserver {
      public:
        explicit Changer(std::function<void()> change) : change_(std::move(change)) {}
        std::unique_ptr<Progress> begin(std::string_view asset) override {
            if (asset == "c") change_();
            return RememberingObserver::begin(asset);
        }

      private:
        std::function<void()> change_;
    };
    Changer changer([&] { write_bytes(folder / "coverage.png", picture("grey2.png")); });
    const auto outcome = bake_folder(bake.bake, changer);
    ASSERT_TRUE(outcome.value.has_value());
    ASSERT_EQ(outcome.value->assets.size(), 1U);
    EXPECT_EQ(outcome.value->assets[0].entry.name, "n");
    EXPECT_EQ(outcome.diagnostics.at(0).code, "E0300");
    EXPECT_FALSE(fs::exists(folder / "out/c.bin"));
    EXPECT_EQ(bake.states(), (States{up_to_date, baked}));
}

TEST_F(BakeFolder, RefusesWhatNeedsMoreMemoryThanAllowed) {
    bake.bake.memory_limit_mib = 0.001;
    const auto outcome = bake.run();
    ASSERT_FALSE(outcome.value.has_value());
    EXPECT_EQ(outcome.diagnostics.at(0).code, "E0002");
    EXPECT_FALSE(fs::exists(folder / "out"));
    bake.bake.memory_limit_mib = 1e6;
    ASSERT_TRUE(bake.run().value.has_value());
    // Assets that are up to date need none.
    bake.bake.memory_limit_mib = 0;
    EXPECT_TRUE(bake.run().value.has_value());
}

TEST_F(BakeFolder, TakesWhatACacheHasAndBakesWhatIsDamagedThere) {
    AssetCache cache(folder / "cache");
    TestBake first = with({}, "first");
    first.bake.sources = {&cache};
    EXPECT_EQ(first.states(), (States{baked, baked, baked}));
    TestBake second = with({}, "second");
    second.bake.sources = {&cache};
    EXPECT_EQ(second.states(), (States{copied, copied, copied}));
    for (const auto& entry : fs::recursive_directory_iterator(folder / "cache")) {
        if (entry.path().filename() == "shape.exr") write_bytes(entry.path(), "damaged");
    }
    TestBake third = with({}, "third");
    third.bake.sources = {&cache};
    EXPECT_EQ(third.states(), (States{copied, copied, baked}));
    EXPECT_EQ(read_bytes(folder / "third/shape.exr"), read_bytes(folder / "first/shape.exr"));
    // The whole one has taken the place of the damaged one.
    TestBake fourth = with({}, "fourth");
    fourth.bake.sources = {&cache};
    EXPECT_EQ(fourth.states(), (States{copied, copied, copied}));
    // A folder that others have filled is offered to a cache as well.
    AssetCache other(folder / "other");
    third.bake.sources = {&other};
    EXPECT_EQ(third.states(), (States{up_to_date, up_to_date, up_to_date}));
    EXPECT_EQ(cache_entries(folder / "other").value->size(), 3U);
}

// Says when it waits.
class WaitingObserver : public testing::RememberingObserver {
  public:
    void waits() override { told.set_value(); }
    std::promise<void> told;
};

TEST(BakeFolders, WaitsForAnotherOneInTheFolder) {
    const TemporaryFolder folder;
    auto lock = FolderLock::acquire(
        folder.path(), [] {}, [] { return false; });
    TestBake bake(recipe_of(small_recipe), folder.path());
    WaitingObserver observer;
    std::thread other([&] { EXPECT_TRUE(bake_folder(bake.bake, observer).value.has_value()); });
    observer.told.get_future().wait();
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
    lock.value.reset();
    other.join();
    EXPECT_EQ(folder.names().size(), 5U);
}

}  // namespace
}  // namespace skybake
