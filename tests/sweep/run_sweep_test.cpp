#include "bakers/workspace/sweep/run_sweep.h"

#include <gtest/gtest.h>

#include <set>

#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/variants.h"
#include "tests/incremental/bakes.h"
#include "tests/sweep/sweeps.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using namespace testing;
using Strings = std::vector<std::string>;

// Six variants that share two noises.
const Strings six = {"noise.n.seed=1,2", "clouds.c.coverage=0.5,0.7,0.9"};

struct Fixture {
    TemporaryFolder folder;
    fs::path recipe = folder / "r.toml";

    Fixture() { write_bytes(recipe, swept_recipe); }
    SweepJob job(const Strings& vary, const std::string& out = "out") const {
        return job_of(recipe, vary, folder / out);
    }
};

int count(const std::vector<VariantResult>& results, VariantStatus status) {
    int number = 0;
    for (const VariantResult& result : results) number += result.status == status ? 1 : 0;
    return number;
}

TEST(RunSweep, MakesEveryVariantAndThenNoneAgain) {
    const Fixture fixture;
    const SweepJob job = fixture.job(six);
    CountingObserver first;
    const auto results = run(job, first);
    EXPECT_EQ(first.made, 6);
    EXPECT_EQ(count(results, VariantStatus::done), 6);
    EXPECT_EQ(results[1].name, "0001_seed=1_coverage=0.7");
    ASSERT_EQ(results[1].assets.size(), 2u);
    EXPECT_TRUE(fs::exists(job.folder / results[1].name / results[1].assets[1].files.at(0)));
    const auto before = files_below(job.folder);
    CountingObserver second;
    EXPECT_EQ(index_csv(job.sweep, run(job, second)), index_csv(job.sweep, results));
    EXPECT_EQ(second.made, 0);
    EXPECT_EQ(second.finished_count, 6);
    EXPECT_EQ(files_below(job.folder), before);
}

TEST(RunSweep, AVariantIsWhatABakeOfItWouldBe) {
    const Fixture fixture;
    const SweepJob job = fixture.job(six);
    const auto results = run(job);
    const auto recipe = config::load_variant(job.recipe, {}, job.sweep, 4);
    ASSERT_TRUE(recipe.value);
    FolderBake bake = variant_bake(job, *recipe.value, "alone");
    RememberingObserver observer;
    ASSERT_TRUE(bake_folder(bake, observer).value);
    EXPECT_EQ(files_below(job.folder / "alone"), files_below(job.folder / results[4].name));
}

// The manifest of a copy has the wall time of the bake that it is a copy of.
TEST(RunSweep, SharedAssetsAreBakedOnce) {
    const Fixture fixture;
    for (const int threads : {1, 3}) {
        SweepJob job = fixture.job(six, "out" + std::to_string(threads));
        job.threads = threads;
        const auto plan = plan_sweep(job, [] { return false; });
        const auto shared = shared_assets(plan);
        ASSERT_EQ(shared.size(), 1u);
        EXPECT_EQ(shared[0].name, "n");
        EXPECT_EQ(shared[0].variants, 6);
        EXPECT_EQ(shared[0].bakes, 2);
        const auto results = run(job);
        std::set<double> noise_times;
        std::set<double> cloud_times;
        for (const VariantResult& result : results) {
            const auto manifest = read_manifest(job.folder / result.name);
            ASSERT_TRUE(manifest.value);
            ASSERT_EQ(manifest.value->assets.size(), 2u);
            EXPECT_EQ(manifest.value->assets[0].name, "n");
            noise_times.insert(manifest.value->assets[0].timing.bake.made());
            cloud_times.insert(manifest.value->assets[1].timing.bake.made());
        }
        EXPECT_EQ(noise_times.size(), 2u);
        EXPECT_EQ(cloud_times.size(), 6u);
    }
}

