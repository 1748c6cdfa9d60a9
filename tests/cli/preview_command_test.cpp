// preview: of recipes, folders, sweeps and files.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A table, a noise and nothing that takes long.
constexpr const char* recipe_text = R"(
preset = "earth_hillaire"
[noise.n.channels.Y]
type = "worley"
frequency = 4
[bake.transmittance]
size = [32, 8]
[bake.volume]
asset = "noise_volume"
noise = "n"
size = [16, 16, 16]
formats = ["exr", "bin", "vdb"]
)";

// A small cloud that is lit by Earth's sky.
constexpr const char* cloud_text = R"(
[noise.n]
size = [16, 16, 16]
[noise.n.channels.Y]
type = "worley"
frequency = 2
octaves = 1
[clouds.c]
noise = "n"
extent = ["2 km", "2 km", "1 km"]
base_altitude = "1 km"
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [16, 16, 8]
)";

// The tables that a sky is shown with.
constexpr const char* sky_text =
    "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [64, 16]\n"
    "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\n"
    "size = [16, 16]\n";

struct Scene {
    TemporaryFolder folder;
    std::string recipe = (folder / "recipe.toml").string();
    std::string baked = (folder / "baked").string();
    std::string out = (folder / "preview").string();

    explicit Scene(const std::string& text = recipe_text) { write_bytes(recipe, text); }
    void bake() const { expect_said(run_words({"bake", recipe, "-o", baked}), 0, {}); }
    Result preview(std::vector<std::string> words) const {
        words.insert(words.begin(), "preview");
        words.insert(words.end(), {"-o", out});
        return run_words(words);
    }
    void show(const std::vector<std::string>& words) const { expect_said(preview(words), 0, {}); }
    std::string page() const { return read_bytes(out + "/index.html"); }
};

