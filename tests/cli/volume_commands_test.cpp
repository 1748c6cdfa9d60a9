// Bakes of volumes, and what info, diff and verify say of them.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using namespace skybake::cli::testing;
using nlohmann::json;
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class VolumeBake : public RecipeTest {
  protected:
    VolumeBake() { write("formats = [\"exr\", \"bin\"]\nmips = 2\nlayout = \"atlas\"\n"); }
    void write(const std::string& keys, const std::string& size = "[24, 20, 12]") {
        write_bytes(recipe_,
                    "[noise.wisps]\nseed = 7\n"
                    "[noise.wisps.channels.R]\ntype = \"perlin\"\nfrequency = 2\noctaves = 1\n"
                    "[noise.wisps.channels.G]\ntype = \"worley\"\nfrequency = 3\noctaves = 1\n"
                    "[noise.wisps.channels.B]\ntype = \"constant\"\nvalue = 0.25\n"
                    "[bake.wisps]\nasset = \"noise_volume\"\nnoise = \"wisps\"\nsize = " +
                        size + "\n" + keys);
    }
    Names files() const { return folder_.names("out"); }
    std::string file(const std::string& name) const { return out_ + "/" + name; }

    const Names all_ = {"manifest.json", "wisps.bin", "wisps.exr", "wisps.mip1.bin",
                        "wisps.mip1.exr"};
};

TEST_F(VolumeBake, WritesEachFormatAndLevel) {
    const Result result = bake();
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(result.out, file("wisps.exr") + "\n" + file("wisps.mip1.exr") + "\n" +
                              file("wisps.bin") + "\n" + file("wisps.mip1.bin") + "\n" +
                              file("manifest.json") + "\n");
    expect_has(result.error, {"24x20x12  RGB  wisps.exr", "12x10x6"});
    EXPECT_EQ(files(), all_);
    EXPECT_EQ(fs::file_size(file("wisps.bin")), 24U * 20 * 12 * 3 * 2);
    EXPECT_EQ(fs::file_size(file("wisps.mip1.bin")), 12U * 10 * 6 * 3 * 2);
}

TEST_F(VolumeBake, EventsNameEachFile) {
    const Result result = bake({"--json"});
    ASSERT_EQ(result.code, 0) << result.error;
    std::vector<json> events;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) events.push_back(json::parse(line));
    ASSERT_EQ(events.size(), 6U);
    EXPECT_EQ(events[0]["assets"][0]["size"], json::parse("[24, 20, 12]"));
    EXPECT_GT(events[0]["assets"][0]["disk_mib"], 0);
    EXPECT_EQ(events[2]["path"], file("wisps.mip1.exr"));
    EXPECT_EQ(events[2]["size"], json::parse("[12, 10, 6]"));
    EXPECT_EQ(events[2]["level"], 1);
    EXPECT_EQ(events[3]["format"], "bin");
    EXPECT_EQ(events[5]["assets"], 1);
}

TEST_F(VolumeBake, VerifyTakesFolderAndManifest) {
    ASSERT_EQ(bake().code, 0);
    const Result folder = run_words({"verify", out_});
    EXPECT_EQ(folder.code, 0) << folder.out;
    EXPECT_TRUE(contains(folder.out, "4 files, ")) << folder.out;
    EXPECT_EQ(run_words({"verify", file("manifest.json")}).out, folder.out);
    std::string bytes = read_bytes(file("wisps.bin"));
    bytes[1001] = static_cast<char>(bytes[1001] ^ 1);
    write_bytes(file("wisps.bin"), bytes);
    const Result damaged = run_words({"verify", file("manifest.json")});
    EXPECT_EQ(damaged.code, 1);
    expect_has(damaged.out, {"wisps.bin: xxh3: ", "wisps.bin: content_hash: "});
}

TEST_F(VolumeBake, InfoShowsWhatFilesSay) {
    ASSERT_EQ(bake().code, 0);
    const Result image = run_words({"info", file("wisps.exr")});
    EXPECT_EQ(image.code, 0) << image.error;
    expect_has(image.out, {"layout        atlas of", "cells of 24 x 20 texels, 12 slices"});
    const Result folder = run_words({"info", out_});
    expect_has(folder.out, {"24x20x12", "12x10x6"});
    EXPECT_FALSE(contains(folder.out, "wavelengths")) << folder.out;
    const Result voxels = run_words({"info", file("wisps.bin")});
    EXPECT_EQ(voxels.code, 0) << voxels.error;
    EXPECT_TRUE(contains(voxels.out, "24 x 20 x 12")) << voxels.out;
    EXPECT_FALSE(contains(voxels.out, "12 x 10 x 6")) << voxels.out;
    EXPECT_EQ(run_words({"info", file("absent.bin")}).code, 3);
}

