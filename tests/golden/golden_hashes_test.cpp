// Every asset's bytes, held to those that were baked before: hashes.toml has, for each asset of the
// recipes in tests/recipes/golden, the version of its baker, the hash of its content and the hash of what
// each file stores. A failure means that equal parameters no longer give equal bytes. Mend what is
// wrong, or raise the baker's version (its file NAME_baker.cpp), so that no cache serves the old
// bytes, and write the file anew:
//
//   SKYBAKE_UPDATE_GOLDEN=1 build/quickstart/tests/golden/golden_tests
//
// which refuses a changed hash whose version was not raised.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/math/hash.h"
#include "config/fields/fields.h"
#include "config/recipe/recipe.h"
#include "tests/incremental/bakes.h"
#include "tests/support/exr_image.h"

namespace skybake::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = SKYBAKE_GOLDEN_FOLDER;
const fs::path kRecipes = kFolder / "../recipes/golden";
const fs::path kHashes = kFolder / "hashes.toml";

// The facts that are kept of an asset's bytes.
struct GoldenAsset {
    int version = 0;                           // of its baker
    std::string content;                       // ManifestAsset::content_hash
    std::map<std::string, std::string> files;  // name -> hash of what it stores

    bool operator==(const GoldenAsset&) const = default;
};

using GoldenAssets = std::map<std::string, GoldenAsset>;  // by "recipe.asset"

// Without what a file says of itself in words, which names the release.
std::string hash_of_exr(const fs::path& path) {
    const ExrImage image = read_exr(path);
    Hasher hasher;
    for (const std::string& name : image.channel_names) hasher.update(name + "\n");
    hasher.update(fmt::format("{} x {}, {}\n", image.pixels.width, image.pixels.height,
                              image.pixel_type == config::PixelType::half));
    hasher.update(stored_bytes(image.pixels, image.pixel_type));
    return hasher.hex();
}

// The values of each of some levels behind a line of its own; of sparse files with the places of the
// values. Deflate's and zstd's bytes are those of the system's libraries, and TIFF files say of
// themselves which release wrote them.
std::string hash_of_values(const fs::path& path, const ManifestAsset& asset,
                           const ManifestFile& file, const std::vector<std::string>& heads,
                           bool with_places = false) {
    Hasher hasher;
    const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
        if (with_places) hasher.update(fmt::format("{} {}\n", first, count));
        const auto floats = static_cast<std::size_t>(count) * asset.channels.size();
        hasher.update({reinterpret_cast<const char*>(values), floats * sizeof(float)});
        return true;
    };
    for (std::size_t level = 0; level < heads.size(); ++level) {
        hasher.update(heads[level]);
        EXPECT_TRUE(read_asset_file(path, asset, file, static_cast<int>(level), visit)
                        .value.value_or(false))
            << path;
    }
    return hasher.hex();
}

std::string hash_of_stored(const fs::path& folder, const ManifestAsset& asset,
                           const ManifestFile& file) {
    const fs::path path = folder / file.path;
    const std::string& format = file.format;
    if (format == "exr") return hash_of_exr(path);
    if (format == "vdb" || format == "nvdb") {
        std::string grids;
        for (const std::string& grid : file.grids) grids += grid + "\n";
        return hash_of_values(path, asset, file, {grids}, true);
    }
    if (format == "png" || format == "tga" || format == "hdr") {
        const auto level = static_cast<std::size_t>(file.level);
        return hash_of_values(path, asset, file,
                              {sheet_line(asset.levels[level].size, *file.layout)});
    }
    if (format == "ktx2" || format == "tif") {
        std::vector<std::string> levels;
        for (int level = 0; level < file.levels; ++level) {
            levels.push_back(fmt::format("{}\n", level));
        }
        return hash_of_values(path, asset, file, levels);
    }
    const std::set<std::string> bare = {"bin", "dds", "f32", "json", "npy", "usda", "vol"};
    EXPECT_TRUE(bare.contains(format)) << format;
    return xxh3_hex(read_bytes(path));
}

