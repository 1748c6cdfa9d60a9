#include "config/recipe/init_text.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "config/assets/noise_volume.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

TEST(InitText, ReadsBackAsThePreset) {
    for (const Preset& preset : presets()) {
        SCOPED_TRACE(preset.name);
        const Recipe expected = valid(std::string(preset.text));
        const Recipe written = valid(init_text(preset));
        EXPECT_EQ(all_parameters(written), all_parameters(expected));
        EXPECT_EQ(written.parameters.bakes.size(), expected.parameters.bakes.size());
    }
}

// The defaults that a section lists in comments, as lines of their own in that section.
std::string with_defaults(const std::string& text) {
    std::string result;
    std::string list;
    std::istringstream lines(text + "\n");
    for (std::string line; std::getline(lines, line);) {
        const bool begins = line.starts_with("# by default: ");
        const bool goes_on = !list.empty() && line.starts_with("# ") && line.size() > 2;
        if (begins || goes_on) {
            list += line.substr(begins ? 14 : 1);
            continue;
        }
        for (std::size_t at = 0; at < list.size();) {
            const std::size_t end = std::min(list.find("; ", at), list.size());
            result += list.substr(at, end - at) + '\n';
            at = end + 2;
        }
        list.clear();
        result += line + '\n';
    }
    return result;
}

// Whoever writes a default must not get an error, nor another asset.
TEST(InitText, DefaultsInCommentsAreValid) {
    for (const Preset& preset : presets()) {
        SCOPED_TRACE(preset.name);
        const std::string text = init_text(preset);
        EXPECT_NE(with_defaults(text), text + "\n");
        EXPECT_EQ(all_parameters(valid(with_defaults(text))),
                  all_parameters(valid(std::string(preset.text))));
    }
}

TEST(InitText, HasAtMostEightyLines) {
    const auto check = [](const Preset& preset, const std::string& text) {
        EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 80) << preset.name;
    };
    for (const Preset& preset : presets()) check(preset, init_text(preset));
    for (const Preset& preset : noise_presets()) check(preset, noise_init_text(preset));
    for (const Preset& preset : cloud_presets()) check(preset, cloud_init_text(preset));
    for (const Preset& preset : particle_presets()) check(preset, particle_init_text(preset));
}

using testing::valid_with_warnings;

// A recipe without the `#` of its values and of tables that begin so.
std::string without_marks(const std::string& text, const std::string& table) {
    std::istringstream lines(text);
    std::string uncommented;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = line.find(" = ");
        const bool is_value = line.starts_with("# ") && line[2] != '`' &&
                              equals != std::string::npos && equals == line.find(' ', 2);
        uncommented += (is_value || line.starts_with(table) ? line.substr(2) : line) + '\n';
    }
    return uncommented;
}

TEST(InitText, ANoiseStartsFromItsPreset) {
    for (const Preset& preset : noise_presets()) {
        SCOPED_TRACE(preset.name);
        const std::string name = noise_init_name(preset.name);
        const std::string text = noise_init_text(preset);
        const Recipe written = valid_with_warnings(text);
        const std::string files =
            preset.name.starts_with("takram_") ? "formats = 'bin'\npixel_type = 'unorm8'\n" : "";
        EXPECT_EQ(all_parameters(written),
                  all_parameters(valid_with_warnings(
                      "[noise." + name + "]\npreset = '" + std::string(preset.name) + "'\n[bake." +
                      name + "]\nasset = 'noise_volume'\nnoise = '" + name + "'\n" + files)));
        // Whoever takes the `#` off a value or a table must get the same noise.
        const std::string uncommented = without_marks(text, "# [noise.");
        EXPECT_NE(uncommented.find("\n[noise." + name + ".channels.R]\n"), std::string::npos);
        EXPECT_EQ(all_parameters(valid_with_warnings(uncommented)), all_parameters(written));
    }
    EXPECT_EQ(noise_init_name("nubis_shape"), "shape");
    EXPECT_EQ(noise_init_name("thesis"), "thesis");
}

