// Names of files that cannot be are found before anything is baked.
#include "config/assets/output_files.h"

#include <algorithm>

#include "config/assets/asset_kind.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

// Returns "CODE LINE" of each diagnostic.
std::vector<std::string> told(const std::string& text) {
    std::vector<std::string> codes;
    for (const Diagnostic& diagnostic : parse("preset = 'earth_hillaire'\n" + text).diagnostics) {
        codes.push_back(diagnostic.code + " " + std::to_string(diagnostic.where.line));
    }
    return codes;
}

using Told = std::vector<std::string>;

std::string table(const std::string& name, const std::string& more = "") {
    return "[bake." + name + "]\nasset = 'transmittance'\n" + more;
}

std::string environment(const std::string& name, const std::string& more) {
    return "[bake." + name +
           "]\nasset = 'environment'\nmapping = 'longitude_latitude'\n"
           "size = [16, 8]\nsun_elevation = '20 deg'\n" +
           more;
}

std::string noise(const std::string& name, const std::string& more) {
    return "[bake." + name + "]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [8, 8, 8]\n" + more;
}

const std::string a_noise =
    "[noise.n]\nperiod = 2\ndrift = [1, 0, 0]\n[noise.n.channels.Y]\ntype = 'worley'\nfrequency = "
    "1\n";

// 255 bytes are what file systems allow, whatever the files of an asset end with.
TEST(OutputFiles, HaveAtMostTwoHundredAndFiftyFiveBytes) {
    const auto longest = [](const std::string& ending) { return 255 - ending.size(); };
    const auto told_of = [](std::size_t length, const std::string& formats) {
        return told(table(std::string(length, 'n'), formats));
    };
    EXPECT_EQ(told_of(longest(".exr"), ""), Told());
    EXPECT_EQ(told_of(longest(".exr") + 1, ""), Told{"E0178 2"});
    EXPECT_EQ(told_of(longest(".ktx2"), "formats = ['exr', 'ktx2']\n"), Told());
    EXPECT_EQ(told_of(longest(".ktx2") + 1, "formats = ['exr', 'ktx2']\n"), Told{"E0178 2"});
    EXPECT_EQ(told(a_noise +
                   noise(std::string(longest(".mip3.exr"), 'n'), "formats = ['exr']\nmips = 4\n")),
              Told());
    EXPECT_EQ(told(a_noise + noise(std::string(longest(".mip3.exr") + 1, 'n'),
                                   "formats = ['exr']\nmips = 4\n")),
              Told{"E0178 8"});
}

// Each file of each target is counted: the names are those that a bake writes.
TEST(OutputFiles, OfTargetsAreCounted) {
    const auto outcome =
        parse("preset = 'earth_hillaire'\n" + environment("sky", "target = 'three'\n"));
    ASSERT_TRUE(outcome.value);
    const auto names = file_names(outcome.value->parameters.bakes.at(0));
    const auto longest =
        std::max_element(names.begin(), names.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const std::size_t ending = longest->size() - 3;
    ASSERT_GT(ending, 4U) << "a target has files of its own";
    EXPECT_EQ(told(environment(std::string(255 - ending, 'n'), "target = 'three'\n")), Told());
    EXPECT_EQ(told(environment(std::string(256 - ending, 'n'), "target = 'three'\n")),
              Told{"E0178 2"});
}

}  // namespace
}  // namespace skybake::config