json data_of(const std::string& html) {
    const std::string begin = "id=\"preview\">";
    const std::size_t from = html.find(begin) + begin.size();
    return json::parse(html.substr(from, html.find("</script>", from) - from), nullptr, false);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(PreviewCommand, TellsMachinesWhereThePageIs) {
    const Scene scene;
    write_bytes(scene.recipe,
                "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [16, 8]\n");
    const Result result = scene.preview({scene.recipe, "--only", "transmittance", "--json", "-q"});
    ASSERT_EQ(result.code, 0) << result.error;
    const json event = json::parse(result.out);
    EXPECT_EQ(event["event"], "previewed");
    EXPECT_EQ(event["page"], scene.out + "/index.html");
    ASSERT_FALSE(event["pictures"].empty());
    for (const std::string path : event["pictures"]) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST(PreviewCommand, PrintsThePathsItWroteAndNothingElse) {
    const Scene scene;
    const Result result = scene.preview({scene.recipe});
    ASSERT_EQ(result.code, 0) << result.error;
    const std::vector<std::string> paths = lines_of(result.out);
    ASSERT_GT(paths.size(), 5u);
    EXPECT_EQ(paths.back(), scene.out + "/index.html");
    for (const std::string& path : paths) EXPECT_TRUE(fs::is_regular_file(path)) << path;
    EXPECT_TRUE(contains(result.error, "open " + paths.back()));
    for (std::size_t i = 0; i + 1 < paths.size(); ++i) {
        EXPECT_TRUE(read_bytes(paths[i]).starts_with("\x89PNG")) << paths[i];
    }
}

TEST(PreviewCommand, ShowsTheSameOfRecipeFolderManifestAndFiles) {
    const Scene scene;
    scene.bake();
    scene.show({scene.recipe});
    const json of_recipe = data_of(scene.page());
    scene.show({scene.baked});
    const json of_folder = data_of(scene.page());
    scene.show({scene.baked + "/manifest.json"});
    EXPECT_EQ(data_of(scene.page()), of_folder);
    scene.show({scene.baked + "/transmittance.exr", scene.baked + "/volume.bin"});
    const json files = data_of(scene.page());
    for (std::size_t asset = 0; asset < 2; ++asset) {
        const json& pictures = of_recipe["assets"][asset]["pictures"];
        EXPECT_GE(pictures.size(), 3u);
        EXPECT_EQ(of_folder["assets"][asset]["pictures"], pictures);
        EXPECT_EQ(files["assets"][asset]["pictures"], pictures);
        EXPECT_EQ(of_folder["assets"][asset]["error"], of_recipe["assets"][asset]["error"]);
    }
    EXPECT_EQ(of_folder["assets"][1]["files"].size(), 3u);
    EXPECT_EQ(files["assets"][1]["files"].size(), 1u);
}

TEST(PreviewCommand, AFileSpeaksForItself) {
    const Scene scene;
    scene.bake();
    scene.show({scene.baked});
    const json claimed = data_of(scene.page());
    const fs::path alone = scene.folder / "alone";
    fs::create_directory(alone);
    const struct {
        const char* name;
        std::size_t asset;
    } files[] = {{"transmittance.exr", 0}, {"volume.exr", 1}, {"volume.vdb", 1}};
    for (const auto& file : files) {
        SCOPED_TRACE(file.name);
        fs::copy_file(fs::path(scene.baked) / file.name, alone / file.name);
        scene.show({(alone / file.name).string()});
        const json asset = data_of(scene.page())["assets"][0];
        const json& wanted = claimed["assets"][file.asset];
        for (const char* key : {"kind", "content", "size", "channels", "mapping", "axes",
                                "statistics", "content_hash", "parameters", "pictures"}) {
            EXPECT_EQ(asset[key], wanted[key]) << key;
        }
    }
    fs::copy_file(fs::path(scene.baked) / "volume.bin", alone / "volume.bin");
    EXPECT_EQ(scene.preview({(alone / "volume.bin").string()}).code, 3);
}

TEST(PreviewCommand, SaysWhatItCannotRead) {
    const Scene scene;
    fs::create_directory(scene.baked);
    EXPECT_EQ(scene.preview({scene.baked}).code, 3);  // no manifest
    EXPECT_EQ(scene.preview({"/absent/a.toml"}).code, 3);
    EXPECT_EQ(scene.preview({"/absent/a.exr"}).code, 3);
    write_bytes(scene.baked + "/manifest.json", "{");
    EXPECT_EQ(scene.preview({scene.baked}).code, 3);
    write_bytes(scene.baked + "/a.exr", "not an image");
    EXPECT_EQ(scene.preview({scene.baked + "/a.exr"}).code, 3);
    write_bytes(scene.recipe, "preset = \"earht\"");
    EXPECT_EQ(scene.preview({scene.recipe}).code, 2);
    EXPECT_FALSE(fs::exists(scene.out));
}

TEST(PreviewCommand, SaysWhichFileIsDamaged) {
    const Scene scene;
    scene.bake();
    const std::string volume = scene.baked + "/volume.exr";
    write_bytes(volume, read_bytes(volume).substr(0, 2000));
    expect_said(scene.preview({scene.baked}), 3, {"volume.exr"});
    fs::remove(scene.baked + "/transmittance.exr");
    EXPECT_EQ(scene.preview({scene.baked}).code, 3);
    EXPECT_FALSE(fs::exists(scene.out));
}

TEST(PreviewCommand, NoManifestWritesOutsideOfTheFolder) {
    const Scene scene;
    scene.bake();
    const std::string path = scene.baked + "/manifest.json";
    json manifest = json::parse(read_bytes(path));
    manifest["assets"][0]["name"] = "../../escaped";
    manifest["assets"][1]["name"] = "</script><b>";
    write_bytes(path, manifest.dump());
    const Result result = scene.preview({scene.baked});
    ASSERT_EQ(result.code, 0) << result.error;
    for (const std::string& line : lines_of(result.out)) {
        EXPECT_EQ(fs::path(line).parent_path(), scene.out);
        EXPECT_EQ(line.find_first_of("<>"), std::string::npos);
    }
    EXPECT_EQ(data_of(scene.page())["assets"][1]["name"], "</script><b>");
}

TEST(PreviewCommand, RefusesWhatCannotGoTogether) {
    const Scene scene;
    scene.bake();
    const std::string cloud = (scene.folder / "cloud.toml").string();
    write_bytes(cloud, cloud_text);
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {scene.recipe, scene.recipe},
        {scene.recipe, scene.baked},
        {scene.baked, "--watch"},
        {scene.baked, "--only", "volume"},
        {scene.baked, "--set", "a=1"},
        {scene.recipe, "--only", "absent"},
        {scene.recipe, "--sun-elevation", "91"},
        {scene.recipe, "--sun-elevation", "10,"},
        {scene.recipe, "--sun-elevation", "1km"},
        {scene.recipe, "--exposure", "bright"},
        {scene.recipe, "--altitude", "200"},
        {scene.recipe, "--altitude=-1m"},
        {scene.recipe, "-j", "0"},
        {scene.recipe, "--draft", "64"},  // without --watch
        {scene.recipe, "--watch", "--draft", "4"},
        {cloud, "--sun-azimuth", "east"},
        {cloud, "--size", "1920"},
        {cloud, "--size", "0x100"},
        {cloud, "--size", "100x-100"},
        {cloud, "--size", "100x100x100"},
        {cloud, "--camera", ""},
        {cloud, "--camera", "0,0,1"},
        {cloud, "--camera", "heading=63 roll=3"},
        {cloud, "--camera", "pitch=91"},
        {cloud, "--camera", "fov=0"},
        {cloud, "--camera", "position=1km,2km"},
        {cloud, "--camera", "position=1,2,3"},
        {cloud, "--camera", "position=1km,2km,-1m"},
        {cloud, "--camera", "position=1km,2km,101km"},  // above the air
        {cloud, "--at", "18:30", "--place", "47.4,8.5"},
        {cloud, "--at", "2026-06-21 18:30"},
        {cloud, "--place", "47.4,8.5"},
        {cloud, "--at", "2026-06-21 18:30", "--place", "47.4"},
        {cloud, "--at", "2026-06-21 18:30", "--place", "147.4,8.5"},
        {cloud, "--at", "2026-06-21 18:30", "--place", "47.4,8.5", "--sun-elevation", "3"},
        {cloud, "--at", "2026-06-21 18:30", "--place", "47.4,8.5", "--sun-azimuth", "3"},
        {cloud, "--turntable", "1"},
        {cloud, "--turntable", "361"},
        {cloud, "--turntable", "4", "--watch"},
        {cloud, "--set", "preview.camera.pitch=91 deg"},
    };
    for (const auto& words : wrong) EXPECT_EQ(scene.preview(words).code, 2) << words.back();
    EXPECT_FALSE(fs::exists(scene.out));
}

TEST(PreviewCommand, SaysHowToShowOneAssetOfAFolder) {
    const Scene scene;
    scene.bake();
    expect_said(scene.preview({scene.baked, "--only", "volume"}), 2,
                {"preview the files of those assets instead"});
    scene.show({scene.baked + "/volume.exr"});
}

// Before anything is baked, and of what is baked already.
TEST(PreviewCommand, RefusesOptionsThatNoPictureUses) {
    const Scene scene;
    scene.bake();
    const std::string cloud = (scene.folder / "cloud.toml").string();
    write_bytes(cloud, cloud_text);
    const std::vector<std::vector<std::string>> wrong = {
        {cloud, "--altitude", "4km"},
        {scene.recipe, "--exposure", "3"},
        {scene.recipe, "--sun-elevation", "3"},
        {scene.baked, "--single"},
        {scene.baked, "--camera", "heading=63"},
        {scene.recipe, "--turntable", "4"},
        {scene.recipe, "--at", "2026-06-21 18:30", "--place", "47.4,8.5"},
        {scene.baked + "/volume.exr", "--size", "64x64"},
    };
    for (const auto& words : wrong) {
        const Result result = scene.preview(words);
        EXPECT_EQ(result.code, 2) << words[1];
        expect_has(result.error, {"no picture of this preview uses " + words[1]});
    }
    EXPECT_FALSE(fs::exists(scene.out));
}

TEST(PreviewCommand, PlacesTheCameraOfACloud) {
    const Scene scene(cloud_text);
    const Result result =
        scene.preview({scene.recipe, "--camera", " position=0.1km,200m,50m  heading=1rad fov=40",
                       "--size", "40x30", "--sun-azimuth=-20 deg", "--sun-elevation=-3", "--single",
                       "--set", "preview.altitude=2 km"});
    ASSERT_EQ(result.code, 0) << result.error;
    // A key may be for the pictures of another recipe that this one includes, unlike an option.
    expect_has(result.error, {"no picture of this recipe uses `preview.altitude`"});
    const json picture = data_of(scene.page())["assets"][0]["pictures"][0];
    EXPECT_EQ(picture["file"], "c_lit_sun_minus_3.png");
    EXPECT_EQ(picture["width"], 40);
    EXPECT_EQ(picture["height"], 30);
    const std::string caption = picture["caption"];
    expect_has(caption, {"`position=0.1km,0.2km,0.05km heading=57.3deg pitch=", "fov=40deg",
                         "77.3 degrees to the right", "shows one tile alone"});
    // The camera that a caption tells is one that the option takes.
    const std::size_t from = caption.find('`') + 1;
    const std::string camera = caption.substr(from, caption.find('`', from) - from);
    scene.show({scene.recipe, "--camera", camera, "--size", "40x30", "--sun-azimuth=-20",
                "--sun-elevation=-3", "--single"});
    expect_has(data_of(scene.page())["assets"][0]["pictures"][0]["caption"].get<std::string>(),
               {camera});
}

constexpr const char* preview_text = R"(
[preview]
size = [40, 30]
single = true
sun_elevation = "-3 deg"
sun_azimuth = "-20 deg"
[preview.camera]
position = ["0.1 km", "200 m", "50 m"]
heading = "1 rad"
fov = "40 deg"
)";

