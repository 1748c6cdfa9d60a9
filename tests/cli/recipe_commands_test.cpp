// init, check, show, explain and schema, as a user meets them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "config/presets/presets.h"
#include "config/recipe/recipe.h"
#include "tests/cli/program.h"

namespace skybake::cli::testing {
namespace {

// Where a preset's line begins in the list.
std::string title_of(const config::Preset& preset) {
    return std::string("\n  ").append(preset.name).append(" ");
}

// --- init ---------------------------------------------------------------------------------------

TEST(InitCommand, WritesARecipeThatChecks) {
    const TemporaryFolder folder;
    for (const config::Preset& preset : config::presets()) {
        SCOPED_TRACE(preset.name);
        const std::string file = (folder / (std::string(preset.name) + ".toml")).string();
        const Result init = run_words({"init", file, "--preset", std::string(preset.name)});
        EXPECT_EQ(init.code, 0) << init.error;
        EXPECT_EQ(init.out, file + "\n");
        const Result check = run_words({"check", file});
        EXPECT_EQ(check.code, 0) << check.error;
        EXPECT_EQ(check.out, "");
    }
}

TEST(InitCommand, DoesNotOverwriteWithoutForce) {
    const TemporaryFolder folder;
    const std::string file = (folder / "mine.toml").string();
    write_bytes(file, "precious");
    expect_said(run_words({"init", file}), 3, {"E0303"});
    EXPECT_EQ(read_bytes(file), "precious");
    EXPECT_EQ(run_words({"init", file, "--force"}).code, 0);
    EXPECT_NE(read_bytes(file), "precious");
}

TEST(InitCommand, PrintsToStandardOutput) {
    const Result result = run_words({"init", "-", "--preset", "mars"});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.out, "[atmosphere.layers.dust]"));
    EXPECT_EQ(result.error, "");
}

TEST(InitCommand, ListsThePresetsOfEachKind) {
    const std::string out = run_words({"init", "--list"}).out;
    std::size_t at = 0;
    std::size_t titles = 0;
    for (const auto& [kind, presets] : {std::pair{"atmospheres: ", config::presets()},
                                        {"\nnoises: ", config::noise_presets()},
                                        {"\nparticles: ", config::particle_presets()},
                                        {"\nlayers: ", config::layer_presets()},
                                        {"\nclouds: ", config::cloud_presets()}}) {
        at = out.find(kind, at);
        ASSERT_NE(at, std::string::npos) << kind;
        const std::string list = out.substr(at, out.find("\n\n", at) - at);
        for (const config::Preset& preset : presets) {
            EXPECT_TRUE(contains(list, title_of(preset))) << preset.name;
        }
        titles += presets.size();
    }
    // A heading for each kind, a blank line after each, and how to use them.
    EXPECT_EQ(count_lines(out), static_cast<long>(titles + 11));
}

TEST(InitCommand, WritesARecipeOfANoise) {
    const TemporaryFolder folder;
    for (const config::Preset& preset : config::noise_presets()) {
        SCOPED_TRACE(preset.name);
        const std::string file = (folder / (std::string(preset.name) + ".toml")).string();
        const std::string name = "noise." + std::string(preset.name);
        EXPECT_EQ(run_words({"init", file, "--preset", name}).code, 0);
        expect_said(run_words({"check", file}), 0, {"no errors; 1 noise, 1 asset to bake"});
    }
    const std::string text = run_words({"init", "-", "--preset", "nubis_shape"}).out;
    expect_has(text, {"\n[noise.shape]\n", "\npreset = \"nubis_shape\"\n",
                      "\n# [noise.shape.channels.R]\n", "\n[bake.shape]\n"});
    expect_has(run_words({"init", "nubis_shape"}).error,
               {"skybake init nubis_shape.toml --preset nubis_shape"});
    expect_has(run_words({"init", "-", "--preset", "nubis_shap"}).error,
               {"did you mean `nubis_shape`?"});
}

