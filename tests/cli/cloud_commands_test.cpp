// Bakes of clouds and occupancy grids through the command line, and what verify proves of them.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using namespace skybake::cli::testing;
namespace fs = std::filesystem;

class CloudBake : public RecipeTest {
  protected:
    CloudBake() { write(7); }
    std::vector<std::string> failed_checks() const {
        const Result verified = run_words({"verify", out_, "--json"});
        EXPECT_EQ(verified.code, 1);
        const auto report = nlohmann::json::parse(verified.out);
        std::vector<std::string> checks;
        for (const auto& failure : report["failures"]) checks.push_back(failure["check"]);
        return checks;
    }
    void write(int seed, const std::string& keys = "") {
        write_bytes(recipe_,
                    "[noise.n]\nseed = " + std::to_string(seed) +
                        "\n[noise.n.channels.Y]\ntype = \"perlin\"\nfrequency = 4\noctaves = 1\n"
                        "[clouds.c]\nnoise = \"n\"\nextent = [\"1 km\", \"1 km\", \"500 m\"]\n"
                        "threshold = 0.6\nheight_profile = { type = \"tabulated\", table = [[0, "
                        "1]] }\n" +
                        keys +
                        "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [32, 32, 16]\n"
                        "formats = [\"vdb\", \"exr\", \"bin\"]\n"
                        "[bake.g]\nasset = \"occupancy\"\nof = \"c\"\ncell = 2\n"
                        "formats = [\"exr\", \"vdb\", \"bin\"]\nmips = \"all\"\n"
                        "[bake.d]\nasset = \"cloud_distance\"\nof = \"c\"\ncell = 2\n");
    }
};

TEST_F(CloudBake, VerifiesInAllFormats) {
    const Result baked = bake();
    ASSERT_EQ(baked.code, 0) << baked.error;
    const Result verified = run_words({"verify", out_});
    EXPECT_EQ(verified.code, 0) << verified.out << verified.error;
    const Result again = bake({"-j", "1"});
    EXPECT_EQ(again.code, 0) << again.error;
}

// A frame says how much changes until the next one. A box holds 8 x 8 x 8 voxels, which are all of these.
TEST_F(CloudBake, FramesSayHowMuchTheyChange) {
    const auto write_loop = [&](int period) {
        write_bytes(recipe_,
                    fmt::format("[noise.n]\nperiod = {0}\n[noise.n.channels.Y]\ntype = \"perlin\"\n"
                                "frequency = 2\n[clouds.c]\nnoise = \"n\"\nextent = [\"1 km\", "
                                "\"1 km\", \"1 km\"]\nthreshold = 0.5\nheight_profile = {{ type = "
                                "\"tabulated\", table = [[0, 1]] }}\n[bake.c]\nasset = "
                                "\"cloud_volume\"\ncloud = \"c\"\nsize = [8, 8, 8]\nframes = {0}\n"
                                "formats = [\"bin\"]\npixel_type = \"float\"\n",
                                period));
    };
    write_loop(4);
    const Result fast = bake();
    ASSERT_EQ(fast.code, 0) << fast.error;
    EXPECT_EQ(fast.error.find("W0229"), fast.error.rfind("W0229"));  // once for all frames
    EXPECT_NE(fast.error.find("W0229"), std::string::npos) << fast.error;
    const auto manifest = nlohmann::json::parse(read_bytes(out_ + "/manifest.json"));
    for (const int frame : {3, 4}) {  // after the last one comes the first
        const std::string before = read_bytes(fmt::format("{}/c_{:04}.bin", out_, frame));
        const std::string after = read_bytes(fmt::format("{}/c_{:04}.bin", out_, frame % 4 + 1));
        double cloudy = 0, flips = 0, squares = 0;
        for (std::size_t i = 0; i < before.size(); i += sizeof(float)) {
            float a = 0, b = 0;
            std::memcpy(&a, before.data() + i, sizeof(float));
            std::memcpy(&b, after.data() + i, sizeof(float));
            if (a == 0 && b == 0) continue;
            ++cloudy;
            flips += a == 0 || b == 0 ? 1 : 0;
            squares += (double{a} - double{b}) * (double{a} - double{b});
        }
        const auto& details = manifest["assets"][static_cast<std::size_t>(frame - 1)]["details"];
        EXPECT_GT(flips, 0);
        EXPECT_DOUBLE_EQ(details["flips_per_frame"], flips / cloudy);
        EXPECT_NEAR(details["rms_change_per_frame"], std::sqrt(squares / cloudy), 1e-6);
    }
    write_loop(96);
    EXPECT_EQ(bake().error.find("W0229"), std::string::npos);
}