json first_picture(const Scene& scene) { return data_of(scene.page())["assets"][0]["pictures"][0]; }

TEST(PreviewCommand, TakesWhatTheRecipeSaysOnPictures) {
    const Scene scene(cloud_text);
    scene.show({scene.recipe, "--camera", "position=0.1km,200m,50m heading=1rad fov=40", "--size",
                "40x30", "--sun-azimuth=-20", "--sun-elevation=-3", "--single"});
    const json by_options = first_picture(scene);
    const std::string png = read_bytes(scene.out + "/c_lit_sun_minus_3.png");
    fs::remove_all(scene.out);
    // A folder has what its recipe said.
    write_bytes(scene.recipe, std::string(cloud_text) + preview_text);
    scene.bake();
    scene.show({scene.baked});
    EXPECT_EQ(first_picture(scene), by_options);
    EXPECT_EQ(read_bytes(scene.out + "/c_lit_sun_minus_3.png"), png);

    // The command line wins, key by key.
    scene.show({scene.recipe, "--camera", "heading=10", "--sun-elevation", "30"});
    const json picture = first_picture(scene);
    EXPECT_EQ(picture["file"], "c_lit_sun_30.png");
    EXPECT_EQ(picture["width"], 40);
    expect_has(picture["caption"], {"`position=0.1km,0.2km,0.05km heading=10deg"});
}

