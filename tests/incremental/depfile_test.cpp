#include "bakers/incremental/depfile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace skybake {
namespace {

using Paths = std::vector<std::filesystem::path>;

TEST(Depfile, NamesInputsAndTheProgram) {
    const std::string text = depfile_text(Paths{"out/a.exr", "out/manifest.json"}, Paths{"r.toml"});
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    EXPECT_EQ(text, "out/a.exr out/manifest.json: \\\n  r.toml \\\n  " + program + "\nr.toml:\n" +
                        program + ":\n");
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