TEST(InitCommand, WritesARecipeOfACloud) {
    const TemporaryFolder folder;
    for (const config::Preset& preset : config::cloud_presets()) {
        SCOPED_TRACE(preset.name);
        const std::string name = "clouds." + std::string(preset.name);
        const std::string file = (folder / (name + ".toml")).string();
        EXPECT_EQ(run_words({"init", file, "--preset", name}).code, 0);
        expect_said(run_words({"check", file}), 0, {"1 cloud, 2 assets to bake"});
    }
    // A name that only clouds have needs no prefix; one that noises have too does.
    expect_has(run_words({"init", "-", "--preset", "stratus"}).out, {"\n[clouds.stratus]\n"});
    expect_said(run_words({"init", "-", "--preset", "thesis"}), 2,
                {"name it with its kind: noise.thesis or clouds.thesis"});
    expect_has(run_words({"init", "-", "--preset", "noise.thesis"}).out, {"\n[noise.thesis]\n"});
    const Result towers = run_words({"init", "-", "--preset", "clouds.thesis"});
    expect_has(towers.out, {"\n# [clouds.thesis.towers.0]\n", "\n# The towers are 0 to 2;"});
    EXPECT_EQ(run_words({"init", "-", "--preset", "clouds.earth"}).code, 2);
}

TEST(InitCommand, UnknownPresetsAreSuggested) {
    const Result result = run_words({"init", "-", "--preset", "eart"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.error, "did you mean `earth`?"));
    EXPECT_EQ(result.out, "");
}

TEST(InitCommand, TakesAPresetsNameForASlip) {
    expect_said(run_words({"init", "mars"}), 2, {"skybake init mars.toml --preset mars"});
}

TEST(InitCommand, NamesThePresetsThatAreMeant) {
    const auto error = [](const char* name) {
        const Result result = run_words({"init", "-", "--preset", name});
        EXPECT_EQ(result.code, 2) << name;
        return result.error;
    };
    for (const char* kind : {"clouds"}) {
        EXPECT_TRUE(contains(error(kind), "clouds: altocumulus, cirrus, ")) << kind;
    }
    expect_has(error("noises"), {"noises: billows, nubis_detail, nubis_layer, "});
    const std::string piece = error("cumulus");
    expect_has(piece, {"did you mean clouds.altocumulus or clouds.cumulus_congestus"});
    EXPECT_TRUE(contains(error("qwertz"), "skybake init --list")) << error("qwertz");
}

TEST(InitCommand, SaysWhichPresetItTook) {
    const TemporaryFolder folder;
    expect_said(run_words({"init", (folder / "a.toml").string(), "--preset", "fog"}), 0,
                {"particles.fog"});
}

TEST(InitCommand, MakesTheFolderOfItsFile) {
    const TemporaryFolder folder;
    const std::string file = (folder / "none" / "below" / "x.toml").string();
    EXPECT_EQ(run_words({"init", file}).code, 0);
    EXPECT_EQ(run_words({"check", file}).code, 0);
    write_bytes(folder / "plain", "a file");
    EXPECT_EQ(run_words({"init", (folder / "plain" / "x.toml").string()}).code, 3);
}

// --- check --------------------------------------------------------------------------------------

// What `check` says of the earth with these lines.
Result checked(const std::string& lines, const std::vector<std::string>& options = {}) {
    const TemporaryFolder folder;
    const std::string file = (folder / "recipe.toml").string();
    write_bytes(file, "preset = \"earth_hillaire\"\n" + lines);
    std::vector<std::string> words = {"check", file};
    words.insert(words.end(), options.begin(), options.end());
    return run_words(words);
}

TEST(CheckCommand, ReportsAllErrorsAtOnce) {
    const Result result = checked(
        "[atmosphere.layers.rayleigh]\nscale_hieght = \"8 km\"\n[atmosphere.layers.mie]\ng = 1.2\n",
        {"--set", "atmosphere.layers.ozone.half_width=40deg"});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, "");
    expect_has(result.error,
               {"error[E0102]: unknown key `scale_hieght` in [atmosphere.layers.rayleigh]",
                "^^^^^^^^^^^^ did you mean `scale_height`?",
                "^^^ must be in (-1, 1); typical haze has 0.76",
                "--set `atmosphere.layers.ozone.half_width=40deg`", "3 errors"});
}

