#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "bakers/assets/registry/probe_check.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/math/hash.h"
#include "config/sections/layer.h"
#include "tests/probes/baked_recipe.h"
#include "tests/probes/texels.h"

namespace skybake::testing {
namespace {

namespace fs = std::filesystem;

// A file of an asset, a table's as a texture of one slice.
struct BakedFile {
    std::string name;
    std::size_t dimensions = 3;
    Texels texels;
    Sampler sampler;
    std::vector<Probe> probes;
    std::vector<std::string> catches;
};

BakedFile read_file(const fs::path& folder, const ManifestAsset& asset, const ManifestFile& entry) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(entry.level)];
    BakedFile file;
    file.name = entry.path;
    file.dimensions = asset.axes.size();
    file.texels = {level.size, asset.channels.size(), {}};
    const auto visit = [&](std::int64_t, std::int64_t count, const float* values) {
        const auto total = static_cast<std::size_t>(count) * file.texels.channels;
        file.texels.values.insert(file.texels.values.end(), values, values + total);
        return true;
    };
    EXPECT_TRUE(read_asset_file(folder / entry.path, asset, entry, 0, visit).value.value_or(false));
    for (std::size_t i = 0; i < asset.axes.size(); ++i) {
        file.sampler.repeats[i] = asset.axes[i].wrap == AxisWrap::repeat;
    }
    file.sampler.nearest = asset.axes[0].filter == AxisFilter::nearest;
    file.probes = level.probes;
    file.catches = level.catches;
    return file;
}

// How many probes a file fails, whose lookups are made at `place` of the right coordinates.
int failed_probes(const BakedFile& file, const Texels& texels, const Sampler& sampler,
                  const std::function<Uvw(const Uvw&)>& place) {
    int failed = 0;
    for (const Probe& probe : file.probes) {
        std::vector<double> found = looked_up(texels, sampler, place(probe.uvw));
        if (probe.blend) {
            const std::vector<double> other = looked_up(texels, sampler, place(probe.blend->uvw));
            for (std::size_t c = 0; c < found.size(); ++c) {
                found[c] = std::lerp(found[c], other[c], probe.blend->share);
            }
        }
        bool holds = true;
        for (std::size_t c = 0; c < found.size(); ++c) {
            holds = holds && std::fabs(found[c] - probe.value[c]) <= probe.tolerance[c];
        }
        failed += holds ? 0 : 1;
    }
    return failed;
}

Uvw same(const Uvw& uvw) { return uvw; }

int failed_probes(const BakedFile& file, const Texels& texels) {
    return failed_probes(file, texels, file.sampler, same);
}

// The fewest probes that fail when the file is half a texel off to one side or the other.
int failed_by_shift(const BakedFile& file, std::size_t axis) {
    int fewest = static_cast<int>(file.probes.size());
    for (const int side : {-1, 1}) {
        // No file can be half a texel off where lookups take the nearest: a lookup can.
        const auto moved = [&](Uvw uvw) {
            uvw[axis] += 0.5 * side / file.texels.size[axis];
            return uvw;
        };
        const int failed =
            file.sampler.nearest
                ? failed_probes(file, file.texels, file.sampler, moved)
                : failed_probes(file, shifted(file.texels, file.sampler, axis, side));
        fewest = std::min(fewest, failed);
    }
    return fewest;
}

int failed_by_swap(const BakedFile& file, std::size_t a, std::size_t b) {
    if (file.texels.size[a] == file.texels.size[b] && !file.sampler.nearest) {
        return failed_probes(file, exchanged(file.texels, a, b));
    }
    return failed_probes(file, file.texels, file.sampler, [&](Uvw uvw) {
        std::swap(uvw[a], uvw[b]);
        return uvw;
    });
}

// Returns for each fault how many probes fail.
std::map<std::string, int> failed_by_fault(const BakedFile& file) {
    std::map<std::string, int> failed = {{"zeros", failed_probes(file, zeros(file.texels))}};
    for (std::size_t a = 0; a < file.dimensions; ++a) {
        failed[fmt::format("flip_{}", "uvw"[a])] = failed_probes(file, flipped(file.texels, a));
        failed[fmt::format("shift_{}", "uvw"[a])] = failed_by_shift(file, a);
        for (std::size_t b = a + 1; b < file.dimensions; ++b) {
            failed[fmt::format("swap_{}{}", "uvw"[a], "uvw"[b])] = failed_by_swap(file, a, b);
        }
    }
    return failed;
}

