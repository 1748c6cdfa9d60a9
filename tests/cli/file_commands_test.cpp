// info, diff and verify on sample bakes.
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/exr_image.h"

namespace skybake::cli {
namespace {

using nlohmann::json;
using skybake::testing::write_sample_bake;

// Two folders with the same bake.
struct Pair {
    TemporaryFolder first, second;
    Pair() {
        write_sample_bake(first.path(), {"transmittance", "second"});
        write_sample_bake(second.path(), {"transmittance", "second"});
    }
    std::vector<std::string> words(std::vector<std::string> more = {}) const {
        std::vector<std::string> words = {"diff", first.path().string(), second.path().string()};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    void change(const std::function<void(ExrImage&)>& edit) const {
        ExrImage image = read_exr(second / "transmittance.exr");
        edit(image);
        testing::write_bytes(second / "transmittance.exr", encode_exr(image));
    }
};

TEST(InfoCommand, ShowsAFile) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance"});
    const Result result = run_words({"info", (folder / "transmittance.exr").string()});
    EXPECT_EQ(result.code, 0);
    for (const char* piece : {"16 x 8", "R G B, float", "kind", "bruneton", "ground_radius"}) {
        EXPECT_TRUE(contains(result.out, piece)) << piece;
    }
    const Result machine = run_words({"info", (folder / "transmittance.exr").string(), "--json"});
    const json document = json::parse(machine.out);
    EXPECT_EQ(document["size"], json::parse("[16, 8]"));
    EXPECT_EQ(document["attributes"]["skybake/asset"]["kind"], "transmittance");
}

// A manifest of somebody else may call its assets and files anything, and so may a folder.
TEST(InfoCommand, EscapesWhatWouldControlATerminal) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance"});
    const auto strange = folder / "a\x1b]0;b\x07";
    std::filesystem::create_directory(strange);
    std::filesystem::copy(folder / "transmittance.exr", strange / "x\x1b[2J.exr");
    std::string text = testing::read_bytes(folder / "manifest.json");
    const std::string kind = "\"kind\": \"transmittance\"";
    ASSERT_NE(text.find(kind), std::string::npos);
    text.replace(text.find(kind), kind.size(), "\"kind\": \"a\\u001b[2Jb\"");
    testing::write_bytes(strange / "manifest.json", text);
    for (const auto& words :
         std::vector<std::vector<std::string>>{{"info", strange.string()},
                                               {"info", (strange / "x\x1b[2J.exr").string()},
                                               {"info", (strange / "none\x1b[2J.exr").string()},
                                               {"verify", strange.string()},
                                               {"diff", strange.string(), folder.path().string()},
                                               {"check", (strange / "none.toml").string()}}) {
        const Result result = run_words(words);
        EXPECT_EQ(result.out.find('\x1b'), std::string::npos) << words[0] << result.out;
        EXPECT_EQ(result.error.find('\x1b'), std::string::npos) << words[0] << result.error;
        const bool tells = words[0] == "info" || words[0] == "check";
        if (!tells) continue;
        EXPECT_TRUE(contains(result.out + result.error, "\\u001b")) << words[0];
    }
}

TEST(InfoCommand, ShowsAFolder) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance", "second"});
    const Result result = run_words({"info", folder.path().string()});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.out, "second.exr"));
    EXPECT_EQ(run_words({"info", (folder / "manifest.json").string()}).out, result.out);
    const Result machine = run_words({"info", folder.path().string(), "--json"});
    EXPECT_EQ(json::parse(machine.out)["manifest"]["assets"].size(), 2u);
    EXPECT_TRUE(json::parse(machine.out)["missing"].empty());
}

TEST(InfoCommand, TellsWhatIsMissing) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance", "second"});
    EXPECT_FALSE(contains(run_words({"info", folder.path().string()}).out, "missing"));
    std::filesystem::remove(folder / "second.exr");
    const Result result = run_words({"info", folder.path().string()});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.out, " missing ")) << result.out;
    const json event = json::parse(run_words({"info", folder.path().string(), "--json"}).out);
    EXPECT_EQ(event["missing"], json::parse(R"(["second.exr"])"));
}

