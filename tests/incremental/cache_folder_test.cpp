// A cache leaves folders alone that are none of its own, wherever they stand.
#include "bakers/workspace/cache_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bakers/workspace/asset_cache.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;
namespace fs = std::filesystem;

std::string code_of(const std::vector<config::Diagnostic>& problems) {
    return problems.empty() ? "" : problems[0].code;
}

// Everything that may remove something from a cache: a bake, gc and verify.
const std::vector<std::function<void(const fs::path&, TestBake&)>> uses = {
    [](const fs::path& cache, TestBake& bake) {
        AssetCache source(cache);
        bake.bake.sources = {&source};
        EXPECT_TRUE(bake.run().value);
    },
    [](const fs::path& cache, TestBake&) { (void)collect_garbage(cache, 0); },
    [](const fs::path& cache, TestBake&) { (void)verify_cache(cache); },
};

class CacheFolder : public ::testing::Test {
  protected:
    void write(const std::string& name) {
        fs::create_directories((folder_ / name).parent_path());
        write_bytes(folder_ / name, "thesis");
    }
    bool holds(const std::string& name) { return read_bytes(folder_ / name) == "thesis"; }
    void make_cache() { EXPECT_TRUE(make_cache_folder(folder_ / "cache").empty()); }
    void use_in_all_ways() {
        for (std::size_t i = 0; i < uses.size(); ++i) {
            TestBake bake(recipe_of(small_recipe), folder_ / ("out" + std::to_string(i)));
            uses[i](folder_ / "cache", bake);
        }
    }

    TemporaryFolder folder_;
};

TEST_F(CacheFolder, OnlyWhatAProcessWouldNameItIsRemovedFromPending) {
    make_cache();
    const std::vector<std::string> foreign = {"work",   "12",    "12-",  "-3",
                                              "12-3-4", "12-3x", "1.2-3"};
    for (const std::string& name : foreign) write("cache/pending/" + name + "/text");
    write("cache/pending/12-3");  // a file
    write("cache/pending/99999999-0/shape.bin");
    write("cache/pending/99999999-0/entry/deep/shape.bin");
    use_in_all_ways();
    for (const std::string& name : foreign) {
        EXPECT_TRUE(holds("cache/pending/" + name + "/text")) << name;
    }
    EXPECT_TRUE(holds("cache/pending/12-3"));
    EXPECT_FALSE(fs::exists(folder_ / "cache/pending/99999999-0"));
}

TEST_F(CacheFolder, APendingThatIsALinkIsNotFollowed) {
    make_cache();
    write("victim/99999999-0/text");
    write("victim/Documents/text");
    fs::create_directory_symlink(folder_ / "victim", folder_ / "cache/pending");
    use_in_all_ways();
    EXPECT_TRUE(holds("victim/99999999-0/text"));
    EXPECT_TRUE(holds("victim/Documents/text"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "victim"), {}), 2);
}

TEST_F(CacheFolder, LinksWithinAnAbandonedFolderAreNotFollowed) {
    make_cache();
    write("victim/text");
    fs::create_directories(folder_ / "cache/pending/99999999-0");
    fs::create_directory_symlink(folder_ / "victim", folder_ / "cache/pending/99999999-0/entry");
    fs::create_symlink(folder_ / "victim/text", folder_ / "cache/pending/99999999-0/text");
    use_in_all_ways();
    EXPECT_FALSE(fs::exists(folder_ / "cache/pending/99999999-0"));
    EXPECT_TRUE(holds("victim/text"));
}

TEST_F(CacheFolder, AFolderWithFilesAndNoTagIsNoCache) {
    const std::string key(32, 'a');
    write("cache/pending/99999999-0/text");
    write("cache/assets/aa/" + key + "/manifest.json");
    const auto all = [&] {
        return holds("cache/pending/99999999-0/text") &&
               holds("cache/assets/aa/" + key + "/manifest.json") &&
               std::distance(fs::directory_iterator(folder_ / "cache"), {}) == 2;
    };
    EXPECT_EQ(code_of(check_cache_folder(folder_ / "cache")), "E0302");
    EXPECT_EQ(code_of(make_cache_folder(folder_ / "cache")), "E0302");
    EXPECT_EQ(code_of(cache_entries(folder_ / "cache").diagnostics), "E0302");
    EXPECT_EQ(code_of(collect_garbage(folder_ / "cache", 0).diagnostics), "E0302");
    EXPECT_EQ(code_of(verify_cache(folder_ / "cache").diagnostics), "E0302");
    EXPECT_FALSE(AssetCache(folder_ / "cache").find(key).has_value());
    use_in_all_ways();
    EXPECT_TRUE(all());
    write_bytes(folder_ / "cache/CACHEDIR.TAG", "Signature: 8a477f597d28d172789f06886806bc55\n");
    EXPECT_EQ(code_of(check_cache_folder(folder_ / "cache")), "E0302") << "another program's";
    fs::remove(folder_ / "cache/CACHEDIR.TAG");
    EXPECT_TRUE(all());
}

TEST_F(CacheFolder, MissingAndEmptyFoldersBecomeCachesAndFilesDoNot) {
    fs::create_directory(folder_ / "empty");
    for (const char* name : {"empty", "missing"}) {
        EXPECT_FALSE(is_cache_folder(folder_ / name));
        EXPECT_TRUE(check_cache_folder(folder_ / name).empty());
        EXPECT_TRUE(make_cache_folder(folder_ / name).empty());
        EXPECT_TRUE(is_cache_folder(folder_ / name));
        write(std::string(name) + "/assets/x");
        EXPECT_TRUE(check_cache_folder(folder_ / name).empty());
    }
    write("file");
    EXPECT_EQ(code_of(check_cache_folder(folder_ / "file")), "E0302");
}

}  // namespace
}  // namespace skybake
