#include "config/init_text.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::all_parameters;
using testing::valid;

TEST(InitText, ReadsBackAsThePreset) {
    for (const Preset& preset : presets()) {
        SCOPED_TRACE(preset.name);
        const Recipe expected = valid(std::string(preset.text));
        const Recipe written = valid(init_text(preset));
        EXPECT_EQ(all_parameters(written), all_parameters(expected));
        EXPECT_EQ(written.parameters.bakes.size(), expected.parameters.bakes.size());
    }
}

// Whoever takes the `#` off a default must not get an error.
TEST(InitText, DefaultsInCommentsAreValid) {
    for (const Preset& preset : presets()) {
        SCOPED_TRACE(preset.name);
        std::string text = init_text(preset);
        std::string uncommented;
        for (std::size_t start = 0; start < text.size();) {
            const std::size_t end = text.find('\n', start);
            std::string line = text.substr(start, end - start);
            start = end + 1;
            const bool is_default = line.starts_with("# ") &&
                                    line.find(" = ") == line.find(' ', 2) &&
                                    line.find(" = ") != std::string::npos && line[2] != '`';
            uncommented += (is_default ? line.substr(2) : line) + '\n';
        }
        EXPECT_NE(uncommented, text);
        EXPECT_EQ(all_parameters(valid(uncommented)),
                  all_parameters(valid(std::string(preset.text))));
    }
}

TEST(InitText, SaysUnitRangeAndMeaning) {
    const std::string text = init_text(*find_preset("earth"));
    EXPECT_NE(text.find("in (-1, 1); typical haze 0.76"), std::string::npos);
    EXPECT_NE(text.find("\n# pixel_type = \"float\"\n"), std::string::npos);
    EXPECT_NE(text.find("skybake init --preset earth"), std::string::npos);
    EXPECT_EQ(text.find("\n# max_error ="), std::string::npos);
}

}  // namespace
}  // namespace skybake::config