TEST(CheckCommand, SaysWhatItFindsAndCounts) {
    expect_said(checked("[particles.hail]\npreset = \"fog\"\nradius = \"9 cm\"\n"), 2,
                {"error[E0144]: [particles.hail]: the largest spheres"});
    expect_said(checked("[atmosphere.layers.mie]\nextinction = \"1 /m\"\n"), 0, {"warning[W0202]"});
    expect_said(checked("[noise.a]\npreset = \"nubis_shape\"\n[noise.b]\n"
                        "preset = \"nubis_detail\"\n[bake.transmittance]\n"),
                0, {"no errors; 3 layers, 2 noises, 1 asset to bake"});
}

TEST(CheckCommand, MachineFormatsAreResults) {
    const Result result = checked("fromat = 1\n", {"--diagnostics", "json"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.out, "E0102"));
    EXPECT_EQ(result.error, "");
}

TEST(CheckCommand, APresetIsNoFile) {
    for (const char* command : {"check", "show", "bake", "sweep", "report", "preview"}) {
        const Result result = run_words({command, "earth"});
        EXPECT_EQ(result.code, 3) << command;
        expect_has(result.error, {"`earth` is a preset and not a file",
                                  "skybake init earth.toml --preset earth"});
    }
    EXPECT_TRUE(contains(run_words({"check", "thesis"}).error, "--preset noise.thesis"));
}

// The text of a pipe is checked as that of a file, and its paths are those of the current folder.
TEST(CheckCommand, ReadsStandardInput) {
    const TemporaryFolder folder;
    write_bytes(folder / "more.toml", "[atmosphere]\nground_albedo = 0.5\n");
    const auto with_input = [&](const std::string& text, const std::vector<std::string>& words) {
        write_bytes(folder / "input", text);
        return run_program(words, [&] {
            ::dup2(::open((folder / "input").c_str(), O_RDONLY), STDIN_FILENO);
            if (::chdir(folder.path().c_str()) != 0) ::_exit(125);
        });
    };
    const std::string text = "preset = \"earth_hillaire\"\ninclude = [\"more.toml\"]\n";
    expect_said(with_input(text + "[bake.transmittance]\nsize = [16, 8]\n", {"check", "-"}), 0,
                {"<stdin>: no errors; 3 layers, 1 asset to bake"});
    EXPECT_EQ(with_input(text, {"show", "-", "atmosphere.ground_albedo"}).out,
              "ground_albedo = 0.5   # more.toml:2\n");
    expect_said(with_input(text + "fromat = 1\n", {"check", "-", "--diagnostics=short"}), 2,
                {"<stdin>:3:1: error[E0102]"});
    EXPECT_EQ(with_input(text, {"sweep", "-", "--vary", "atmosphere.ground_albedo=0,1"}).code, 2);
    EXPECT_EQ(with_input(text, {"preview", "-", "--watch"}).code, 2);
    const Result baked = with_input(text + "[bake.transmittance]\nsize = [16, 8]\n",
                                    {"bake", "-", "-o", "out", "--depfile", "out.d"});
    EXPECT_EQ(baked.code, 0) << baked.error;
    EXPECT_TRUE(contains(read_bytes(folder / "out.d"), "\n  more.toml"));
    EXPECT_EQ(with_input(std::string(5 << 20, '#'), {"check", "-"}).code, 2);
}

TEST(CheckCommand, AMissingRecipeCannotBeRead) {
    expect_said(run_words({"check", "nowhere.toml"}), 3, {"E0300"});
}

// --- show ---------------------------------------------------------------------------------------

class ShowCommand : public ::testing::Test {
  protected:
    ShowCommand() {
        write_bytes(file_, "preset = \"earth_hillaire\"\n[atmosphere.layers.mie]\ng = 0.7\n");
    }

    Result show(std::vector<std::string> words) const {
        words.insert(words.begin(), {"show", file_});
        return run_words(words);
    }

    TemporaryFolder folder_;
    std::string file_ = (folder_ / "recipe.toml").string();
};

TEST_F(ShowCommand, NamesTheOriginOfEachValue) {
    const Result result = show({"--set", "atmosphere.ground_albedo=0.1"});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.error, "");
    expect_has(result.out, {"# preset earth_hillaire\n", "# " + file_ + ":3\n",
                            "ground_albedo = 0.1         # --set `atmosphere.ground_albedo=0.1`\n",
                            "# default\n", "# derived\n"});
}

