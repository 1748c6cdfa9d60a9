#include "config/recipe/explain.h"

#include <gtest/gtest.h>

#include "config/diagnostics/diagnostic_codes.h"
#include "config/fields/fields.h"
#include "tests/support/odd_words.h"

namespace skybake::config {
namespace {

bool mentions(const std::optional<std::string>& text, std::string_view words) {
    return text && text->find(words) != std::string::npos;
}

TEST(Explain, KnowsAKeyByItsPathOrItsTail) {
    for (const char* path :
         {"atmosphere.layers.mie.g", "atmosphere.layers.*.g", "layers.*.g", "mie.g", "g"}) {
        const auto text = explain(path);
        EXPECT_TRUE(mentions(text, "atmosphere.layers.*.g\n")) << path;
        EXPECT_TRUE(mentions(text, "in (-1, 1); typical haze has 0.76")) << path;
        EXPECT_TRUE(mentions(text, "Cornette and Shanks 1992")) << path;
    }
}

struct Explained {
    const char* name;
    std::vector<const char*> words;
};

TEST(Explain, KnowsKeysTablesAndSections) {
    for (const auto& [name, words] : std::vector<Explained>{
             {"size", {"bake.transmittance.size", "bake.multiple_scattering.size"}},
             {"bake.mine.size", {"bake.multiple_scattering.size"}},
             {"atmosphere", {"ground_radius"}},
             {"atmosphere.layers.mie", {"scale_height"}},
             {"bake.transmittance", {"content"}},
             {"noise", {"[noise.*.channels.*]"}},
             {"noise.shape", {"sampling"}},
             {"noise.shape.channels", {"worley_gains"}},
             {"noise.shape.channels.R", {"worley_gains"}},
             {"noise.shape.channels.R.frequency", {"in [1, 1048576]"}},
             {"frequencies", {"not together with frequency, octaves, lacunarity"}},
             {"frequency", {"not together with frequencies\n"}},
             {"noise_volume.mips", {"\"all\" goes down to one voxel"}},
             {"seed", {"noise.*.seed", "0xffffffffffffffff"}},
             {"atmosphere.layers", {"scale_height"}},
             {"clouds", {"[clouds.*.towers.*]"}},
             {"clouds.cumulus", {"edge_softness"}},
             {"clouds.cumulus.height_profile", {"top_falloff"}},
             {"towers", {"correlation"}},
             {"clouds.cumulus.towers.0.amplitude", {"clouds.*.towers.*.amplitude"}},
             {"clouds.cumulus.edge_softness", {"0 or in [1e-06, 1000000]"}},
             {"erosion", {"only with detail\n"}},
             {"occupancy.cell", {"a power of two"}},
             {"voxel_size", {"not together with size"}},
             {"sweep", {"keys varied in lockstep", "[sweep.*]"}},
             {"sweep.sobol", {"Joe and Kuo 2008"}},
             {"scale", {"equal ratios"}},
             {"heading", {"in [-360 deg, 360 deg]"}},
             {"kinds", {"for example [\"air\""}},
         }) {
        const auto text = explain(name);
        for (const char* word : words) EXPECT_TRUE(mentions(text, word)) << name << ": " << word;
    }
    EXPECT_FALSE(mentions(explain("bake.transmittance.size"), "multiple_scattering"));
    EXPECT_FALSE(mentions(explain("transmittance"), "method"));
    EXPECT_FALSE(mentions(explain("refractive_index"), "0.8"));
}

// A hint stands behind the range, where a value alone would look like one more bound.
TEST(Explain, HintsThatAreExamplesSaySo) {
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            const std::string_view hint = field.hint;
            const bool is_value =
                hint.starts_with('[') || (hint.starts_with('"') && hint != "\"\"");
            const bool has_verb = hint.find(" is ") != hint.npos ||
                                  hint.find(" goes ") != hint.npos ||
                                  hint.find(" removes ") != hint.npos;
            EXPECT_TRUE(!is_value || has_verb) << section.path << " " << field.key << ": " << hint;
        }
    }
    EXPECT_TRUE(mentions(explain("bake.environment.clouds"),
                         "note      for example [\"cumulus\", \"cirrus\"]"));
}

TEST(Explain, EveryCodeAndEveryKeyIsExplained) {
    for (const DiagnosticCode& code : diagnostic_codes()) {
        EXPECT_TRUE(mentions(explain(code.code), code.title)) << code.code;
    }
    const std::string all = explain_all_keys();
    for (const std::string& name : explained_names()) EXPECT_TRUE(explain(name)) << name;
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            EXPECT_NE(all.find(field.key), std::string::npos) << field.key;
        }
    }
}

TEST(Explain, HasNoWordsThatReadersStumbleOver) {
    for (const std::string& name : explained_names()) {
        EXPECT_EQ(test::odd_word_of(explain(name).value_or("")), "") << name;
    }
    EXPECT_EQ(test::odd_word_of("`91` will\n   not do"), "will not do");
}

TEST(Explain, UnknownNamesAreUnknown) {
    for (const char* name : {"", "nope", "*", "a.b.c.d.e.f", "E9999", "mie", "..", "\"x"}) {
        EXPECT_FALSE(explain(name)) << name;
    }
}

TEST(Explain, PrintsWhatAPresetSaysOfItself) {
    const auto humilis = explain("cumulus_humilis");
    ASSERT_TRUE(humilis);
    EXPECT_TRUE(humilis->starts_with("Fair-weather cumulus"));
    EXPECT_NE(humilis->find("aufm Kampe 1950"), std::string::npos);
    EXPECT_NE(explain("earth")->find("Trenberth"), std::string::npos);
}

}  // namespace
}  // namespace skybake::config