TEST(RunSweep, ShardsMakeTheSameBytes) {
    const Fixture fixture;
    SweepJob whole = fixture.job(six, "whole");
    ASSERT_TRUE(write_index(whole.folder, whole.sweep, run(whole)).empty());
    SweepJob parts = fixture.job(six, "parts");
    std::vector<int> counts;
    for (int shard = 4; shard >= 1; --shard) {
        SweepJob part = parts;
        part.shard = shard;
        part.shards = 4;
        part.threads = shard;
        const auto results = run(part);
        for (const VariantResult& result : results) EXPECT_EQ(result.index % 4, shard - 1);
        counts.push_back(static_cast<int>(results.size()));
    }
    EXPECT_EQ(counts, (std::vector<int>{1, 1, 2, 2}));
    const auto merged = survey_sweep(parts, plan_sweep(parts, [] { return false; }));
    ASSERT_TRUE(write_index(parts.folder, parts.sweep, merged).empty());
    EXPECT_EQ(files_below(parts.folder), files_below(whole.folder));
}

TEST(RunSweep, AMergeListsWhatIsMissingAndBakesNothing) {
    const Fixture fixture;
    SweepJob job = fixture.job(six);
    SweepJob part = job;
    part.shard = 2;
    part.shards = 2;
    run(part);
    const auto merged = survey_sweep(job, plan_sweep(job, [] { return false; }));
    ASSERT_EQ(merged.size(), 6u);
    EXPECT_EQ(count(merged, VariantStatus::done), 3);
    EXPECT_EQ(count(merged, VariantStatus::missing), 3);
    EXPECT_EQ(merged[0].status, VariantStatus::missing);
    EXPECT_FALSE(fs::exists(job.folder / merged[0].name));
    EXPECT_NE(index_csv(job.sweep, merged).find("0000_seed=1_coverage=0.5,1,0.5,missing"),
              std::string::npos);
}

TEST(RunSweep, AFailingVariantFailsAlone) {
    const Fixture fixture;
    SweepJob job = fixture.job({"clouds.c.coverage=0.5,1.5,0.9"});
    const auto results = run(job);
    EXPECT_EQ(results[0].status, VariantStatus::done);
    ASSERT_EQ(results[1].status, VariantStatus::failed);
    EXPECT_EQ(results[2].status, VariantStatus::done);
    const fs::path folder = job.folder / results[1].name;
    const auto errors = read_failure(folder);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].code, "E0110");
    const auto merged = survey_sweep(job, plan_sweep(job, [] { return false; }));
    EXPECT_EQ(index_jsonl(job.sweep, merged), index_jsonl(job.sweep, results));
    EXPECT_EQ(sweep_json(job.sweep, merged), sweep_json(job.sweep, results));
}

// A baker's own failure: the value is in range, and the file cannot hold what it makes.
TEST(RunSweep, AFailureInABakeIsKeptUntilTheVariantSucceeds) {
    const Fixture fixture;
    const std::string recipe = swept_recipe + "pixel_type = \"half\"\n";
    const Strings vary = {"noise.n.channels.Y.remap=[[0, 1, 0, 1], [0, 1, 0, 1e6]]"};
    write_bytes(fixture.recipe, recipe);
    SweepJob job = fixture.job(vary);
    const auto results = run(job);
    EXPECT_EQ(results[0].status, VariantStatus::done);
    ASSERT_EQ(results[1].status, VariantStatus::failed);
    EXPECT_EQ(results[1].diagnostics.back().code, "E0402");
    const fs::path folder = job.folder / results[1].name;
    EXPECT_TRUE(fs::exists(folder / failure_name));
    EXPECT_FALSE(fs::exists(folder / manifest_name));
    const auto merged = survey_sweep(job, plan_sweep(job, [] { return false; }));
    EXPECT_EQ(index_csv(job.sweep, merged), index_csv(job.sweep, results));

    job.settings = {"bake.n.pixel_type=float", "bake.c.pixel_type=float"};
    EXPECT_EQ(count(run(job), VariantStatus::done), 2);
    EXPECT_FALSE(fs::exists(folder / failure_name));
    EXPECT_TRUE(fs::exists(folder / manifest_name));
}