TEST(PreviewCommand, SaysNothingThatChangesABake) {
    const Scene scene(cloud_text);
    scene.bake();
    const json before = json::parse(read_bytes(scene.baked + "/manifest.json"));
    const std::string bytes = read_bytes(scene.baked + "/c.vdb");
    write_bytes(scene.recipe, std::string(cloud_text) + preview_text);
    const Result plan = run_words({"bake", scene.recipe, "-o", scene.baked, "--dry-run"});
    EXPECT_EQ(plan.code, 0) << plan.error;
    EXPECT_FALSE(contains(plan.error + plan.out, "clouds.c")) << plan.error << plan.out;
    scene.bake();
    const json after = json::parse(read_bytes(scene.baked + "/manifest.json"));
    EXPECT_EQ(after["assets"], before["assets"]);  // with its key and its time
    EXPECT_EQ(read_bytes(scene.baked + "/c.vdb"), bytes);
    EXPECT_EQ(after["parameters"]["preview"]["size"], json({40, 30}));
}

TEST(PreviewCommand, PlacesTheSunAtATime) {
    const Scene scene(cloud_text);
    const std::string preview =
        "[preview]\nsize = [40, 30]\nlatitude = '47.4 deg'\nlongitude = '8.5 deg'\n";
    scene.show({scene.recipe, "--at", "2026-06-21 18:30 +02:00", "--place", "47.4,8.5", "--size",
                "40x30"});
    const json by_options = first_picture(scene);
    EXPECT_EQ(by_options["file"], "c_lit_sun_26_61.png");
    EXPECT_TRUE(contains(data_of(scene.page())["notes"].dump(), "2026-06-21 16:30 UTC"));
    write_bytes(scene.recipe, cloud_text + preview);
    scene.show({scene.recipe, "--at", "2026-06-21 16:30Z"});
    EXPECT_EQ(first_picture(scene), by_options);
}