// A fault that changes no lookup: of an axis of one texel.
bool changes_nothing(const BakedFile& file, const std::string& fault) {
    std::size_t long_axes = 0;
    for (const char axis : fault.substr(fault.find('_') + 1)) {
        if (axis >= 'u' && axis <= 'w') {
            long_axes += file.texels.size[static_cast<std::size_t>(axis - 'u')] > 1 ? 1 : 0;
        }
    }
    return fault != "zeros" && long_axes == 0;
}

void expect_faults_caught(const BakedFile& file) {
    EXPECT_EQ(failed_probes(file, file.texels), 0) << file.name;
    EXPECT_GE(file.probes.size(), 16u) << file.name;
    const std::map<std::string, int> failed = failed_by_fault(file);
    for (const auto& [fault, probes] : failed) {
        if (changes_nothing(file, fault)) continue;
        EXPECT_GE(probes, 3) << file.name << ": " << fault;
        EXPECT_EQ(std::count(file.catches.begin(), file.catches.end(), fault), 1)
            << file.name << ": " << fault;
    }
    // Most probes lie where there is something.
    EXPECT_GE(failed.at("zeros") * 4, static_cast<int>(file.probes.size()) * 3) << file.name;
    for (const Probe& probe : file.probes) {
        for (const double tolerance : probe.tolerance) EXPECT_GT(tolerance, 0) << file.name;
    }
}

std::vector<BakedFile> files_of(const fs::path& folder) {
    const Manifest manifest = *read_manifest(folder).value;
    std::vector<BakedFile> files;
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& entry : asset.files) {
            const bool is_read =
                asset.is_volume() ? entry.format == "bin" : &entry == asset.files.data();
            if (is_read) files.push_back(read_file(folder, asset, entry));
        }
    }
    return files;
}

// Expects that verification passes, with each probe at the place that it names, and that each wrong
// file is told.
void expect_told(const fs::path& folder) {
    const std::array checks = {probe_check()};
    const auto report = verify_bake(folder, checks);
    ASSERT_TRUE(report.value.has_value());
    for (const VerifyFailure& failure : report.value->failures) {
        ADD_FAILURE() << failure.file << ": " << failure.check << ": " << failure.message;
    }
    for (const BakedFile& file : files_of(folder)) expect_faults_caught(file);
}

TEST(EveryAsset, TellsFaultsOfItsFiles) { expect_told(every_asset().folder.path()); }

// Colours need not be above 0.
TEST(FileFaults, AreToldInBrunetonsTablesOfColours) {
    expect_told(BakedRecipe(R"(
preset = "earth"
[bake.b_transmittance]
asset = "bruneton"
table = "transmittance"
size = [64, 16, 1]
formats = ["bin"]
[bake.b_scattering]
asset = "bruneton"
table = "scattering"
orders = 1
size = [32, 16, 8]
nu_size = 4
formats = ["bin"]
)")
                    .folder.path());
}

TEST(FileFaults, AreToldInColumnsOfFog) {
    const std::string fog = "preset = 'earth_hillaire'\n[atmosphere.layers.fog]\npreset = 'fog'\n";
    std::string columns;
    for (const char* keys :
         {"to_top]\nsize = [32, 16, 1]\n", "between]\ntable = 'between'\nsize = [16, 16, 16]\n",
          "along]\ntable = 'between'\ncoordinates = 'distance'\nsize = [16, 8, 8]\n",
          "density]\ntable = 'density'\n"}) {
        columns += fmt::format(
            "[bake.{}asset = 'optical_depth'\nkinds = ['rayleigh', 'fog']\nformats = ['bin']\n",
            keys);
    }
    columns +=
        "[bake.phases]\nasset = 'optical_depth'\ntable = 'phase'\nkinds = ['rayleigh', 'mie']\n"
        "formats = ['bin']\n";
    expect_told(BakedRecipe(fog + columns).folder.path());
}

// A picture towards the sun is the same mirrored, and a vacuum lets everything pass everywhere: no
// probe can tell, and the manifest does not say that one does.
TEST(FileFaults, ThatChangeNothingAreNotSaidToBeTold) {
    const BakedRecipe baked(R"(
preset = "earth_hillaire"
[bake.aerial_perspective]
orders = "single"
size = [12, 12, 12]
altitude = "500 m"
sun_elevation = "20 deg"
heading = "0 deg"
formats = ["bin"]
)");
    const BakedFile picture = files_of(baked.folder.path()).front();
    EXPECT_EQ(failed_by_fault(picture).at("flip_u"), 0);
    EXPECT_GE(failed_by_fault(picture).at("flip_v"), 3);
    EXPECT_EQ(std::count(picture.catches.begin(), picture.catches.end(), "flip_u"), 0);
    EXPECT_EQ(std::count(picture.catches.begin(), picture.catches.end(), "flip_v"), 1);

    const BakedRecipe empty("preset = \"vacuum\"\n[bake.transmittance]\nsize = [16, 16]\n");
    const BakedFile vacuum = files_of(empty.folder.path()).front();
    EXPECT_EQ(vacuum.catches, std::vector<std::string>{"zeros"});
    EXPECT_GE(failed_by_fault(vacuum).at("zeros"), 3);
}

