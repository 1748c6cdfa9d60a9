// Tests what assets share: made once, freed after the last, and without a trace in the bytes.
#include "bakers/math/intermediates.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/workspace/bake_folder.h"
#include "bakers/workspace/folder_plan.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

Need need_of_number(int number, double memory_mib = 1) {
    return {NeedKey(number), "a number", 0, memory_mib};
}

// Counts how often a value is made.
class Maker {
  public:
    std::shared_ptr<const int> get(Intermediates& from, int number) {
        return from.get<int>(NeedKey(number), [this, number] {
            ++made_;
            return std::make_shared<const int>(10 * number);
        });
    }
    int made() const { return made_; }

  private:
    std::atomic<int> made_ = 0;
};

TEST(Intermediates, AreMadeOnceAndFreedAfterTheLastUse) {
    Intermediates shared(1 << 20);
    Maker maker;
    Intermediates::Expected first = shared.expect({need_of_number(3)});
    Intermediates::Expected second = shared.expect({need_of_number(3), need_of_number(3)});
    EXPECT_EQ(shared.kept_bytes(), 0);
    const std::weak_ptr<const int> value = maker.get(shared, 3);
    EXPECT_EQ(*maker.get(shared, 3), 30);
    EXPECT_EQ(maker.made(), 1);
    EXPECT_EQ(shared.kept_bytes(), 1 << 20);
    first = {};
    EXPECT_FALSE(value.expired());
    second = {};
    EXPECT_TRUE(value.expired());
    EXPECT_EQ(shared.kept_bytes(), 0);
}

TEST(Intermediates, OfOneTypeAndValueAreTheSame) {
    EXPECT_EQ(NeedKey(3), NeedKey(3));
    EXPECT_FALSE(NeedKey(3) == NeedKey(4));
    EXPECT_FALSE(NeedKey(3) == NeedKey(3.0)) << "of another type";
    EXPECT_EQ(NeedKey(std::string("air")), NeedKey(std::string("air")));
}

TEST(Intermediates, ThatNobodyExpectsOrThatDoNotFitAreMadeEachTime) {
    Intermediates shared(1 << 20);
    Maker maker;
    EXPECT_EQ(*maker.get(shared, 1), 10);
    EXPECT_EQ(*maker.get(shared, 1), 10);
    EXPECT_EQ(maker.made(), 2);
    const auto large = shared.expect({need_of_number(2, 2)});
    maker.get(shared, 2);
    maker.get(shared, 2);
    EXPECT_EQ(maker.made(), 4);
    EXPECT_EQ(shared.kept_bytes(), 0);
}

TEST(Intermediates, ThatWereInterruptedAreMadeByTheNextThatAsks) {
    Intermediates shared(1 << 20);
    Maker maker;
    const auto expected = shared.expect({need_of_number(5)});
    const auto none =
        shared.get<int>(NeedKey(5), []() -> std::shared_ptr<const int> { return {}; });
    EXPECT_EQ(none, nullptr);
    EXPECT_THROW(
        shared.get<int>(NeedKey(5), []() -> std::shared_ptr<const int> { throw std::bad_alloc(); }),
        std::bad_alloc);
    EXPECT_EQ(*maker.get(shared, 5), 50);
}

TEST(Intermediates, AreMadeByOneOfSeveralThreads) {
    Intermediates shared(1 << 20);
    Maker maker;
    const auto expected = shared.expect({need_of_number(7, 0.01)});
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&] { EXPECT_EQ(*maker.get(shared, 7), 70); });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(maker.made(), 1);
}

constexpr const char* kSky = R"(preset = "earth_hillaire"
[bake.view]
asset = "sky_view"
sun_elevations = ["5 deg"]
size = [16, 12]
[bake.mie]
asset = "sky_view"
orders = "single"
layers = ["mie"]
sun_elevations = ["5 deg"]
size = [16, 12]
[bake.ground]
asset = "irradiance"
size = [8, 4]
[bake.psi]
asset = "multiple_scattering"
method = "solved"
content = "moments"
size = [8, 8]
[bake.mean]
asset = "multiple_scattering"
method = "solved"
size = [8, 8]
[bake.once]
asset = "bruneton"
table = "single_mie"
size = [32, 8, 4]
nu_size = 4
[bake.table]
asset = "bruneton"
size = [32, 8, 4]
nu_size = 4
)";