TEST_F(ShowCommand, PrintsZenithOpticalDepths) {
    const Result result = show({});
    expect_has(result.out, {"# zenith optical depth    680 nm    550 nm    440 nm\n",
                            "#   rayleigh             0.04642    0.1085    0.2648\n",
                            "#   mie                 0.005328  0.005328  0.005328\n",
                            "#   ozone                0.00975   0.02822  0.001275\n"});
}

TEST_F(ShowCommand, ShowsOnePart) {
    EXPECT_TRUE(show({"atmosphere.layers.mie"}).out.starts_with("profile      = \"exponential\""));
    EXPECT_EQ(show({"atmosphere.layers.mie.g"}).out, "g = 0.7   # " + file_ + ":3\n");
    EXPECT_EQ(count_lines(show({"atmosphere.layers.*.scale_height"}).out), 5);
    expect_said(show({"atmosphere.layers.mei"}), 2, {"did you mean `atmosphere.layers.mie`?"});
    EXPECT_TRUE(contains(show({"mie"}).error, "did you mean `atmosphere.layers.mie`?"));
    EXPECT_TRUE(contains(show({"mie.g"}).error, "did you mean `atmosphere.layers.mie.g`?"));
}

TEST(ShowNoise, NamesThePresetAndLeavesOutTheSky) {
    const TemporaryFolder folder;
    const std::string file = (folder / "noise.toml").string();
    write_bytes(file, "[noise.shape]\npreset = \"nubis_shape\"\nseed = 7\n");
    const Result result = run_words({"show", file});
    EXPECT_EQ(result.code, 0);
    expect_has(result.out, {"# preset nubis_shape\n", "\n[noise.shape.channels.R]\n", "# derived\n",
                            "# " + file + ":3\n"});
    EXPECT_FALSE(contains(result.out, "zenith optical depth"));
    EXPECT_EQ(run_words({"show", file, "noise.shape.channels.G.frequencies"}).out,
              "frequencies = [4, 8, 16]   # derived\n");
}

// Parses the text that `show` prints: it is TOML again.
TEST_F(ShowCommand, PrintsToml) {
    const Result result = show({"atmosphere.layers.mie"});
    const auto outcome = config::parse_recipe(
        "preset = \"vacuum\"\n[atmosphere.layers.mie]\n" + result.out, "shown");
    EXPECT_TRUE(outcome.value);
}

// --- explain and schema -------------------------------------------------------------------------

TEST(ExplainCommand, ExplainsKeysAndCodes) {
    EXPECT_TRUE(contains(run_words({"explain", "layers.*.g"}).out, "typical haze has 0.76"));
    EXPECT_TRUE(contains(run_words({"explain", "E0102"}).out, "E0102: unknown key"));
    EXPECT_TRUE(contains(run_words({"explain"}).out, "[atmosphere.layers.*]"));
    EXPECT_TRUE(contains(run_words({"explain", "noise.shape.channels"}).out, "worley_gains"));
    EXPECT_TRUE(contains(run_words({"explain", "W0203"}).out, "octaves too fine for the voxels"));
    expect_said(run_words({"explain", "scale_hieght"}), 2, {"did you mean `scale_height`?"});
}

TEST(SchemaCommand, PrintsJson) {
    for (const char* what : {"recipe", "manifest", "sweep", "events", "plan"}) {
        const Result result = run_words({"schema", what});
        EXPECT_EQ(result.code, 0);
        EXPECT_FALSE(nlohmann::json::parse(result.out, nullptr, false).is_discarded()) << what;
    }
    EXPECT_EQ(run_words({"schema"}).out, run_words({"schema", "recipe"}).out);
    expect_has(run_words({"schema", "manifest"}).out,
               {"\"title\": \"skybake manifest\"", R"("enum": ["exr", "png", "tga", "hdr"])",
                R"("enum": ["exr", "vdb", "bin", "png", "dds", "ktx2", "nvdb", "vol", )"
                R"("npy", "tga", "usda", "tif", "f32", "hdr", "json", "sidecar"])"});
    EXPECT_EQ(run_words({"schema", "recip"}).code, 2);
}

}  // namespace
}  // namespace skybake::cli::testing
