#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/workspace/depfile.h"
#include "bakers/workspace/http_cache.h"

namespace skybake {
namespace {

using Paths = std::vector<std::filesystem::path>;

// The modules lie in lib/skybake of a folder above the program: code that bakes, too.
TEST(Depfile, NamesInputsAndTheProgramWithItsModules) {
    const std::string text = depfile_text(Paths{"out/a.exr", "out/manifest.json"}, Paths{"r.toml"});
    const auto program = std::filesystem::read_symlink("/proc/self/exe");
    Paths files = {program};
    const auto root = program.parent_path().parent_path().parent_path();
    for (const char* module : {"skybake_vdb.so", "skybake_images.so"}) {
        const auto path = root / "lib" / "skybake" / module;
        ASSERT_TRUE(std::filesystem::exists(path)) << path;
        files.push_back(path);
    }
    std::string wanted = "out/a.exr out/manifest.json: \\\n  r.toml";
    for (const auto& file : files) wanted += " \\\n  " + file.string();
    wanted += "\nr.toml:\n";
    for (const auto& file : files) wanted += file.string() + ":\n";
    EXPECT_EQ(text, wanted);
}

TEST(Depfile, EscapesWhatMakeWouldRead) {
    const std::string text =
        depfile_text(Paths{"o ut/a#1.exr"}, Paths{"re$cipe.toml", "12:30.toml", R"(a\b\ c.toml)"});
    EXPECT_EQ(text.rfind("o\\ ut/a\\#1.exr: \\\n  re$$cipe.toml \\\n  12\\:30.toml \\\n  "
                         R"(a\b\\\ c.toml)",
                         0),
              0U)
        << text;
}

// The URLs of caches on servers. What the cache does with servers of every kind is tested by
// tests/pipelines/http_cache.sh.

TEST(CacheUrl, NamesAServerByHttp) {
    for (const char* url : {"http://host", "https://host:8443/deep/folder/", "http://[::1]:80/x",
                            "http://user:password@host/x"}) {
        EXPECT_EQ(cache_url_problem(url), "") << url;
    }
    for (const char* url : {"", "host", "/folder", "ftp://host/x", "file:///etc", "http://",
                            "http:///x", "http://user:password@/x", "http://host/x?key=1",
                            "http://host/#x", "http://host/a b", "http://host/\n", "HTTP://host"}) {
        EXPECT_NE(cache_url_problem(url), "") << url;
    }
}

TEST(CacheUrl, IsShownWithoutCredentials) {
    EXPECT_EQ(without_credentials("http://host:80/x"), "http://host:80/x");
    EXPECT_EQ(without_credentials("https://user:password@host/x"), "https://host/x");
    EXPECT_EQ(without_credentials("https://user@host"), "https://host");
    EXPECT_EQ(without_credentials("http://user:p@ss/w@rd@host/x"), "http://host/x");
    EXPECT_EQ(without_credentials("user:password@host/x"), "host/x");
}

TEST(HttpCache, AKeyLeadsNowhereElse) {
    HttpCache cache("http://user:password@127.0.0.1:1/x", {});
    EXPECT_FALSE(cache.find("../../secrets").has_value());
    EXPECT_TRUE(cache.problems().empty());  // nobody was asked
    EXPECT_FALSE(cache.find(std::string(32, 'a')).has_value());
    ASSERT_EQ(cache.problems().size(), 1U);
    EXPECT_EQ(cache.problems()[0].code, "W0305");
    EXPECT_EQ(cache.problems()[0].severity, config::Severity::warning);
    EXPECT_EQ(cache.problems()[0].message.find("password"), std::string::npos);
}

}  // namespace
}  // namespace skybake
