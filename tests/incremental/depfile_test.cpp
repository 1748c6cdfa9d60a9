#include "bakers/workspace/depfile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

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

}  // namespace
}  // namespace skybake