// The recipe bakes, at a size that its noises can show; whoever takes the `#` off a value or a
// table must get the same cloud.
TEST(InitText, ACloudStartsFromItsPresetAndItsNoises) {
    for (const Preset& preset : cloud_presets()) {
        SCOPED_TRACE(preset.name);
        const std::string text = cloud_init_text(preset);
        const Recipe written = preset.name == "thesis" ? valid_with_warnings(text) : valid(text);
        ASSERT_EQ(written.parameters.clouds.size(), 1u);
        EXPECT_EQ(written.parameters.clouds[0].name, preset.name);
        EXPECT_EQ(written.parameters.bakes.size(), 2u);
        const std::string name(preset.name);
        const Recipe alone = valid_with_warnings("[clouds." + name + "]\npreset = '" + name +
                                                 "'\n[bake." + name + "]\n");
        // The same asset as the preset's, shown in the same way.
        const std::vector<std::string> all = {
            "clouds",    "clouds.*",  "clouds.*.*",       "clouds.*.*.*",
            "noise.*.*", "preview.*", "preview.camera.*", "bake." + name + ".*"};
        EXPECT_EQ(parameters_toml(written, all), parameters_toml(alone, all));
        const std::string uncommented = without_marks(text, "# [clouds.");
        const bool grows = written.parameters.clouds[0].shape == CloudShape::convection;
        const char* table = grows ? ".convection]\n" : ".height_profile]\n";
        EXPECT_NE(uncommented.find(table), std::string::npos);
        EXPECT_EQ(all_parameters(valid_with_warnings(uncommented)), all_parameters(written));
    }
    const auto thesis =
        valid_with_warnings(cloud_init_text(*find_preset(cloud_presets(), "thesis")));
    EXPECT_EQ(thesis.parameters.noises.at(0).sampling, NoiseSampling::corners);
}

// Whoever takes the `#` off the sweep gets one of four or three variants.
TEST(InitText, TheSweepInCommentsIsValid) {
    const auto variants = [](std::string text) {
        const std::size_t start = text.find("#   [sweep]");
        EXPECT_NE(start, std::string::npos);
        for (std::size_t at = start; at != std::string::npos; at = text.find("#   ", at)) {
            text.erase(at, 4);
        }
        return variant_count(valid_with_warnings(text).sweep);
    };
    EXPECT_EQ(variants(init_text(*find_preset("earth"))), 4);
    EXPECT_EQ(variants(noise_init_text(*find_preset(noise_presets(), "nubis_shape"))), 3);
    EXPECT_EQ(variants(cloud_init_text(*find_preset(cloud_presets(), "cumulus_humilis"))), 4);
}

// three-clouds loads raw bytes and nothing else.
TEST(InitText, TakramsNoisesAreBytes) {
    for (const char* preset : {"takram_shape", "takram_detail"}) {
        const Recipe recipe = valid(noise_init_text(*find_preset(noise_presets(), preset)));
        const auto& bake = recipe.parameters.bakes.at(0).as<NoiseVolumeBake>();
        EXPECT_EQ(bake.formats, std::vector<FileFormat>{FileFormat::bin}) << preset;
        EXPECT_EQ(bake.pixel_type, PixelType::unorm8) << preset;
    }
    const Recipe nubis = valid(noise_init_text(*find_preset(noise_presets(), "nubis_shape")));
    const auto& bake = nubis.parameters.bakes.at(0).as<NoiseVolumeBake>();
    EXPECT_EQ(bake.formats, std::vector<FileFormat>{FileFormat::exr});
}

TEST(InitText, SaysUnitRangeAndMeaning) {
    const std::string text = init_text(*find_preset("earth"));
    EXPECT_NE(text.find("\ng = 0.703  # asymmetry of the phase function"), std::string::npos);
    EXPECT_NE(text.find("altitude of the camera, which may be in space\n"), std::string::npos);
    EXPECT_NE(text.find("pixel_type = \"float\""), std::string::npos);
    EXPECT_NE(text.find("skybake init --preset earth"), std::string::npos);
    EXPECT_EQ(text.find("\n# max_error ="), std::string::npos);
}

}  // namespace
}  // namespace skybake::config