TEST_F(VolumeBake, InfoPrintsTheLookupOfAFile) {
    ASSERT_EQ(bake().code, 0);
    const std::string function =
        "\nvec3 baked_wisps(sampler3D table, vec3 p, vec3 tile) {\n"
        "    return vec3(noise_volume(table, p, tile));\n}\n";
    for (const char* name : {"wisps.exr", "wisps.bin", "wisps.mip1.bin"}) {
        const Result result = run_words({"info", "--lookup", file(name)});
        EXPECT_EQ(result.code, 0) << result.error;
        expect_has(result.out, {function, "// Sampler: linear along u, which repeats;"});
        // The published file's functions are printed only where the file needs them.
        EXPECT_TRUE(contains(result.out, "\nvec4 noise_volume("));
        EXPECT_FALSE(contains(result.out, "noise_volume_at_corners"));
    }
    // A file describes itself, wherever it is and whatever it is called.
    fs::copy(file("wisps.exr"), folder_ / "other.exr");
    const std::string other = (folder_ / "other.exr").string();
    const Result moved = run_words({"info", "--lookup", other});
    EXPECT_TRUE(contains(moved.out, "other.exr: asset = \"noise_volume\" of [bake.wisps]"));
    const json event = json::parse(run_words({"info", "--lookup", other, "--json"}).out);
    EXPECT_EQ(event["event"], "lookup");
    EXPECT_EQ(event["function"], "baked_wisps");
    EXPECT_EQ(event["glsl"], moved.out);
}

TEST_F(VolumeBake, InfoPrintsTheLookupInTheLanguageThatIsAskedFor) {
    ASSERT_EQ(bake().code, 0);
    const std::vector<std::pair<std::string, std::string>> functions = {
        {"hlsl",
         "\nfloat3 baked_wisps(Texture3D table, SamplerState table_sampler, float3 p, float3 tile) "
         "{\n"},
        {"msl", "\ninline float3 baked_wisps(texture3d<float> table, sampler table_sampler,"},
        {"wgsl", "\nfn baked_wisps(table: texture_3d<f32>, table_sampler: sampler, p: vec3f,"},
        {"godot", "\nvec3 baked_wisps(sampler3D table, vec3 p, vec3 tile) {\n"}};
    const Result glsl = run_words({"info", "--lookup", file("wisps.exr")});
    EXPECT_FALSE(contains(glsl.out, "// Language:"));
    EXPECT_EQ(run_words({"info", "--lookup", "--language", "glsl", file("wisps.exr")}).out,
              glsl.out);
    for (const auto& [language, function] : functions) {
        const std::vector<std::string> words = {"info", "--lookup", "--language", language,
                                                file("wisps.exr")};
        const Result result = run_words(words);
        EXPECT_EQ(result.code, 0) << result.error;
        expect_has(result.out, {function, "// Language: "});
        std::vector<std::string> as_json = words;
        as_json.push_back("--json");
        EXPECT_EQ(json::parse(run_words(as_json).out)[language], result.out);
    }
    expect_said(run_words({"info", "--lookup", "--language", "cg", file("wisps.exr")}), 2,
                {"use one of glsl, hlsl, msl, wgsl, godot"});
    expect_said(run_words({"info", "--language", "hlsl", file("wisps.exr")}), 2,
                {"--language needs --lookup"});
}

TEST_F(VolumeBake, InfoSaysOfWhatItPrintsNoLookup) {
    ASSERT_EQ(bake().code, 0);
    EXPECT_EQ(run_words({"info", "--lookup", (folder_ / "empty").string()}).code, 3);
    EXPECT_EQ(run_words({"info", "--lookup", file("absent.bin")}).code, 3);
    write_bytes(file("mine.bin"), "1234");
    expect_said(run_words({"info", "--lookup", file("mine.bin")}), 3,
                {"does not say what it holds"});
}