using Hashes = std::map<std::string, std::string>;

Hashes baked(const std::filesystem::path& folder, const config::Recipe& recipe,
             std::vector<config::Bake> bakes) {
    testing::TestBake bake(recipe, folder);
    bake.bake.bakes = std::move(bakes);
    bake.bake.certification = Certification::off;
    const auto result = bake.run();
    Hashes hashes;
    if (!result.value) return hashes;
    for (const FinishedAsset& asset : result.value->assets) {
        hashes[asset.entry.name] = asset.entry.content_hash;
    }
    return hashes;
}

// A key that leaves something out would give an asset what another one needs.
TEST(Intermediates, LeaveNoTraceInTheBytesOfAssets) {
    const config::Recipe recipe = testing::recipe_of(kSky);
    const std::vector<config::Bake>& bakes = recipe.parameters.bakes;
    const testing::TemporaryFolder folder;
    const Hashes whole = baked(folder.path() / "whole", recipe, bakes);
    ASSERT_EQ(whole.size(), bakes.size());
    const Hashes reversed =
        baked(folder.path() / "reversed", recipe, {bakes.rbegin(), bakes.rend()});
    EXPECT_EQ(reversed, whole);
    for (const config::Bake& bake : bakes) {
        const Hashes alone = baked(folder.path() / bake.name, recipe, {bake});
        EXPECT_EQ(alone.at(bake.name), whole.at(bake.name)) << bake.name;
    }
}