TEST(PreviewCommand, TurnsACloud) {
    const Scene scene(cloud_text);
    scene.show({scene.recipe, "--turntable", "6", "--size", "40x30"});
    const std::string html = scene.page();
    const json pictures = data_of(html)["assets"][0]["pictures"];
    std::set<std::string> different;
    for (int i = 0; i < 6; ++i) {
        const std::string name = "c_turntable_sun_20_00" + std::to_string(i);
        const json& picture = pictures[static_cast<std::size_t>(i)];
        EXPECT_EQ(picture["name"], name);
        EXPECT_EQ(picture["sequence"], "c_turntable_sun_20");
        different.insert(read_bytes(scene.out + "/" + name + ".png"));
        EXPECT_TRUE(contains(html, "src=\"" + name + ".png\""));
        const auto exposure = [](const std::string& caption) {
            return caption.substr(caption.find("exposure"), 20);
        };
        EXPECT_EQ(exposure(picture["caption"]), exposure(pictures[0]["caption"]));
    }
    EXPECT_EQ(different.size(), 6U);
    EXPECT_EQ(pictures[6]["sequence"], "");
    expect_has(pictures[0]["caption"], {"Picture 1 of 6. The picture shows one tile alone"});
}

TEST(PreviewCommand, LeavesAlonePagesOfOthers) {
    const Scene scene;
    fs::create_directory(scene.out);
    write_bytes(scene.out + "/index.html", "<h1>My holidays</h1>");
    EXPECT_EQ(scene.preview({scene.recipe, "--only", "volume"}).code, 3);
    EXPECT_EQ(scene.page(), "<h1>My holidays</h1>");
    scene.show({scene.recipe, "--only", "volume", "--force"});
    scene.show({scene.recipe, "--only", "volume"});
    EXPECT_EQ(data_of(scene.page())["assets"].size(), 1u);
    // A picture of a name that this page has not made.
    write_bytes(scene.out + "/transmittance_red.png", "mine");
    EXPECT_EQ(scene.preview({scene.recipe}).code, 3);
    EXPECT_EQ(read_bytes(scene.out + "/transmittance_red.png"), "mine");
}

TEST(PreviewCommand, ShowsTheSkyForTheSunsThatAreAskedFor) {
    const Scene scene(sky_text);
    scene.bake();
    scene.show(
        {scene.baked, "--sun-elevation", "30 deg,5", "--altitude", "2km", "--exposure", "4"});
    const json scenes = data_of(scene.page())["scenes"];
    ASSERT_EQ(scenes.size(), 1u);
    const std::string told = scenes.dump();
    expect_has(told, {"sun 30 degrees above", "exposure 16 (+4.0 stops)"});
    EXPECT_FALSE(contains(told, "sun 60 deg"));

    expect_said(scene.preview({scene.baked, "--altitude", "170 km"}), 2,
                {"top of the atmosphere, 100 km"});
}

TEST(PreviewCommand, SaysThatAFileIsNotThatOfTheManifest) {
    const Scene scene;
    scene.bake();
    EXPECT_FALSE(contains(scene.preview({scene.baked}).error, "other bytes"));
    const std::string volume = scene.baked + "/volume.bin";
    std::string bytes = read_bytes(volume);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_bytes(volume, bytes);
    expect_said(scene.preview({volume}), 0, {"W0304"});
    EXPECT_TRUE(contains(data_of(scene.page())["notes"].dump(), "does not match manifest.json"));
}

// Shows the sky of the bake, whatever lies in its folder.
TEST(PreviewCommand, NeedsNoIncludeOnceItIsBaked) {
    const Scene scene;
    write_bytes((scene.folder / "air.toml").string(), "preset = \"earth_hillaire\"\n");
    write_bytes(scene.recipe,
                "include = [\"air.toml\"]\n[bake.transmittance]\nsize = [64, 16]\n"
                "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\n"
                "size = [16, 16]\n");
    scene.bake();
    scene.show({scene.baked, "--sun-elevation", "30"});
    const json before = data_of(scene.page());
    const std::string moved = (scene.folder / "moved").string();
    fs::rename(scene.baked, moved);
    write_bytes(moved + "/air.toml", "preset = \"mars\"\n");
    scene.show({moved, "--sun-elevation", "30"});
    EXPECT_EQ(data_of(scene.page())["scenes"], before["scenes"]);
    EXPECT_EQ(before["scenes"].size(), 1u);
    EXPECT_TRUE(data_of(scene.page())["notes"].empty());
}