// The library of a folder has all that its files have, each paragraph once.
TEST_F(VolumeBake, InfoPrintsTheLibraryOfAFolder) {
    ASSERT_EQ(bake().code, 0);
    const std::string library = run_words({"info", "--lookup", out_}).out;
    EXPECT_EQ(run_words({"info", "--lookup", file("manifest.json")}).out, library);
    const auto times = [&](const std::string& paragraph) {
        int count = 0;
        for (std::size_t at = 0; (at = library.find(paragraph, at)) != library.npos; ++at) ++count;
        return count;
    };
    for (const std::string name : {"wisps.exr", "wisps.vdb"}) {
        std::string text = run_words({"info", "--lookup", file(name)}).out + "\n";
        text.erase(0, text.find("\n\n") + 2);  // the first paragraph names the file
        for (std::size_t end = 0; (end = text.find("\n\n")) != text.npos;) {
            EXPECT_EQ(times(text.substr(0, end)), 1) << text.substr(0, end);
            text.erase(0, end + 2);
        }
    }
}

// The volume has more voxels than are read at once.
TEST_F(VolumeBake, DiffComparesVoxels) {
    write("formats = [\"exr\", \"bin\"]\nmips = 2\nlayout = \"atlas\"\n", "[128, 64, 64]");
    ASSERT_EQ(bake().code, 0);
    const std::string other = (folder_ / "other").string();
    ASSERT_EQ(run_words({"bake", recipe_, "-o", other, "--set", "noise.wisps.seed=8"}).code, 0);
    EXPECT_EQ(run_words({"diff", out_, out_}).code, 0);
    const Result result = run_words({"diff", out_, other});
    EXPECT_EQ(result.code, 1);
    expect_has(result.out, {"wisps.exr: differs", "wisps.bin: differs\n  channel"});
    EXPECT_EQ(run_words({"diff", file("wisps.bin"), other + "/wisps.mip1.bin"}).code, 1);
    // Whatever the format, the values are those of the same texels.
    const json files = json::parse(run_words({"diff", out_, other, "--json"}).out)["files"];
    ASSERT_EQ(files.size(), 4U);
    for (const std::size_t level : {0U, 1U}) {
        for (const std::size_t channel : {0U, 1U, 2U}) {
            const json& raw = files[2 * level]["channels"][channel];
            const json& image = files[2 * level + 1]["channels"][channel];
            for (const char* figure : {"channel", "max_absolute", "max_relative", "differing"}) {
                EXPECT_EQ(raw[figure], image[figure]) << level << figure;
            }
        }
    }
    const double most = std::max(files[0]["channels"][0]["max_absolute"].get<double>(),
                                 files[0]["channels"][1]["max_absolute"].get<double>());
    for (const double share : {0.99, 1.01}) {
        const std::string tolerance = std::to_string(share * most);
        const Names words = {"diff", file("wisps.bin"), other + "/wisps.bin", "--tolerance",
                             tolerance};
        EXPECT_EQ(run_words(words).code, share < 1 ? 1 : 0);
    }
    // Without a manifest nothing says what the bytes are.
    fs::remove(other + "/manifest.json");
    expect_has(run_words({"diff", out_, other}).out, {"wisps.bin: differs\n  the bytes differ"});
}

TEST_F(VolumeBake, OpenVdbIsVerifiedAndShown) {
    write("formats = [\"vdb\"]\n");
    ASSERT_EQ(run_program(words()).code, 0);
    EXPECT_EQ(run_program({"verify", out_}).code, 0);
    const Result info = run_program({"info", file("wisps.vdb")});
    EXPECT_EQ(info.code, 0) << info.error;
    expect_has(info.out, {"24 x 20 x 12", "statistics\n"});
    const Result machine = run_program({"info", file("wisps.vdb"), "--json"});
    EXPECT_EQ(json::parse(machine.out)["grids"].size(), 3U);
    EXPECT_EQ(json::parse(machine.out)["grids"][0]["value_type"], "half");
}

// A file without skybake's entry stands for a recipe that reads it, and is compared by its values.
TEST_F(VolumeBake, AVolumeOfAnotherProgramIsComparedAndPreviewed) {
    write("formats = [\"vdb\"]\n");
    ASSERT_EQ(run_program(words()).code, 0);
    std::string bytes = read_bytes(file("wisps.vdb"));
    bytes.replace(bytes.find("skybake/asset"), 7, "another");
    const std::string foreign = (folder_ / "foreign.vdb").string();
    write_bytes(foreign, bytes);
    EXPECT_EQ(run_program({"diff", foreign, file("wisps.vdb")}).code, 0);
    const std::string shown = (folder_ / "shown").string();
    const std::vector<std::string> preview = {"preview", foreign, "-o", shown, "--size", "64x36"};
    expect_said(run_program(preview), 3, {"grid = \"R\" or grid = \"G\""});
    std::vector<std::string> of_red = preview;
    of_red.insert(of_red.end(), {"--set", "volumes.cloud.grid=R", "--sun-elevation", "30"});
    const Result made = run_program(of_red);
    EXPECT_EQ(made.code, 0) << made.error;
    EXPECT_TRUE(fs::exists(shown + "/index.html"));
    EXPECT_TRUE(contains(made.out, "cloud")) << made.out;
}