TEST(RunSweep, GoesOnAfterAnInterruption) {
    const Fixture fixture;
    SweepJob job = fixture.job(six);
    job.threads = 1;
    CountingObserver stops(2);
    const auto partial = run(job, stops);
    EXPECT_EQ(count(partial, VariantStatus::done), 2);
    EXPECT_EQ(count(partial, VariantStatus::missing), 4);
    CountingObserver rest;
    EXPECT_EQ(count(run(job, rest), VariantStatus::done), 6);
    EXPECT_EQ(rest.made, 4);
    SweepJob fresh = fixture.job(six, "fresh");
    run(fresh);
    EXPECT_EQ(files_below(job.folder), files_below(fresh.folder));
}

TEST(RunSweep, DamageAndChangesAreMadeGood) {
    const Fixture fixture;
    SweepJob job = fixture.job(six);
    const auto results = run(job);
    const auto before = files_below(job.folder);
    write_bytes(job.folder / results[3].name / "n.exr", "damaged");
    CountingObserver mends;
    run(job, mends);
    EXPECT_EQ(mends.made, 1);
    EXPECT_EQ(files_below(job.folder), before);
    // A key that no asset depends on is in the manifests all the same.
    job.settings = {"noise.n.size=[16, 16, 16]"};
    CountingObserver rewrites;
    run(job, rewrites);
    EXPECT_EQ(rewrites.made, 6);
    SweepJob fresh = fixture.job(six, "fresh");
    fresh.settings = job.settings;
    run(fresh);
    EXPECT_EQ(files_below(job.folder), files_below(fresh.folder));
}

// An index lists variants of one recipe.
TEST(RunSweep, ARecipeThatChangesMeanwhileFailsWhatIsNotMade) {
    const Fixture fixture;
    const SweepJob job = fixture.job(six);
    auto plan = plan_sweep(job, [] { return false; });
    write_bytes(fixture.recipe, swept_recipe + "pixel_type = \"float\"\n");
    CountingObserver observer;
    const auto results = run_sweep(job, std::move(plan), observer);
    ASSERT_EQ(count(results, VariantStatus::failed), 6);
    EXPECT_EQ(results[0].diagnostics.back().message,
              "the recipe changed while the sweep was running");
    EXPECT_FALSE(fs::exists(job.folder / results[0].name / manifest_name));
    EXPECT_EQ(count(run(job), VariantStatus::done), 6);
}

TEST(RunSweep, VariantsSideBySideKeepWithinTheMemory) {
    const Fixture fixture;
    SweepJob job = fixture.job(six);
    const auto plan = plan_sweep(job, [] { return false; });
    double largest = 0;
    for (const PlannedVariant& variant : plan) largest = std::max(largest, variant.memory_mib);
    job.threads = 4;
    job.memory_limit_mib = largest * 1.5;  // one at a time
    EXPECT_EQ(count(run(job), VariantStatus::done), 6);
    job.folder = fixture.folder / "too_little";
    job.memory_limit_mib = largest * 0.5;
    const auto refused = run(job);
    EXPECT_EQ(count(refused, VariantStatus::failed), 6);
    EXPECT_EQ(refused[0].diagnostics.back().code, "E0002");
}

TEST(SweepIndex, IsCsvThatReadsBack) {
    const config::Sweep sweep = {{{{"a.b"}, {{{"\"x, \\\"y\\\"\"", "x, \"y\""}}}}}};
    VariantResult result;
    result.name = "0000_b";
    result.status = VariantStatus::failed;
    result.diagnostics = {{config::Severity::warning, "W0202", "careful", {}, ""},
                          {config::Severity::error, "E0110", "line\nbreak", {}, ""}};
    EXPECT_EQ(index_csv(sweep, std::array{result}),
              "index,name,a.b,status,error\n"
              "0,0000_b,\"x, \"\"y\"\"\",failed,\"E0110: line\nbreak\"\n");
}