GoldenAssets read_golden() {
    GoldenAssets assets;
    if (!fs::exists(kHashes)) return assets;
    const toml::table file = toml::parse_file(kHashes.string());
    for (const auto& [recipe, sections] : file) {
        for (const auto& [name, values] : *sections.as_table()) {
            const toml::table& section = *values.as_table();
            GoldenAsset asset;
            asset.version = section["version"].value_or(0);
            asset.content = section["content"].value_or("");
            for (const auto& [path, hash] : *section["files"].as_table()) {
                asset.files[std::string(path.str())] = hash.value_or("");
            }
            assets[fmt::format("{}.{}", recipe.str(), name.str())] = asset;
        }
    }
    return assets;
}

void write_golden(const GoldenAssets& assets) {
    std::ofstream file(kHashes);
    file << "# Written by golden_tests (golden_hashes_test.cpp says how); not edited by hand.\n";
    for (const auto& [name, asset] : assets) {
        std::vector<std::string> files;
        for (const auto& [path, hash] : asset.files) {
            files.push_back(fmt::format("\"{}\" = \"{}\"", path, hash));
        }
        file << fmt::format("\n[{}]\nversion = {}\ncontent = \"{}\"\nfiles = {{ {} }}\n", name,
                            asset.version, asset.content, fmt::join(files, ", "));
    }
}

