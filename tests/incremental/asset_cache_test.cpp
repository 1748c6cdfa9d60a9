#include "bakers/workspace/asset_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/verify.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
namespace fs = std::filesystem;

class Cache : public ::testing::Test {
  protected:
    Cache() { EXPECT_TRUE(bake_.run().value); }

    ReadyAsset asset(std::size_t i) const {
        return {bake_.bake.folder, read_manifest(bake_.bake.folder).value->assets.at(i)};
    }

    TemporaryFolder folder_;
    TestBake bake_{recipe_of(small_recipe), folder_ / "out"};
    AssetCache cache_{folder_ / "cache"};
};

TEST_F(Cache, GivesBackWhatItWasOffered) {
    EXPECT_FALSE(cache_.find(asset(0).entry.key).has_value());
    EXPECT_FALSE(fs::exists(folder_ / "cache"));  // looking makes nothing
    cache_.offer(asset(0));
    const auto found = cache_.find(asset(0).entry.key);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->entry.content_hash, asset(0).entry.content_hash);
    EXPECT_EQ(read_bytes(found->folder / "transmittance.exr"),
              read_bytes(folder_ / "out/transmittance.exr"));
    EXPECT_FALSE(cache_.find(asset(1).entry.key).has_value());
    EXPECT_TRUE(verify_bake(found->folder, {}, {}).value->failures.empty());
    EXPECT_TRUE(fs::is_empty(folder_ / "cache/pending"));
}

TEST_F(Cache, AKeyLeadsNowhereElse) {
    for (const std::string& key : {std::string("../../out"), std::string(), std::string("/etc"),
                                   std::string(32, 'g'), std::string(31, 'a') + "/"}) {
        EXPECT_FALSE(cache_.find(key).has_value()) << key;
        ReadyAsset hostile = asset(0);
        hostile.entry.key = key;
        cache_.offer(hostile);
    }
    EXPECT_FALSE(fs::exists(folder_ / "cache"));
}

TEST_F(Cache, DoesNotKeepWhatIsNotWhatItsManifestSays) {
    write_bytes(folder_ / "out/transmittance.exr", "damaged");
    cache_.offer(asset(0));
    EXPECT_FALSE(cache_.find(asset(0).entry.key).has_value());
    ASSERT_EQ(cache_.problems().size(), 1U);
    EXPECT_EQ(cache_.problems()[0].code, "W0301");
    EXPECT_EQ(cache_.problems()[0].severity, config::Severity::warning);
}