// Bakes as the variants of a sweep are baked: one after the other, or side by side.
TEST(Intermediates, AreMadeOnceForSeveralFolders) {
    const testing::TemporaryFolder folder;
    std::vector<config::Recipe> recipes;
    for (const int width : {8, 10, 12}) {
        recipes.push_back(
            testing::recipe_of(kSky, {}, {"bake.view.size=[" + std::to_string(width) + ", 8]"}));
    }
    Intermediates shared(std::int64_t{1} << 30);
    std::vector<Intermediates::Expected> expected;
    std::vector<FolderBake> bakes;
    for (const config::Recipe& recipe : recipes) {
        FolderBake& bake = bakes.emplace_back();
        bake.recipe = &recipe;
        bake.bakes = {recipe.parameters.bakes.front()};
        bake.folder = folder.path() / std::to_string(bakes.size());
        bake.certification = Certification::off;
        bake.threads = 1;
        bake.intermediates = &shared;
        expected.push_back(
            shared.expect(baker_of(bake.bakes.front())
                              .needs(recipe.parameters, bake.bakes.front(), Certification::off)));
    }
    std::vector<std::thread> threads;
    for (const FolderBake& bake : bakes) {
        threads.emplace_back([&bake] {
            testing::RememberingObserver observer;
            EXPECT_TRUE(bake_folder(bake, observer).value);
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(shared.made(), 2) << "the light and the table of sunlight";
    EXPECT_GT(shared.kept_bytes(), 0);
    expected.clear();
    EXPECT_EQ(shared.kept_bytes(), 0);
}

// The parts of one set of harmonics are of one solution; another sun or another rounding of the
// voxels has its own.
TEST(Intermediates, PartsOfACloudsRadianceShareTheirSolution) {
    std::string text =
        "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 2\n[clouds.c]\nnoise = 'n'\n"
        "extent = ['1 km', '1 km', '0.5 km']\ncoverage = 0.8\n";
    for (const char* type : {"half", "float"}) {
        text += fmt::format(
            "[bake.{}]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [8, 8, 4]\n"
            "pixel_type = '{}'\n",
            type, type);
    }
    const auto add = [&text](const char* name, const char* of, int part, int sun) {
        text += fmt::format(
            "[bake.{}]\nasset = 'cloud_light'\nof = '{}'\ncontents = 'sun_radiance'\n"
            "sun_elevations = '{} deg'\ndegree = 3\npart = {}\ncell = 2\n",
            name, of, sun, part);
    };
    add("first", "half", 1, 40);
    add("second", "half", 2, 40);
    add("lower", "half", 1, 20);
    add("rounded", "float", 1, 40);
    const config::Recipe recipe = testing::recipe_of(text);
    const testing::TemporaryFolder folder;
    const testing::TestBake bake(recipe, folder / "plan");
    const auto plan = plan_folder(bake.bake);
    ASSERT_TRUE(plan.value);
    std::multiset<std::size_t> users;
    for (const PlannedIntermediate& one : plan.value->intermediates()) {
        if (one.need.name.starts_with("radiance in ")) users.insert(one.users.size());
    }
    EXPECT_EQ(users, (std::multiset<std::size_t>{1, 1, 2}));
    const Hashes whole = baked(folder.path() / "whole", recipe, recipe.parameters.bakes);
    for (const config::Bake& one : recipe.parameters.bakes) {
        const Hashes alone = baked(folder.path() / one.name, recipe, {one});
        EXPECT_EQ(alone.at(one.name), whole.at(one.name)) << one.name;
    }
    EXPECT_NE(whole.at("rounded"), whole.at("first"));
}

// A table of multiple scattering is made of the sky's own light, and certified by it.
TEST(Intermediates, OfASkyAreOneLightItsSunlightAndItsColours) {
    const config::Recipe recipe = testing::recipe_of(
        "preset = 'earth'\nwavelengths = 'best 3'\n[bake.transmittance]\nsize = [8, 8]\n"
        "[bake.psi]\nasset = 'multiple_scattering'\nmethod = 'solved'\nsize = [8, 8]\n"
        "[bake.sky_view]\nsun_elevations = ['5 deg']\nsize = [8, 8]\n");
    const testing::TemporaryFolder folder;
    Intermediates shared(std::int64_t{1} << 30);
    const auto made_for = [&](std::vector<config::Bake> bakes, const char* name,
                              Certification certification) {
        const int before = shared.made();
        testing::TestBake bake(recipe, folder / name);
        bake.bake.bakes = std::move(bakes);
        bake.bake.certification = certification;
        bake.bake.intermediates = &shared;
        EXPECT_TRUE(bake.run().value) << name;
        return shared.made() - before;
    };
    const std::vector<config::Bake>& bakes = recipe.parameters.bakes;
    EXPECT_EQ(made_for(bakes, "sky", Certification::quick), 3);
    EXPECT_EQ(made_for({bakes[0]}, "sun", Certification::off), 0);
    EXPECT_EQ(made_for({bakes[0]}, "sun certified", Certification::quick), 0);
}

TEST(Intermediates, OfARecipeArePlannedByTheirUsers) {
    const config::Recipe recipe = testing::recipe_of(kSky);
    const testing::TemporaryFolder folder;
    testing::TestBake bake(recipe, folder / "out");
    bake.bake.certification = Certification::off;
    const auto plan = plan_folder(bake.bake);
    ASSERT_TRUE(plan.value);
    std::map<std::string, std::set<std::string>> users;
    for (const PlannedIntermediate& one : plan.value->intermediates()) {
        for (const std::string& asset : one.users) users[one.need.name].insert(asset);
    }
    using Names = std::set<std::string>;
    EXPECT_EQ(users.at("solved light"), (Names{"view", "ground", "psi", "mean", "table"}));
    EXPECT_EQ(users.at("table of sunlight"), (Names{"view", "mie", "ground", "once", "table"}));
    EXPECT_EQ(users.at("light scattered once"), (Names{"once", "table"}));
}

}  // namespace
}  // namespace skybake