// A recipe of a small cloud that grows.
std::string grown_recipe(int height_m, const std::string& keys = "") {
    return fmt::format(
        "[clouds.c]\nshape = \"convection\"\nextent = [\"1 km\", \"1 km\", \"{} m\"]\n{}"
        "[clouds.c.convection]\ncells = [20, 20, {}]\nmixed_layer = \"200 m\"\n"
        "inversion = \"300 m\"\npatches = 2\npatch_width = [\"300 m\", \"400 m\"]\nminutes = 12\n"
        "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [20, 20, {}]\n",
        height_m, keys, height_m / 50, height_m / 50);
}

// It reaches any cover, below that with which it has grown and above it.
TEST_F(CloudBake, MeetsTheCoverOfACloudThatGrows) {
    for (const double cover : {0.01, 0.1, 0.5, 1.0}) {
        write_bytes(recipe_, grown_recipe(900, fmt::format("cover = {}\n", cover)));
        const Result result = bake();
        ASSERT_EQ(result.code, 0) << result.error;
        const auto details =
            nlohmann::json::parse(read_bytes(out_ + "/manifest.json"))["assets"][0]["details"];
        EXPECT_NEAR(details["covered_columns"], cover, 1.0 / 400) << details["coverage"];
    }
    write_bytes(recipe_, grown_recipe(900, "cover = 0\n"));
    EXPECT_EQ(bake().code, 0);
}

// What reaches the top of its box is cut there.
TEST_F(CloudBake, WarnsWhereACloudThatGrowsIsCut) {
    const auto baked = [&](int height_m) {
        write_bytes(recipe_, grown_recipe(height_m));
        const Result result = bake();
        EXPECT_EQ(result.code, 0) << result.error;
        return result.error;
    };
    EXPECT_NE(baked(400).find("W0230"), std::string::npos);
    EXPECT_EQ(baked(900).find("W0230"), std::string::npos);
}

// The share of columns with cloud is stated wherever a bake speaks of its assets.
TEST_F(CloudBake, StatesItsCoverAndWarnsWhenThereIsNone) {
    write(7, "cover = \"25 %\"\n");
    const Result baked = bake({"--only", "c"});
    ASSERT_EQ(baked.code, 0) << baked.error;
    EXPECT_NE((baked.out + baked.error).find("25 %"), std::string::npos) << baked.error;
    EXPECT_EQ(baked.error.find("W0215"), std::string::npos);
    const auto manifest = nlohmann::json::parse(read_bytes(out_ + "/manifest.json"));
    EXPECT_EQ(manifest["assets"][0]["details"]["covered_columns"], 0.25);
    const Result info = run_words({"info", out_ + "/c.vdb"});
    EXPECT_NE(info.out.find("covered_columns = 0.25"), std::string::npos) << info.out;
    write(7, "coverage = 0\n");
    expect_said(bake(), 0, {"W0215"});
    EXPECT_EQ(run_words({"verify", out_}).code, 0) << "of nothing there are valid files, too";
    EXPECT_EQ(run_words({"info", out_ + "/c.vdb"}).code, 0);
    write(7, "cover = 1\n");
    expect_said(bake({"--only", "c"}), 4, {"E0412"});
}