// The recipe of a cloud of the voxels that a raw file holds.
std::string cloud_of_file(const std::string& file, const std::string& asset) {
    return "[volumes.v]\nfile = \"" + file +
           "\"\nformat = \"raw\"\nsize = [4, 4, 4]\nvoxel_size = [\"10 m\", \"10 m\", \"10 m\"]\n"
           "[clouds.c]\nvolume = \"v\"\n[bake." +
           asset +
           "]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [4, 4, 4]\nformats = [\"bin\"]\n"
           "pixel_type = \"float\"\n";
}

std::string bytes_of_floats(std::vector<float> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST_F(VolumeBake, AFileWithValuesBelow0IsBakedWithAWarning) {
    std::vector<float> values(64, 0.5F);
    values.back() = -1e-6F;
    write_bytes(folder_ / "v.raw", bytes_of_floats(values));
    write_bytes(recipe_, cloud_of_file("v.raw", "cloud"));
    expect_said(run_words({"check", recipe_}), 0, {"W0226", "no errors"});
    expect_has(run_words({"check", recipe_, "--json"}).out, {"\"checked\"", "W0226"});
    const Result result = bake();
    expect_said(result, 0, {"W0226", "they count as 0"});
    EXPECT_EQ(result.error.find("W0226"), result.error.rfind("W0226")) << result.error;
    values.back() = 0;
    EXPECT_EQ(read_bytes(file("cloud.bin")), bytes_of_floats(values));
}

TEST_F(VolumeBake, NoOutputReplacesWhatItIsMadeFrom) {
    write_bytes(recipe_, cloud_of_file("v.raw", "cloud"));
    write_bytes(folder_ / "v.raw", bytes_of_floats(std::vector<float>(64, 0.5F)));
    ASSERT_EQ(bake().code, 0);
    fs::create_symlink(file("cloud.bin"), folder_ / "link.raw");
    const std::string before = read_bytes(file("cloud.bin"));
    for (const char* input : {"out/cloud.bin", "link.raw"}) {
        write_bytes(recipe_, cloud_of_file(input, "cloud"));
        for (const Names& more : {Names{}, {"--force"}, {"--dry-run"}}) {
            expect_said(bake(more), 3, {"E0302", "the recipe is made from it"});
        }
        EXPECT_EQ(read_bytes(file("cloud.bin")), before);
    }
    write_bytes(recipe_, cloud_of_file("out/cloud.bin", "other"));
    EXPECT_EQ(bake().code, 0);
}

TEST_F(VolumeBake, RefusesToOverwriteAnyOfItsFiles) {
    fs::create_directory(out_);
    write_bytes(file("wisps.mip1.bin"), "mine");
    expect_said(bake(), 3, {"wisps.mip1.bin"});
    EXPECT_EQ(files(), Names{"wisps.mip1.bin"});
    EXPECT_EQ(read_bytes(file("wisps.mip1.bin")), "mine");
    EXPECT_EQ(bake({"--force"}).code, 0);
    EXPECT_EQ(files(), all_);
}

TEST_F(VolumeBake, ValuesThatNoFileHoldsAreRefused) {
    write("formats = [\"bin\"]\npixel_type = \"unorm8\"\n");
    expect_said(bake({"--set", "noise.wisps.channels.B.value=1.5"}), 4,
                {"E0402", "voxel (0, 0, 0), channel B"});
    EXPECT_EQ(files(), Names{});
}

TEST_F(VolumeBake, AnInterruptLeavesNoPartialFile) {
    write("formats = [\"exr\", \"bin\", \"vdb\"]\n", "[512, 512, 512]");
    for (const int work_ms : {0, 400, 1500, 3000}) {
        RunningProgram program(words({"--json", "--certify", "off"}));
        EXPECT_TRUE(contains(program.read_line(), "\"plan\""));
        EXPECT_TRUE(program.works_for(work_ms));
        program.signal(SIGINT);
        EXPECT_FALSE(program.works_for(20000)) << "it works on after an interrupt";
        EXPECT_EQ(program.wait(), 130) << work_ms;
        EXPECT_EQ(files(), Names{}) << work_ms;
    }
}

}  // namespace
}  // namespace skybake::cli