std::vector<std::string> recipe_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(kRecipes)) {
        names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

config::Recipe recipe_named(const std::string& name) {
    const fs::path folder = kRecipes;
    return recipe_of(read_bytes(folder / (name + ".toml")), folder);
}

GoldenAssets baked(const std::string& name) {
    const TemporaryFolder folder;
    const config::Recipe recipe = recipe_named(name);
    TestBake test(recipe, folder.path());
    test.bake.certification = Certification::off;
    test.bake.threads = 0;
    const auto finished = test.run();
    for (const config::Diagnostic& diagnostic : finished.diagnostics) {
        if (diagnostic.severity == config::Severity::error) ADD_FAILURE() << diagnostic.message;
    }
    GoldenAssets assets;
    if (!finished.value) return assets;
    for (std::size_t i = 0; i < finished.value->assets.size(); ++i) {
        const ManifestAsset& entry = finished.value->assets[i].entry;
        GoldenAsset& asset = assets[fmt::format("{}.{}", name, entry.name)];
        asset.version = baker_of(recipe.parameters.bakes[i]).version;
        asset.content = entry.content_hash;
        for (const ManifestFile& file : entry.files) {
            asset.files[file.path] = hash_of_stored(folder.path(), entry, file);
        }
    }
    return assets;
}

// Why `now` may not stand where `golden` stands; empty where it is the same, or of another version.
std::string fault(const GoldenAsset& golden, const GoldenAsset& now) {
    if (golden.version != now.version) return "";
    if (golden.content != now.content) return "other content";
    for (const auto& [path, hash] : golden.files) {
        const auto found = now.files.find(path);
        if (found == now.files.end()) return "no " + path;
        if (found->second != hash) return "other bytes in " + path;
    }
    return golden.files.size() == now.files.size() ? "" : "more files";
}

// Returns the golden assets of one recipe.
GoldenAssets golden_of(const std::string& recipe) {
    GoldenAssets assets = read_golden();
    std::erase_if(assets,
                  [&recipe](const auto& entry) { return !entry.first.starts_with(recipe + "."); });
    return assets;
}

// Writes the file anew with what `recipe` bakes now.
void replace_golden(const std::string& recipe, const GoldenAssets& now) {
    GoldenAssets assets = read_golden();
    for (const auto& [name, asset] : golden_of(recipe)) assets.erase(name);
    assets.insert(now.begin(), now.end());
    write_golden(assets);
}

class GoldenHashes : public ::testing::TestWithParam<std::string> {};

TEST_P(GoldenHashes, AreThoseOfEqualParameters) {
    const bool update = std::getenv("SKYBAKE_UPDATE_GOLDEN") != nullptr;
    const GoldenAssets golden = golden_of(GetParam());
    const GoldenAssets now = baked(GetParam());
    for (const auto& [name, asset] : golden) {
        const auto found = now.find(name);
        if (found == now.end()) {
            EXPECT_TRUE(update) << name << " is not baked any more; update";
            continue;
        }
        const std::string problem = fault(asset, found->second);
        ASSERT_TRUE(problem.empty())
            << name << ": " << problem
            << "; raise the version of its baker in its NAME_baker.cpp, or mend it";
        EXPECT_TRUE(update || asset == found->second) << name << ": its version was raised; update";
    }
    if (update) return replace_golden(GetParam(), now);
    for (const auto& [name, asset] : now) EXPECT_EQ(golden.count(name), 1U) << name << " is new";
}

INSTANTIATE_TEST_SUITE_P(Recipes, GoldenHashes, ::testing::ValuesIn(recipe_names()),
                         [](const auto& parameter) { return parameter.param; });

// The recipes must have baked every asset, and every format of files.
TEST(GoldenRecipes, BakeEveryAssetAndFormat) {
    std::set<std::string_view> assets;
    std::set<std::string> formats;
    for (const std::string& name : recipe_names()) {
        for (const config::Bake& bake : recipe_named(name).parameters.bakes) {
            assets.insert(baker_of(bake).asset);
        }
    }
    for (const AnyBaker& baker : bakers()) EXPECT_EQ(assets.count(baker.asset), 1U) << baker.asset;
    for (const auto& [name, asset] : read_golden()) {
        for (const auto& [path, hash] : asset.files) {
            formats.insert(fs::path(path).extension().string());
        }
    }
    EXPECT_EQ(formats, (std::set<std::string>{".bin", ".dds", ".exr", ".f32", ".hdr", ".json",
                                              ".ktx2", ".npy", ".nvdb", ".png", ".tga", ".tif",
                                              ".usda", ".vdb", ".vol"}));
}

// The lines `key = value` of a baker's own sections, by their keys, of all recipes.
std::map<std::string, std::string> values_baked(const AnyBaker& baker) {
    std::map<std::string, std::string> values;
    for (const std::string& name : recipe_names()) {
        const config::Recipe recipe = recipe_named(name);
        for (const config::Bake& bake : recipe.parameters.bakes) {
            if (&baker_of(bake) != &baker) continue;
            std::istringstream lines(asset_parameters(recipe, bake));
            bool own = false;
            for (std::string line; std::getline(lines, line);) {
                if (line.starts_with("[")) own = line == fmt::format("[bake.{}]", bake.name);
                const std::size_t equals = line.find(" = ");
                if (own && equals != std::string::npos) {
                    values[line.substr(0, equals)] += line.substr(equals);
                }
            }
        }
    }
    return values;
}

// How the files are to be: one code reads these keys for all assets.
bool is_of_files(const config::Field& field) {
    return field.role == config::Role::files || field.key == "pixel_type";
}

void expect_choices(const std::string& values, const config::Field& field, std::string_view asset) {
    if (field.key.ends_with("compression")) return;  // it changes no texel
    // Nor does this; keys of caches have the texts, and tests/incremental bakes for every target.
    if (field.key == "target") return;
    for (const std::string_view choice : config::choice_names(field)) {
        EXPECT_NE(values.find(fmt::format("\"{}\"", choice)), std::string::npos)
            << asset << "." << field.key << " = " << choice;
    }
}

// A choice that no recipe makes is a method whose bytes nobody watches.
TEST(GoldenRecipes, MakeEveryChoiceOfAsset) {
    std::map<std::string, std::string> of_all;
    for (const AnyBaker& baker : bakers()) {
        auto values = values_baked(baker);
        for (const auto& [key, text] : values) of_all[key] += text;
        for (const auto& field : config::find_section("bake.*", baker.asset)->fields) {
            if (!is_of_files(field)) {
                expect_choices(values[std::string(field.key)], field, baker.asset);
            }
        }
    }
    for (const auto& field : config::find_section("bake.*", "transmittance")->fields) {
        if (is_of_files(field)) expect_choices(of_all[std::string(field.key)], field, "all");
    }
}

}  // namespace
}  // namespace skybake::testing