// What leaps and distances save is stated, with one warning for each that saves nothing.
TEST_F(CloudBake, StatesWhatSkippingSavesAndWarnsWhereItIsNothing) {
    write(7, "cover = \"1 %\"\n");
    const Result sparse = bake();
    ASSERT_EQ(sparse.code, 0) << sparse.error;
    EXPECT_EQ(sparse.error.find("W0227"), std::string::npos) << sparse.error;
    const auto manifest = nlohmann::json::parse(read_bytes(out_ + "/manifest.json"));
    for (const std::size_t skipping : {1, 2}) {
        const auto& asset = manifest["assets"][skipping];
        const double without = asset["details"]["fetches_without"];
        const double with = asset["details"]["fetches_with"];
        EXPECT_GT(without, 1.5 * with);
        char line[80];
        std::snprintf(line, sizeof line, "%s: %.2f x fewer fetches from below",
                      asset["name"].get<std::string>().c_str(), without / with);
        EXPECT_NE((sparse.out + sparse.error).find(line), std::string::npos) << line << sparse.out;
    }
    write(7, "cover = \"90 %\"\n");
    const Result dense = bake();
    ASSERT_EQ(dense.code, 0) << dense.error;
    EXPECT_NE(dense.error.find("`g` is not worth its fetches"), std::string::npos) << dense.error;
    EXPECT_NE(dense.error.find("`d` is not worth its fetches"), std::string::npos) << dense.error;
    EXPECT_EQ((dense.out + dense.error).find("fewer fetches"), std::string::npos);
}

// A grid of another cloud than the one beside it: every file is what the manifest says, and yet a
// ray would lose something.
TEST_F(CloudBake, VerifyFindsWhatAGridLoses) {
    ASSERT_EQ(bake().code, 0);
    write(8);
    ASSERT_EQ(bake({"--only", "c"}).code, 0);
    EXPECT_EQ(failed_checks(), (std::vector<std::string>{"skipping", "distance"}));
}

// Distances to a cloud that has since shrunk are too near.
TEST_F(CloudBake, VerifyFindsDistancesOfAnOldThreshold) {
    ASSERT_EQ(bake().code, 0);
    std::string recipe = read_bytes(recipe_);
    recipe.replace(recipe.find("threshold = 0.6"), 15, "threshold = 0.7");
    write_bytes(recipe_, recipe);
    ASSERT_EQ(bake({"--only", "c"}).code, 0);
    EXPECT_EQ(failed_checks(), std::vector<std::string>{"distance"});
}

// Whatever reads a recipe opens what it names, and says so at the recipe's line.
TEST_F(CloudBake, CheckOpensMaps) {
    write_bytes((folder_ / "text.png").string(), "no picture");
    struct Fault {
        const char* file;
        const char* code;
    };
    for (const Fault& fault : {Fault{"nowhere.png", "E0300"}, Fault{"text.png", "E0304"}}) {
        write(7, std::string("coverage_map = { file = \"") + fault.file + "\" }\n");
        const std::vector<std::vector<std::string>> commands = {
            {"check", recipe_},
            {"bake", recipe_, "-o", out_, "--dry-run"},
            {"bake", recipe_, "-o", out_}};
        for (const std::vector<std::string>& words : commands) {
            const Result result = run_words(words);
            EXPECT_EQ(result.code, 3) << words[0];
            expect_has(result.error, {fault.code, "cannot read the map `", "recipe.toml:12:25"});
        }
    }
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(CloudBake, CheckOpensMapsOfTypes) {
    write_bytes(recipe_,
                "[noise.n]\npreset = \"nubis_shape\"\n[clouds.c]\nnoise = \"n\"\n"
                "extent = [\"1 km\", \"1 km\", \"500 m\"]\n"
                "height_profile = { type = \"blended\" }\ntype_map = { file = \"t.png\" }\n");
    expect_said(run_words({"check", recipe_}), 3, {"cannot read the map `", "recipe.toml:7:21"});
}

}  // namespace
}  // namespace skybake::cli