// A file of bare texels says nothing of itself: the manifest beside it does.
TEST(InfoCommand, ShowsBareTexelsByTheirManifest) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "noise.toml").string();
    testing::write_bytes(recipe,
                         "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 2\n"
                         "[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\n"
                         "formats = [\"bin\", \"ktx2\"]\n");
    const std::string out = (folder / "out").string();
    ASSERT_EQ(run_words({"bake", recipe, "-o", out, "-q"}).code, 0);
    const Result texels = run_words({"info", out + "/n.bin"});
    const Result ktx2 = run_words({"info", out + "/n.ktx2"});
    EXPECT_EQ(texels.code, 0) << texels.error;
    EXPECT_EQ(texels.out.substr(texels.out.find('\n')), ktx2.out.substr(ktx2.out.find('\n')));
    const json event = json::parse(run_words({"info", out + "/n.bin", "--json"}).out);
    EXPECT_EQ(event["asset"]["name"], "n");
    std::filesystem::remove(out + "/manifest.json");
    expect_said(run_words({"info", out + "/n.bin"}), 3, {"E0304"});
}

TEST(InfoCommand, SaysThatARecipeIsNoBakedFile) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "earth.toml", "preset = \"earth\"\n");
    expect_said(run_words({"info", (folder / "earth.toml").string()}), 2,
                {"earth.toml` is a recipe", "`skybake show` shows its values"});
}

TEST(InfoCommand, SaysWhatItCannotRead) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "not an image");
    EXPECT_EQ(run_words({"info", (folder / "a.exr").string()}).code, 3);
    EXPECT_EQ(run_words({"info", (folder / "absent.exr").string()}).code, 3);
    EXPECT_EQ(run_words({"info", folder.path().string()}).code, 3);
}

TEST(DiffCommand, EqualFoldersAreEqual) {
    const Pair pair;
    const Result result = run_words(pair.words());
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_EQ(result.out, "second.exr: equal\ntransmittance.exr: equal\n");
}

TEST(DiffCommand, ShowsWhereValuesDiffer) {
    const Pair pair;
    pair.change([](ExrImage& image) { image.pixels.texel(3, 5)[1] += 0.5f; });
    const Result result = run_words(pair.words());
    EXPECT_EQ(result.code, 1);
    expect_has(result.out, {"transmittance.exr: differs", "column 3, row 5"});
    EXPECT_EQ(run_words(pair.words({"--tolerance", "0.5"})).code, 0);
    EXPECT_EQ(run_words(pair.words({"--tolerance", "0.4"})).code, 1);
    const json document = json::parse(run_words(pair.words({"--json"})).out);
    EXPECT_EQ(document["equal"], false);
    EXPECT_EQ(document["files"][1]["channels"][1]["max_absolute"], 0.5);
}

// Rows of fewer than 8 texels are four bytes of each: R, G, B and the exponent plus 128.
TEST(DiffCommand, ComparesRadiancePicturesByValue) {
    const testing::TemporaryFolder folder;
    const auto picture = [&](const char* name, char green, const std::string& behind) {
        const std::string texels = {64, 64, 64, char(129), 64, green, 32, char(129),
                                    32, 0,  1,  char(128), 0,  0,     0,  0};
        testing::write_bytes(folder / name,
                             "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + texels + behind);
        return (folder / name).string();
    };
    const std::string first = picture("a.hdr", 64, "");
    EXPECT_EQ(run_words({"diff", first, picture("same.hdr", 64, "a comment")}).code, 0);
    const Result result = run_words({"diff", first, picture("b.hdr", 96, "")});
    EXPECT_EQ(result.code, 1);
    expect_has(result.out, {"b.hdr: differs", "G        0.25", "column 1, row 0"});
    EXPECT_EQ(result.out.find("column 1, row 0"), result.out.rfind("column 1, row 0"));
    EXPECT_EQ(run_words({"diff", first, picture("b.hdr", 96, ""), "--tolerance", "0.25"}).code, 0);
    testing::write_bytes(folder / "short.hdr", testing::read_bytes(first).substr(0, 60));
    EXPECT_EQ(run_words({"diff", first, (folder / "short.hdr").string()}).code, 3);
}

TEST(DiffCommand, MetadataCountsOnRequest) {
    const Pair pair;
    pair.change([](ExrImage& image) {
        std::string& entry = image.attributes[0].second;
        entry.replace(entry.find("bruneton"), 8, "other");
    });
    const Result result = run_words(pair.words());
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.out, "mapping/name: bruneton | other")) << result.out;
    EXPECT_EQ(run_words(pair.words({"--metadata"})).code, 1);
}