// The first variant's exposure is that of all.
TEST(PreviewCommand, ASweepOfSkiesHasOneExposure) {
    const Scene scene(sky_text);
    const std::string sweep = (scene.folder / "sweep").string();
    expect_said(
        run_words({"sweep", scene.recipe, "--vary", "atmosphere.ground_albedo=0,0.9", "-o", sweep}),
        0, {});
    scene.show({sweep, "--sun-elevation", "25"});
    const std::string caption = data_of(scene.page())["tables"][0]["pictures"][0]["caption"];
    expect_has(caption, {"They all have exposure ", "the sun 25 degrees above the horizon"});
}

TEST(PreviewCommand, ASweepGetsAContactSheetAndATable) {
    const Scene scene;
    const std::string sweep = (scene.folder / "sweep").string();
    expect_said(run_words({"sweep", scene.recipe, "--vary", "noise.n.seed=2,10", "--vary",
                           "atmosphere.layers.mie.scale_height=1.2 km,800 m", "-o", sweep}),
                0, {});
    scene.show({sweep});
    EXPECT_TRUE(fs::exists(scene.out + "/contact_sheet.png"));
    const json table = data_of(scene.page())["tables"][0];
    ASSERT_EQ(table["rows"].size(), 4u);
    EXPECT_EQ(table["columns"][0]["title"], "seed");
    EXPECT_EQ(table["rows"][2]["cells"][0]["value"], 10);
    EXPECT_EQ(table["rows"][1]["cells"][1]["value"], 800);
    EXPECT_EQ(table["rows"][1]["cells"][1]["text"], "800 m");
    for (const json& row : table["rows"]) {
        EXPECT_TRUE(row["picture"].is_object());
        EXPECT_TRUE(fs::is_directory(scene.out + "/" + std::string(row["folder"])))
            << row["folder"];
    }
    // Two seeds differ and two scale heights do not, since the picture is that of the noise.
    ASSERT_GT(table["pictures"].size(), 2u);
    EXPECT_EQ(table["pictures"][1]["tab"], "Difference from the first");
    EXPECT_TRUE(contains(table["pictures"][2]["name"], "_variants")) << "a plot";
    const std::size_t last = table["columns"].size() - 2;
    EXPECT_EQ(table["rows"][1]["cells"][last]["value"], 0);
    EXPECT_GT(table["rows"][2]["cells"][last]["value"], 0);

    // A folder that is gone costs its picture, a damaged index everything.
    fs::remove_all(sweep + "/" + "0003_seed=10_scale_height=800m");
    scene.show({sweep});
    EXPECT_EQ(data_of(scene.page())["notes"].size(), 1u);
    json index = json::parse(read_bytes(sweep + "/sweep.json"));
    index["variants"][0]["name"] = "../elsewhere";
    write_bytes(sweep + "/sweep.json", index.dump());
    EXPECT_EQ(scene.preview({sweep}).code, 3);
}

TEST(PreviewCommand, AReportThatLiesThereIsShown) {
    const Scene scene;
    scene.bake();
    expect_said(run_words({"report", scene.recipe, "--quick", "--only", "transmittance", "-q", "-o",
                           scene.baked + "/report"}),
                0, {});
    scene.show({scene.baked});
    const json pictures = data_of(scene.page())["assets"][0]["pictures"];
    EXPECT_EQ(pictures.back()["file"], "transmittance_report.svg");
    EXPECT_GT(pictures.back()["width"], 100);
    write_bytes(scene.baked + "/report/transmittance.svg", "<svg onload='alert(1)'/>");
    scene.show({scene.baked});
    EXPECT_EQ(data_of(scene.page())["assets"][0]["pictures"].size() + 1, pictures.size());
}

}  // namespace
}  // namespace skybake::cli