// An asset with two files, whose light was compared or was too dark to be.
VariantResult measured_variant(int sky_points) {
    ManifestAsset entry;
    entry.name = "air";
    entry.kind = "multiple_scattering";
    entry.size = {4, 2};
    entry.content_hash = "c";
    entry.files.resize(2);
    entry.files[0].path = "air.exr";
    entry.files[0].bytes = 1000;
    entry.files[1].path = "air.bin";
    entry.files[1].bytes = 24;
    entry.error.emplace();
    entry.error->lookup = {0.5, 0.25};
    entry.error->texel = {0.125, 0.0625};
    entry.error->sky.emplace();
    entry.error->sky->median = 0.01;
    entry.error->sky->ninth_decile = 0.02;
    entry.error->sky->max = 0.4;
    entry.error->sky->points = sky_points;
    entry.timing.bake.light = 1.5;
    entry.timing.bake.certificate = 0.5;
    entry.timing.write_s = 0.25;
    entry.timing.threads = 2;
    VariantResult result;
    result.index = 3;
    result.name = "0003_b=1,2";
    result.status = VariantStatus::done;
    result.assets = {variant_asset(entry)};
    return result;
}

const config::Sweep one_axis = {
    {{{"a.b"}, {{{"1", "1"}}, {{"2", "2"}}, {{"3", "3"}}, {{"4", "4"}}}}}};

TEST(SweepIndex, HasTheSkysErrorAndBytes) {
    EXPECT_EQ(index_csv(one_axis, std::array{measured_variant(9)}),
              "index,name,a.b,status,error,air.sky_median,air.sky_p90,air.sky_max,air.lookup_max,"
              "air.lookup_rms,air.texel_max,air.texel_rms,air.bytes,air.cover,air.content_hash,"
              "air.files\n"
              "3,\"0003_b=1,2\",4,done,,0.01,0.02,0.4,0.5,0.25,0.125,0.0625,1024,,c,"
              "\"0003_b=1,2/air.exr 0003_b=1,2/air.bin\"\n");
    const auto sky = [](int points) {
        const std::string line = index_jsonl(one_axis, std::array{measured_variant(points)});
        return nlohmann::json::parse(line)["assets"][0]["sky_error"];
    };
    EXPECT_EQ(sky(9),
              nlohmann::json::parse(R"({"median": 0.01, "ninth_decile": 0.02, "max": 0.4})"));
    EXPECT_TRUE(sky(0).is_null()) << "too noisy to tell";
}

TEST(SweepIndex, TimesAreApartFromIt) {
    VariantResult variant = measured_variant(9), slower = variant;
    slower.assets[0].timing.bake.texels = 99;
    EXPECT_EQ(index_csv(one_axis, std::array{variant}), index_csv(one_axis, std::array{slower}));
    EXPECT_EQ(sweep_json(one_axis, std::array{variant}), sweep_json(one_axis, std::array{slower}));
    EXPECT_EQ(timing_csv(std::array{variant}),
              "index,asset,light_s,colors_s,texels_s,certificate_s,write_s,threads,name\n"
              "3,air,1.5,0.0,0.0,0.5,0.25,2,\"0003_b=1,2\"\n");
    variant.status = VariantStatus::missing;
    EXPECT_EQ(timing_csv(std::array{variant}),
              "index,asset,light_s,colors_s,texels_s,certificate_s,write_s,threads,name\n");
}

TEST(SweepIndex, FilesThatAreNotSkybakesAreLeftAlone) {
    const Fixture fixture;
    const SweepJob job = fixture.job(six);
    fs::create_directories(job.folder);
    EXPECT_TRUE(inspect_index(job.folder, false).empty());
    write_bytes(job.folder / "index.csv", "mine");
    ASSERT_EQ(inspect_index(job.folder, false).size(), 1u);
    EXPECT_EQ(inspect_index(job.folder, false)[0].code, "E0303");
    EXPECT_TRUE(inspect_index(job.folder, true).empty());
    write_bytes(job.folder / "sweep.json", "{\"axes\": 3, \"tool\": 4}");
    EXPECT_EQ(inspect_index(job.folder, false).size(), 2u);
    ASSERT_TRUE(write_index(job.folder, job.sweep, {}).empty());
    EXPECT_TRUE(inspect_index(job.folder, false).empty());
    // A bake's folder, which has a manifest of skybake.
    run(job);
    const fs::path variant = job.folder / "0000_seed=1_coverage=0.5";
    ASSERT_EQ(inspect_index(variant, false).size(), 1u);
    EXPECT_EQ(inspect_index(variant, false)[0].code, "E0303");
    EXPECT_TRUE(inspect_index(variant, true).empty());
}

}  // namespace
}  // namespace skybake
