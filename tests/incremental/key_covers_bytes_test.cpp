// No cache serves old bytes: whatever value of a recipe changes, an asset gets another key or has
// the same bytes. Each resolved value of a few recipes is changed, one after the other, and assets
// whose keys stay are baked again.
//
// Changes of different tables that leave an asset's key are made together. Those of one table stay
// apart, since a word decides what other keys mean, and two numbers may keep their ratio.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include "bakers/assets/registry/registry.h"
#include "bakers/workspace/folder_plan.h"
#include "config/fields/fields.h"
#include "config/text/key_path.h"
#include "tests/incremental/bakes.h"
#include "tests/support/recipes.h"

namespace skybake {
namespace {

using config::ResolvedValue;
using test::recipe_text;
using testing::recipe_of;
namespace fs = std::filesystem;

const fs::path kMaps = fs::path(SKYBAKE_TEST_DATA) / "maps";

std::string content_of(const Baked& asset) { return asset.levels.front().content_hash; }

std::string content_of(const Recipe& recipe, const config::Bake& bake) {
    const auto baked = bake_asset(recipe, bake, {1, Certification::off});
    return baked.value ? content_of(*baked.value) : "";  // refused
}

std::string key_of(const Recipe& recipe, const config::Bake& bake) {
    const auto identity = asset_identity(recipe, bake, Certification::off);
    return identity.value ? identity.value->key : "";  // a map cannot be read
}

// `text` with each number in it changed, but not the powers in units ("15 /cm3").
std::string with_numbers(const std::string& text, double factor, double offset) {
    static const std::regex number(R"([-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)");
    std::string result;
    auto begin = text.cbegin();
    for (std::sregex_iterator match(text.begin(), text.end(), number), end; match != end; ++match) {
        const auto first = (*match)[0].first;
        if (first != text.cbegin() && std::isalpha(static_cast<unsigned char>(first[-1])) != 0)
            continue;
        result.append(begin, first);
        result += fmt::format("{}", std::stod(match->str()) * factor + offset);
        begin = (*match)[0].second;
    }
    return result.append(begin, text.cend());
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// Every other choice that a key of this name has in some section, and other names.
std::vector<std::string> other_words(const ResolvedValue& value) {
    if (value.canonical == "true") return {"false"};
    if (value.canonical == "false") return {"true"};
    // A name begins with a letter, a quantity does not.
    const std::size_t quote = value.canonical.find('"');
    if (quote == std::string::npos || std::isalpha(value.canonical[quote + 1]) == 0) return {};
    std::vector<std::string> texts = {"\"shape\"", "\"detail\"", "\"mie\""};
    for (const config::Section& section : config::sections()) {
        for (const config::Field& field : section.fields) {
            if (field.key != last_part(value.path)) continue;
            for (const std::string_view name : config::choice_names(field)) {
                texts.push_back(fmt::format("\"{}\"", name));
            }
        }
    }
    return texts;
}

// Other numbers in its place; where one is refused the next is tried.
std::vector<std::string> other_numbers(const ResolvedValue& value) {
    std::vector<std::string> texts;
    if (value.canonical.find_first_of("0123456789") == std::string::npos) return texts;
    for (const double factor : {1.01, 0.97, 2.0, 0.5}) {
        texts.push_back(with_numbers(value.canonical, factor, 0));
    }
    for (const double offset : {0.05, -0.05, 1.0, -1.0}) {
        texts.push_back(with_numbers(value.canonical, 1, offset));
    }
    return texts;
}

struct KeyedContent {
    std::string key;
    std::string content;
};

// Settings as `--set` takes them, and those that leave an asset's key, by table of the recipe.
using Settings = std::vector<std::string>;
using KeptChanges = std::map<std::string, Settings>;

// Returns the changes in groups: the first of each table, the second of each, and so on.
std::vector<Settings> groups_over_tables(const KeptChanges& changes) {
    std::vector<Settings> groups;
    for (const auto& [table, settings] : changes) {
        if (groups.size() < settings.size()) groups.resize(settings.size());
        for (std::size_t i = 0; i < settings.size(); ++i) groups[i].push_back(settings[i]);
    }
    return groups;
}

class ChangedRecipe {
  public:
    explicit ChangedRecipe(std::string text)
        : text_(std::move(text)), recipe_(recipe_of(text_, kMaps)), values_(values_of(recipe_)) {
        for (const config::Bake& bake : recipe_.parameters.bakes) {
            known_[bake.name] = {key_of(recipe_, bake), content_of(recipe_, bake)};
        }
    }

    // The paths that could be changed.
    std::set<std::string> change_all() {
        std::set<std::string> changed;
        for (const ResolvedValue& value : recipe_.values) {
            bool any = false;
            for (const std::string& word : other_words(value)) any |= change(value.path, word);
            for (const std::string& number : other_numbers(value)) {
                if (any) break;
                any = change(value.path, number);
            }
            if (any) changed.insert(value.path);
        }
        for (const auto& [asset, changes] : kept_) {
            for (const Settings& group : groups_over_tables(changes)) expect_same(asset, group);
        }
        return changed;
    }

  private:
    std::optional<Recipe> with(const Settings& settings) const {
        auto made = config::parse_recipe(text_, "recipe.toml", kMaps, settings);
        if (!made.value || made.value->parameters.bakes.size() != known_.size()) return {};
        return std::move(made.value);
    }

    // False where the recipe refuses the value, or has it already.
    bool change(const std::string& path, const std::string& value) {
        const std::string setting = fmt::format("{}={}", path_in_text(path), value);
        const std::optional<Recipe> recipe = with({setting});
        if (!recipe || values_of(*recipe) == values_) return false;
        for (const config::Bake& bake : recipe->parameters.bakes) {
            if (!uses(*recipe, bake, path)) continue;
            if (key_of(*recipe, bake) != known_.at(bake.name).key) continue;
            kept_[bake.name][path.substr(0, path.rfind('.') + 1)].push_back(setting);
        }
        return true;
    }

    // A frame's values are those of the section that asks for all frames.
    static std::string path_in_text(const std::string& path) {
        static const std::regex frame(R"(^(bake\.\w+)_\d{4}\.)");
        return std::regex_replace(path, frame, "$1.");
    }

    static std::string values_of(const Recipe& recipe) {
        std::string all;
        for (const ResolvedValue& value : recipe.values) {
            all += fmt::format("{} = {}\n", value.path, value.canonical);
        }
        return all;
    }

    // Whether an asset is made from another one's section of the recipe.
    static bool uses(const Recipe& recipe, const config::Bake& bake, const std::string& path) {
        if (!path.starts_with("bake.")) return true;
        const std::string other = path.substr(5, path.rfind('.') - 5);
        return other == bake.name ||
               asset_parameters(recipe, bake).find(fmt::format("\"{}\"", other)) !=
                   std::string::npos;
    }

    std::optional<std::string> content_with(const std::string& asset, const Settings& changes) {
        const std::optional<Recipe> recipe = with(changes);
        if (!recipe) return {};
        const auto& bakes = recipe->parameters.bakes;
        const auto bake = std::find_if(bakes.begin(), bakes.end(),
                                       [&](const config::Bake& any) { return any.name == asset; });
        if (bake == bakes.end() || key_of(*recipe, *bake) != known_.at(asset).key) return {};
        return content_of(*recipe, *bake);
    }

    void expect_same(const std::string& asset, const Settings& changes) {
        const std::optional<std::string> content = content_with(asset, changes);
        if (content && *content == known_.at(asset).content) return;
        if (changes.size() > 1) {
            const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
            expect_same(asset, {changes.begin(), middle});
            return expect_same(asset, {middle, changes.end()});
        }
        ASSERT_TRUE(content.has_value()) << asset << ' ' << changes.front();
        EXPECT_TRUE(content->empty()) << "the key of `" << asset << "` does not see "
                                      << changes.front();  // empty: the bake refuses the value
    }

    std::string text_;
    Recipe recipe_;
    std::string values_;
    std::map<std::string, KeyedContent> known_;
    std::map<std::string, KeptChanges> kept_;  // by asset
};

// Changes each value of a recipe. What names other things cannot change alone, or has no other
// value; `fixed` has their keys or their whole paths. `flip` is refused where no file is an image.
void change_every_value(const std::string& name, const std::set<std::string>& fixed) {
    const std::string text = recipe_text("keys/" + name);
    const auto changed = ChangedRecipe(text).change_all();
    for (const ResolvedValue& value : recipe_of(text, kMaps).values) {
        if (value.only_shown || fixed.count(last_part(value.path)) > 0) continue;
        if (fixed.count(value.path) > 0) continue;
        EXPECT_EQ(changed.count(value.path), 1U) << value.path << " = " << value.canonical;
    }
}

TEST(KeyCoversBytes, WhateverChangesOfTheSky) {
    change_every_value("sky", {"format", "profile", "particles", "number_density", "asset", "layer",
                               "table", "size", "convention"});
}

TEST(KeyCoversBytes, WhateverChangesOfClouds) {
    change_every_value("clouds",
                       {"flip", "format", "profile", "pack", "asset", "cloud", "of", "shape",
                        "bake.mask.mips", "bake.distance.mips", "bake.near_light.mips"});
}

// The light of a uniform sky is the same in any air.
TEST(KeyCoversBytes, AClearSkyIsOfItsAirAndItsSun) {
    const std::string recipe = recipe_text("keys/cloudy_sky") +
                               "[bake.uniform]\nasset = 'cloud_light'\nof = 'cloud'\n"
                               "contents = 'sky_radiance'\n";
    const Recipe before = recipe_of(recipe);
    for (const char* setting :
         {"atmosphere.ground_albedo=0.4", "atmosphere.layers.mie.g=0.7",
          "clouds.c.base_altitude='600 m'", "bake.sky_light.sun_elevations=['41 deg']"}) {
        const auto after =
            config::parse_recipe(recipe, "recipe.toml", kMaps, std::vector<std::string>{setting});
        ASSERT_TRUE(after.value) << setting;
        for (std::size_t i = 0; i < before.parameters.bakes.size(); ++i) {
            const config::Bake& bake = before.parameters.bakes[i];
            const bool is_same =
                key_of(before, bake) == key_of(*after.value, after.value->parameters.bakes[i]);
            if (bake.name == "sky_light") {
                EXPECT_FALSE(is_same) << setting;
            }
            if (bake.name == "uniform" && std::string(setting).starts_with("atmosphere")) {
                EXPECT_TRUE(is_same) << setting;
            }
        }
    }
}

// Minutes: whatever does not change an environment has it made anew.
TEST(SlowKeyCoversBytes, WhateverChangesOfCloudySkies) {
    change_every_value(
        "cloudy_sky", {"flip", "format", "profile", "asset", "cloud", "clouds", "channels", "noise",
                       "of", "pack", "part", "bake.sky_light.mips"});
}

TEST(KeyCoversBytes, WhateverChangesOfParticles) {
    change_every_value("particles",
                       {"format", "profile", "asset", "material", "sizes", "particles"});
}

TEST(KeyCoversBytes, WhateverChangesOfColors) {
    change_every_value("colors",
                       {"format", "profile", "asset", "gas", "column", "phase", "observer"});
}

// A key is tried with a whole recipe, so that three small ones take less than one large one.
TEST(KeyCoversBytes, WhateverElseChanges) {
    change_every_value("layers", {"format", "profile", "asset", "sizes"});
    change_every_value("maps", {"flip", "format", "profile", "pack", "asset", "cloud", "noise",
                                "type", "shape", "file"});
    change_every_value(
        "moving", {"flip", "format", "profile", "pack", "asset", "cloud", "noise", "type", "shape",
                   "of", "frames", "bake.wave_0001.frame", "bake.wave_0002.frame", "bake.book.mips",
                   "clouds.grown.channels"});
}

// A cloud of a volume has one channel.
TEST(KeyCoversBytes, WhateverChangesOfVolumes) {
    change_every_value("volumes", {"flip", "format", "asset", "cloud", "volume", "file", "grid",
                                   "channels", "size"});
}

// A key that no recipe has is one whose changes nobody has tried. Presets and includes are other
// ways to say the rest.
TEST(KeyCoversBytes, TriesEveryKey) {
    std::vector<ResolvedValue> values;
    for (const char* name :
         {"sky", "clouds", "particles", "colors", "volumes", "layers", "maps", "moving"}) {
        const Recipe recipe = recipe_of(recipe_text(std::string("keys/") + name), kMaps);
        values.insert(values.end(), recipe.values.begin(), recipe.values.end());
    }
    std::set<std::string> untried;
    for (const config::Section& section : config::sections()) {
        // No asset reads [preview].
        if (section.path.starts_with("bake") || section.path.starts_with("sweep") ||
            section.path.starts_with("preview")) {
            continue;
        }
        for (const config::Field& field : section.fields) {
            const std::string pattern =
                config::join_path(std::string(section.path), std::string(field.key));
            const bool tried =
                std::any_of(values.begin(), values.end(), [&](const ResolvedValue& value) {
                    return config::path_matches(value.path, pattern);
                });
            if (!tried && field.key != "preset") untried.insert(pattern);
        }
    }
    // An included file's values are tried as the recipe's own; `aliases` speaks of warnings alone,
    // and `target` of keys of assets (targets_test.cpp). `cover` and `size` of a cloud are those of its
    // bakes, unless they say so themselves (parameters_test.cpp).
    for (const char* known :
         {"clouds.*.cover", "clouds.*.size", "include", "noise.*.aliases", "target"}) {
        EXPECT_EQ(untried.erase(known), 1U) << known;
    }
    EXPECT_TRUE(untried.empty()) << fmt::format("{}", fmt::join(untried, "\n"));
}

}  // namespace
}  // namespace skybake