TEST(DiffCommand, ReportsFilesWithoutCounterpart) {
    const Pair pair;
    std::filesystem::remove(pair.second / "second.exr");
    const Result result = run_words(pair.words());
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(contains(result.out, "second.exr: only in"));
}

TEST(DiffCommand, ComparesTheVariantsOfSweeps) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    testing::write_bytes(
        recipe,
        "[noise.n.channels.Y]\ntype = \"perlin\"\n[bake.n]\nasset = "
        "\"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\nformats = [\"bin\"]\n");
    const std::string first = (folder / "first").string();
    const std::string second = (folder / "second").string();
    ASSERT_EQ(run_words({"sweep", recipe, "--vary", "noise.n.seed=1,2", "-o", first}).code, 0);
    std::filesystem::copy(first, second, std::filesystem::copy_options::recursive);
    EXPECT_EQ(run_words({"diff", first, second}).code, 0);
    testing::write_bytes(second + "/0001_seed=2/n.bin",
                         testing::read_bytes(second + "/0000_seed=1/n.bin"));
    const Result changed = run_words({"diff", first, second});
    EXPECT_EQ(changed.code, 1);
    expect_has(changed.out, {"0000_seed=1/n.bin: equal", "0001_seed=2/n.bin: differs"});
    std::filesystem::remove_all(second + "/0001_seed=2");
    const Result missing = run_words({"diff", first, second});
    EXPECT_EQ(missing.code, 1);
    expect_has(missing.out, {"0001_seed=2/n.bin: only in"});
}

// Whatever format an asset is in, it is the same asset. Places of voxels are equal but for rounding, here of 3e-18 m.
TEST(DiffCommand, ComparesFormatsOfOneAsset) {
    const testing::TemporaryFolder folder;
    const std::string recipe = (folder / "r.toml").string();
    testing::write_bytes(recipe,
                         "[noise.n]\nsize = [24, 24, 24]\n[noise.n.channels.Y]\ntype = \"perlin\"\n"
                         "frequency = 2\n[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\n"
                         "formats = [\"exr\", \"vdb\", \"nvdb\", \"npy\"]\n");
    const auto file = [&](const char* seed, const char* end) {
        return (folder / seed / "n.").string() + end;
    };
    for (const std::string seed : {"1", "2"}) {
        ASSERT_EQ(run_words({"bake", recipe, "-o", (folder / seed).string(), "--set",
                             "noise.n.seed=" + seed})
                      .code,
                  0);
    }
    for (const auto& [first, second] : {std::pair{"vdb", "nvdb"}, {"npy", "exr"}, {"exr", "npy"}}) {
        EXPECT_EQ(run_words({"diff", file("1", first), file("1", second)}).code, 0) << first;
        const Result other = run_words({"diff", file("1", first), file("2", second)});
        EXPECT_EQ(other.code, 1) << first;
        expect_has(other.out, {"differs"});
    }
}

TEST(DiffCommand, RefusesWhatCannotBeCompared) {
    const Pair pair;
    EXPECT_EQ(
        run_words({"diff", pair.first.path().string(), (pair.second / "second.exr").string()}).code,
        2);
    EXPECT_EQ(run_words({"diff", "/absent/a.exr", "/absent/b.exr"}).code, 3);
    EXPECT_EQ(run_words({"diff", "/absent/a", pair.first.path().string()}).code, 3);
    for (const char* tolerance : {"-1", "nan", "x", "1e", ""}) {
        EXPECT_EQ(run_words(pair.words({std::string("--tolerance=") + tolerance, "-q"})).code, 2)
            << tolerance;
    }
}