TEST_F(Cache, ManyAtOnceEndWithWholeEntries) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([this] {
            AssetCache cache(folder_ / "cache");
            for (std::size_t k = 0; k < 3; ++k) cache.offer(asset(k));
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(cache_entries(folder_ / "cache").value->size(), 3U);
    EXPECT_TRUE(verify_cache(folder_ / "cache").value->damaged.empty());
    EXPECT_TRUE(fs::is_empty(folder_ / "cache/pending"));
}

TEST_F(Cache, AnotherProcessMayHaveThisOnesNumber) {
    cache_.offer(asset(1));
    std::vector<FileDescriptor> others;  // alive, and so holding their locks
    for (int i = 0; i < 64; ++i) {
        const auto taken = fmt::format("cache/pending/{}-{}", ::getpid(), i);
        fs::create_directory(folder_ / taken);
        write_bytes(folder_ / (taken + "/theirs"), "theirs");
        others.emplace_back(::open((folder_ / taken).c_str(), O_RDONLY | O_DIRECTORY));
        ASSERT_EQ(::flock(others.back().get(), LOCK_EX), 0);
    }
    cache_.offer(asset(0));
    EXPECT_TRUE(cache_.problems().empty());
    ASSERT_TRUE(cache_.find(asset(0).entry.key).has_value());
    EXPECT_FALSE(fs::exists(cache_.find(asset(0).entry.key)->folder / "theirs"));
    for (int i = 0; i < 64; ++i) {
        EXPECT_TRUE(fs::exists(folder_ / fmt::format("cache/pending/{}-{}/theirs", ::getpid(), i)));
    }
}

TEST_F(Cache, VerifyRemovesDamage) {
    for (std::size_t i = 0; i < 3; ++i) cache_.offer(asset(i));
    const auto damaged = cache_.find(asset(2).entry.key)->folder / "shape.bin";
    write_bytes(damaged, read_bytes(damaged) + "x");
    write_bytes(cache_.find(asset(1).entry.key)->folder / "manifest.json", "{");
    const auto verified = verify_cache(folder_ / "cache");
    EXPECT_EQ(verified.value->entries, 3U);
    EXPECT_EQ(verified.value->damaged.size(), 2U);
    EXPECT_EQ(cache_entries(folder_ / "cache").value->size(), 1U);
    EXPECT_TRUE(verify_cache(folder_ / "cache").value->damaged.empty());
}

// The recipes are equal.
TEST_F(Cache, WhatAnotherReleaseOrVersionMadeIsNeverRead) {
    const AssetIdentity now =
        *asset_identity(bake_.recipe, bake_.recipe.parameters.bakes.at(0), Certification::quick)
             .value;
    ASSERT_EQ(now.key, asset(0).entry.key);
    AssetIdentity other_release = now;
    other_release.release = "0.0.9";
    AssetIdentity other_version = now;
    --other_version.baker_version;
    for (AssetIdentity* other : {&other_release, &other_version}) {
        other->key = key_of(*other);
        ReadyAsset made_by_other = asset(0);
        made_by_other.entry.release = other->release;
        sign(*other, made_by_other.entry);
        cache_.offer(made_by_other);
        ASSERT_TRUE(cache_.find(other->key).has_value());
        EXPECT_FALSE(cache_.find(now.key).has_value());
    }
    TestBake again(recipe_of(small_recipe), folder_ / "again");
    again.bake.sources = {&cache_};
    EXPECT_EQ(again.states(), std::vector<AssetState>(3, AssetState::baked));
    EXPECT_EQ(TestBake(recipe_of(small_recipe), folder_ / "third").states().size(), 3U);
    EXPECT_TRUE(cache_.find(now.key).has_value());  // offered by the bake
}

// An entry whose manifest was changed is none: a bake takes its place.
TEST_F(Cache, AChangedEntryMakesRoom) {
    cache_.offer(asset(0));
    const fs::path manifest = cache_.find(asset(0).entry.key)->folder / "manifest.json";
    std::string text = read_bytes(manifest);
    const std::size_t at = text.find("\"points\": ");
    ASSERT_NE(at, std::string::npos);
    text.insert(at + 10, "1");
    write_bytes(manifest, text);
    EXPECT_EQ(verify_cache(folder_ / "cache").value->damaged, std::vector<fs::path>{manifest});
    cache_.offer(asset(0));
    ASSERT_TRUE(cache_.find(asset(0).entry.key).has_value());
    write_bytes(manifest, text);
    EXPECT_FALSE(cache_.find(asset(0).entry.key).has_value());
    EXPECT_FALSE(fs::exists(manifest));
    cache_.offer(asset(0));
    EXPECT_TRUE(cache_.find(asset(0).entry.key).has_value());
}

TEST_F(Cache, GarbageIsWhatWasUsedLeastRecently) {
    for (std::size_t i = 0; i < 3; ++i) cache_.offer(asset(i));
    std::uint64_t all = 0;
    for (const CacheEntry& entry : *cache_entries(folder_ / "cache").value) all += entry.bytes;
    const auto set_last_use = [this](std::size_t i, long seconds) {
        const timespec times[2] = {{seconds, 0}, {seconds, 0}};
        const auto manifest = cache_.find(asset(i).entry.key)->folder / "manifest.json";
        ASSERT_EQ(::utimensat(AT_FDCWD, manifest.c_str(), times, 0), 0);
    };
    set_last_use(1, 1000);
    set_last_use(2, 2000);
    set_last_use(0, 3000);
    EXPECT_TRUE(collect_garbage(folder_ / "cache", all).value->empty());
    const auto removed = collect_garbage(folder_ / "cache", all - 1);
    ASSERT_EQ(removed.value->size(), 1U);
    EXPECT_EQ((*removed.value)[0].key, asset(1).entry.key);
    cache_.find(asset(2).entry.key);  // used again: now the youngest
    const std::uint64_t left = all - (*removed.value)[0].bytes;
    EXPECT_EQ((*collect_garbage(folder_ / "cache", left - 1).value)[0].key, asset(0).entry.key);
    EXPECT_EQ(collect_garbage(folder_ / "cache", 0).value->size(), 1U);
    EXPECT_TRUE(cache_entries(folder_ / "cache").value->empty());
}

TEST_F(Cache, GarbageIsWhatKilledProcessesLeft) {
    cache_.offer(asset(0));
    fs::create_directories(folder_ / "cache/pending/99999999-0");
    write_bytes(folder_ / "cache/pending/99999999-0/shape.bin", "half");
    fs::create_directories(folder_ / "cache/pending/1-0");
    const FileDescriptor writer(
        ::open((folder_ / "cache/pending/1-0").c_str(), O_RDONLY | O_DIRECTORY));
    ASSERT_EQ(::flock(writer.get(), LOCK_EX), 0);
    EXPECT_TRUE(collect_garbage(folder_ / "cache", 1u << 30).value);
    EXPECT_FALSE(fs::exists(folder_ / "cache/pending/99999999-0"));
    EXPECT_TRUE(fs::exists(folder_ / "cache/pending/1-0")) << "somebody is writing it";
    EXPECT_EQ(cache_entries(folder_ / "cache").value->size(), 1U);
}

// Whether or not the next process has anything to add.
TEST_F(Cache, TheNextBakeRemovesWhatAKilledOneLeft) {
    cache_.offer(asset(0));
    for (const bool known : {true, false}) {
        fs::create_directories(folder_ / "cache/pending/99999999-0");
        AssetCache(folder_ / "cache").offer(asset(known ? 0 : 1));
        EXPECT_TRUE(fs::is_empty(folder_ / "cache/pending")) << known;
    }
}

// Whoever can write into the cache must not reach what is outside of it through us.
TEST_F(Cache, LinksAreNotFollowed) {
    const std::string key = asset(0).entry.key;
    const fs::path entry = folder_ / "cache/assets" / key.substr(0, 2) / key;
    fs::create_directory(folder_ / "far");
    write_bytes(folder_ / "far/file", "of somebody else");
    cache_.offer(asset(1));
    fs::create_symlink(folder_ / "far", folder_ / "cache/pending/99999999-0");
    fs::create_directories(entry.parent_path());
    fs::create_symlink(folder_ / "absent", entry);
    cache_.offer(asset(0));
    EXPECT_TRUE(fs::is_directory(fs::symlink_status(entry)));
    EXPECT_FALSE(fs::exists(folder_ / "absent"));

    // A damaged entry that is a link goes, and what it points to stays.
    fs::rename(entry, folder_ / "far/entry");
    fs::create_symlink(folder_ / "far/entry", entry);
    write_bytes(folder_ / "far/entry/transmittance.exr", "damaged");
    cache_.reject(*cache_.find(key));
    EXPECT_FALSE(fs::exists(fs::symlink_status(entry)));
    EXPECT_EQ(read_bytes(folder_ / "far/entry/transmittance.exr"), "damaged");
    EXPECT_EQ(read_bytes(folder_ / "far/file"), "of somebody else");
}

TEST_F(Cache, AUseLeavesTheTimeStampOfWhatItsManifestPointsToAlone) {
    const std::string key = asset(0).entry.key;
    cache_.offer(asset(0));
    const fs::path manifest = cache_.find(key)->folder / "manifest.json";
    fs::rename(manifest, folder_ / "far.json");
    fs::create_symlink(folder_ / "far.json", manifest);
    const auto before = fs::file_time_type::clock::now() - std::chrono::hours(48);
    fs::last_write_time(folder_ / "far.json", before);
    EXPECT_TRUE(cache_.find(key).has_value());
    EXPECT_EQ(fs::last_write_time(folder_ / "far.json"), before);
}

TEST_F(Cache, AMissingCacheIsEmpty) {
    EXPECT_TRUE(cache_entries(folder_ / "none").value->empty());
    EXPECT_TRUE(collect_garbage(folder_ / "none", 0).value->empty());
    EXPECT_EQ(verify_cache(folder_ / "none").value->entries, 0U);
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Cache, OneThatCannotBeWrittenWarnsOnce) {
    write_bytes(folder_ / "file", "no folder");
    AssetCache cache(folder_ / "file");
    cache.offer(asset(0));
    cache.offer(asset(1));
    EXPECT_EQ(cache.problems().size(), 1U);
    EXPECT_FALSE(cache.find(asset(0).entry.key).has_value());
}

}  // namespace
}  // namespace skybake