// Writes a volume's file anew, and in the manifest all that is known of its bytes: only what a
// lookup finds tells it from the right one.
void forge(const fs::path& folder, const Texels& texels) {
    Manifest manifest = *read_manifest(folder).value;
    ManifestAsset& asset = manifest.assets[0];
    ASSERT_EQ(asset.files[0].pixel_type, config::PixelType::float32);
    const std::vector<float> values(texels.values.begin(), texels.values.end());
    std::string bytes(values.size() * sizeof(float), '\0');
    store_values(values.data(), values.size(), config::PixelType::float32, bytes.data());
    ManifestLevel& level = asset.levels[0];
    level.content_hash = asset.content_hash = xxh3_hex(bytes);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    level.statistics[0].min = double{*least};
    level.statistics[0].max = double{*most};
    replace_file(folder, manifest, 0, bytes);
}

TEST(FileFaults, AreToldByVerifyWhereAllHashesAgree) {
    const BakedRecipe baked(R"(
[noise.shape.channels.Y]
type = "perlin"
frequency = 4
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [16, 16, 16]
formats = ["bin"]
pixel_type = "float"
)");
    const fs::path& folder = baked.folder.path();
    const BakedFile file = files_of(folder).front();
    forge(folder, file.texels);
    EXPECT_TRUE(failed_checks(folder).empty());
    std::map<std::string, Texels> wrong = {{"zeros", zeros(file.texels)},
                                           {"swap_uw", exchanged(file.texels, 0, 2)}};
    for (std::size_t a = 0; a < 3; ++a) {
        wrong[fmt::format("flip {}", a)] = flipped(file.texels, a);
        wrong[fmt::format("shift {}", a)] = shifted(file.texels, file.sampler, a, 1);
    }
    for (const auto& [fault, texels] : wrong) {
        forge(folder, texels);
        Checks failed = failed_checks(folder);
        EXPECT_GE(failed.count("probe"), 3u) << fault;
        failed.erase("probe");
        failed.erase("catches");  // of a file turned round, turning it round again is right
        EXPECT_TRUE(failed.empty()) << fault << ": " << *failed.begin();
    }
}

// Each packet of wavelengths has its own probes, which tell one from the other.
TEST(FileFaults, AreToldByVerifyWherePacketsAreExchanged) {
    const BakedRecipe baked(
        "preset = 'earth'\nwavelengths = 'best 8'\n[color]\nspace = 'none'\n"
        "[bake.transmittance]\nsize = [16, 16]\n");
    const fs::path& folder = baked.folder.path();
    EXPECT_TRUE(failed_checks(folder).empty());
    Manifest manifest = baked.manifest;
    ASSERT_EQ(manifest.assets.size(), 2u);
    // Files, hashes and statistics change places; probes, wavelengths and places do not.
    std::swap(manifest.assets[0].files, manifest.assets[1].files);
    std::swap(manifest.assets[0].content_hash, manifest.assets[1].content_hash);
    ManifestLevel& first = manifest.assets[0].levels[0];
    ManifestLevel& second = manifest.assets[1].levels[0];
    std::swap(first.content_hash, second.content_hash);
    std::swap(first.statistics, second.statistics);
    save_manifest(folder, manifest);
    EXPECT_GE(failed_checks(folder).count("probe"), 10u);
}

// Probes that would pass anything are no proof, and verify says so.
TEST(FileFaults, AreToldByVerifyWhereProbesTellNothing) {
    const BakedRecipe baked("preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 16]\n");
    const fs::path& folder = baked.folder.path();
    Manifest manifest = baked.manifest;
    ASSERT_TRUE(failed_checks(folder).empty());
    for (Probe& probe : manifest.assets[0].levels[0].probes) {
        for (double& tolerance : probe.tolerance) tolerance = 10;
    }
    save_manifest(folder, manifest);
    EXPECT_EQ(failed_checks(folder).count("catches"), manifest.assets[0].levels[0].catches.size());
    EXPECT_GE(manifest.assets[0].levels[0].catches.size(), 6u);
}

}  // namespace
}  // namespace skybake::testing