TEST(VerifyCommand, CountsWhatPassedAndTellsAMovedProbe) {
    using skybake::testing::write_bytes;
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    const std::string out = (folder / "out").string();
    write_bytes(recipe,
                "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [16, 8]\n"
                "[bake.second]\nasset = \"transmittance\"\nmapping = \"ue\"\nsize = [16, 8]\n");
    ASSERT_EQ(run_words({"bake", recipe, "-o", out}).code, 0);
    const Result result = run_words({"verify", out});
    EXPECT_EQ(result.code, 0) << result.out;
    expect_has(result.out, {"2 files, ", " checks, all passed\n"});
    // A probe that names another place than its texture coordinates.
    std::string manifest = testing::read_bytes(out + "/manifest.json");
    const std::size_t at = manifest.find("\"cos_zenith\": ");
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, manifest.find_first_of(",\n", at) - at, "\"cos_zenith\": 0.8125");
    write_bytes(out + "/manifest.json", manifest);
    const Result moved = run_words({"verify", out});
    EXPECT_EQ(moved.code, 1);
    expect_has(moved.out, {"probe place"});
}

// Returns the failures of `verify --json`, but for places of probes: the parameters of the samples are
// no recipe.
std::vector<json> failures_of_samples(const std::string& folder) {
    const json document = json::parse(run_words({"verify", folder, "--json"}).out);
    EXPECT_EQ(document["passed"], false);
    std::vector<json> failures;
    for (const json& failure : document["failures"]) {
        if (failure["check"] != "probe place") failures.push_back(failure);
    }
    return failures;
}

TEST(VerifyCommand, ListsEveryFailure) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance", "second"});
    std::filesystem::remove(folder / "second.exr");
    std::filesystem::resize_file(folder / "transmittance.exr", 500);
    const Result result = run_words({"verify", folder.path().string()});
    EXPECT_EQ(result.code, 1);
    for (const char* piece : {"second.exr: file: ", "transmittance.exr: bytes: ",
                              "transmittance.exr: xxh3: ", "transmittance.exr: format: "}) {
        EXPECT_TRUE(contains(result.out, piece)) << piece << "\n" << result.out;
    }
    EXPECT_EQ(failures_of_samples(folder.path().string()).size(), 4u);
}

TEST(VerifyCommand, TellsAnEditedManifestOnce) {
    using skybake::testing::read_bytes;
    using skybake::testing::write_bytes;
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance", "second"});
    std::string text = read_bytes(folder / "manifest.json");
    const std::size_t at = text.rfind("\"solar_irradiance\": [");
    ASSERT_NE(at, std::string::npos);
    text.insert(at + 21, "2, ");
    write_bytes(folder / "manifest.json", text);
    const Result result = run_words({"verify", folder.path().string()});
    EXPECT_EQ(result.code, 1);
    expect_has(result.out, {"manifest.json: hash: `assets[1]`, the entry of `second`, has "
                            "been changed since the bake wrote it"});
    const std::vector<json> failures = failures_of_samples(folder.path().string());
    // The units in the manifest stand in the file too.
    ASSERT_EQ(failures.size(), 2u) << json(failures);
    EXPECT_EQ(failures[0]["check"], "hash");
    EXPECT_EQ(failures[1]["check"], "metadata");
}

TEST(VerifyCommand, SaysWhatToDoAboutAnEarlierFormat) {
    const TemporaryFolder folder;
    skybake::testing::write_bytes(
        folder / "manifest.json",
        R"({"format": 1, "tool": {"name": "skybake", "version": "0.0.9"}, "assets": []})");
    expect_said(run_words({"verify", folder.path().string()}), 3,
                {"release 0.0.9 wrote format 1", "bake the recipe into this folder again"});
}

TEST(VerifyCommand, NeedsAManifest) {
    const TemporaryFolder folder;
    const Result result = run_words({"verify", folder.path().string()});
    EXPECT_EQ(result.code, 3);
    expect_has(result.error, {"error[E0300]", "holds no bake: it has no manifest.json"});
    EXPECT_TRUE(result.out.empty());
    EXPECT_TRUE(contains(run_words({"info", folder.path().string()}).error, "holds no bake"));
    EXPECT_FALSE(contains(run_words({"verify", (folder / "absent").string()}).error, "no bake"));
}

TEST(VerifyCommand, TakesTheFolderOfAFile) {
    const TemporaryFolder folder;
    write_sample_bake(folder.path(), {"transmittance"});
    expect_said(run_words({"verify", (folder / "transmittance.exr").string()}), 2,
                {"skybake verify " + folder.path().string() + "\n"});
}

}  // namespace
}  // namespace skybake::cli
