// The light of pictures of clouds: the solved sky behind them, made once for all that show it.
#include "bakers/preview/picture_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/light/sky_light.h"
#include "bakers/preview/make_preview.h"
#include "bakers/render/cloud_camera.h"
#include "tests/io/files.h"
#include "tests/preview/cloud_views.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

const BakeOptions one_thread = {1, Certification::off, nullptr};

// The largest relative difference, over the pixels of a picture and their channels, of the sky behind an
// empty cloud from the solved sky along each pixel's own ray.
double largest_error(const test::Sky& sky, const SolvedSky* solved, const CloudCamera& camera,
                     const SunDirection& sun) {
    const std::vector<float> nothing(8 * 8 * 4);
    const CloudMedium medium =
        test::medium_of(test::cloud_of({4000, 4000, 500}, 1000), {8, 8, 4}, nothing);
    MarchSettings settings;
    settings.width = 24;
    settings.height = 14;
    settings.camera = camera;
    settings.sun = sun;
    settings.step_m = settings.light_step_m = 100;
    settings.reach_m = 10000;
    const Image2<float> seen = render_cloud(medium, {sky.medium, sky.tables, solved}, settings, 1);

    const SkyLight truth(sky.recipe.parameters.atmosphere, config::SkyOrders::all, {}, one_thread);
    const SunZenith zenith = sun_at_elevation(sun.elevation_degrees / kDegreesPerRadian);
    const CameraRays rays(camera, settings.width, settings.height);
    double largest = 0;
    testing::for_each_texel(settings.width, settings.height, [&](int x, int y) {
        const glm::dvec3 ray = rays.through(x, y);
        const double level = std::hypot(ray.x, ray.y);
        const double azimuth = std::atan2(ray.y, ray.x) - sun.azimuth_degrees / kDegreesPerRadian;
        const Spectrum expected = truth.wanted(
            truth.integrator().radiance(camera.position_m.z / 1000, zenith,
                                        sky_direction(zenith, ray.z, level, std::cos(azimuth))));
        for (int c = 0; c < seen.channels; ++c) {
            const double wanted = expected[static_cast<std::size_t>(c)];
            largest = std::max(largest, std::fabs(double{seen.texel(x, y)[c]} / wanted - 1));
        }
    });
    return largest;
}

// Within a hundredth, also next to the sun and just above the horizon, and where the tables are far off.
TEST(PictureLight, CloudsStandBeforeTheSolvedSky) {
    const test::Sky sky = test::sky_of("earth_hillaire");
    PictureLight light;
    struct View {
        double sun_elevation;
        double sun_azimuth;
        double pitch;
        double altitude_m;
    };
    for (const View& view : {View{-4, 63, 18, 100}, View{-4, 200, 40, 100}, View{5, 70, 18, 2000},
                             View{30, 63, 35, 100}}) {
        CloudCamera camera;
        camera.position_m = {0, 0, view.altitude_m};
        camera.azimuth_degrees = 63;
        camera.elevation_degrees = view.pitch;
        camera.horizontal_field_degrees = 60;
        const SunDirection sun = {view.sun_elevation, view.sun_azimuth};
        const auto solved =
            light.sky(&sky.recipe, {view.altitude_m / 1000, view.sun_elevation}, one_thread);
        ASSERT_TRUE(solved);
        const double error = largest_error(sky, &*solved, camera, sun);
        EXPECT_LT(error, 0.01) << view.sun_elevation << " " << view.sun_azimuth;
        if (view.sun_elevation < 0) {
            EXPECT_GT(largest_error(sky, nullptr, camera, sun), 0.05)
                << "the tables alone would pass this test";
        }
    }
}

// Presets state four wavelengths and a space of colours, in which sky views are stored. Pictures mix spectra.
TEST(PictureLight, SkiesHaveTheChannelsOfTheirTables) {
    for (const char* preset : {"earth", "mars", "earth_hillaire"}) {
        const config::Recipe recipe = test::recipe_of(fmt::format("preset = \"{}\"\n", preset));
        PictureLight light;
        const auto tables = light.tables(&recipe, one_thread);
        const auto sky = light.sky(&recipe, {0.1, 30}, one_thread);
        ASSERT_TRUE(tables.value && sky) << preset;
        EXPECT_EQ(sky->channels(), static_cast<int>(recipe.parameters.wavelengths.size()))
            << preset;
        const PreviewAsset& transmittance = *tables.value->of_kind("transmittance");
        EXPECT_EQ(transmittance.entry.channels.size(), recipe.parameters.wavelengths.size())
            << preset;
    }
}

// A sky of another camera or sun is not taken for this one's.
TEST(PictureLight, ASkyOfAnotherPlaceIsNotShown) {
    const test::Sky sky = test::sky_of("earth_hillaire");
    PictureLight light;
    const auto solved = light.sky(&sky.recipe, {0.1, 5}, one_thread);
    ASSERT_TRUE(solved);
    CloudCamera camera;
    camera.position_m = {0, 0, 100};
    camera.elevation_degrees = 30;
    const auto differs = [&](double altitude_m, double sun_degrees) {
        camera.position_m.z = altitude_m;
        return largest_error(sky, &*solved, camera, {sun_degrees, 90}) !=
               largest_error(sky, nullptr, camera, {sun_degrees, 90});
    };
    EXPECT_TRUE(differs(100, 5));
    EXPECT_FALSE(differs(400, 5));
    EXPECT_FALSE(differs(100, -4));
}

config::Recipe evening(const std::string& coverage, const std::string& ground_albedo = "0.3") {
    return test::recipe_of(
        "preset = \"earth_hillaire\"\n[atmosphere]\nground_albedo = " + ground_albedo +
        "\n[bake.transmittance]\n[bake.multiple_scattering]\nmethod = \"solved\"\n"
        "[noise.n]\nsize = [16, 16, 16]\n[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 3\n"
        "octaves = 1\n[clouds.c]\nnoise = \"n\"\nextent = [\"3 km\", \"3 km\", \"0.7 km\"]\n"
        "base_altitude = \"1 km\"\ncoverage = " +
        coverage +
        "\nextinction_scale = \"40 /km\"\n[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [16, 16, 8]\n[preview]\nsize = [32, 18]\n");
}

// Keeps what `preview --watch` keeps from one save to the next.
class Saves {
  public:
    // Makes a page, and returns how many intermediates were made for it, such as solved light.
    int made_for(const config::Recipe& recipe, const std::string& sun = "") {
        const int before = shared_.made();
        expected_ = shared_.expect(needs_of_pictures(recipe));
        const BakeOptions options{
            .threads = 1, .certification = Certification::off, .intermediates = &shared_};
        const auto assets =
            bake_assets(recipe, recipe.parameters.bakes, "evening", options, &assets_);
        EXPECT_TRUE(assets.value);
        PreviewOptions pictures;
        pictures.draft = true;
        pictures.threads = 1;
        pictures.intermediates = &shared_;
        pictures.light = light_;
        if (!sun.empty()) pictures.sun_elevations_deg = {std::stod(sun)};
        if (!assets.value) return -1;
        const auto page = make_preview(*assets.value, pictures);
        EXPECT_TRUE(page.value);
        for (const auto& problem : page.diagnostics) ADD_FAILURE() << problem.message;
        return shared_.made() - before;
    }

  private:
    Intermediates shared_{std::int64_t{1} << 30};
    Intermediates::Expected expected_;
    AssetMemo assets_;
    std::shared_ptr<PictureLight> light_ = std::make_shared<PictureLight>(&shared_);
};

// The recipe without its sky.
config::Recipe alone(config::Recipe recipe) {
    std::erase_if(recipe.parameters.bakes,
                  [](const config::Bake& bake) { return bake.name != "c"; });
    return recipe;
}

// Returns the number of intermediates that the cloud itself is made from.
int made_for_cloud(const config::Recipe& recipe) {
    Intermediates shared(std::int64_t{1} << 30);
    const BakeOptions options{
        .threads = 1, .certification = Certification::off, .intermediates = &shared};
    const config::Recipe cloud = alone(recipe);
    EXPECT_TRUE(bake_assets(cloud, cloud.parameters.bakes, "cloud", options).value);
    return shared.made();
}

TEST(PictureLight, ASaveThatChangesACloudSolvesNoLightAgain) {
    Saves saves;
    const int cloud = made_for_cloud(evening("0.6"));
    EXPECT_GE(saves.made_for(evening("0.6")), cloud + 2) << "sunlight and its scattered light";
    EXPECT_EQ(saves.made_for(evening("0.5")), cloud);
    EXPECT_EQ(saves.made_for(evening("0.5"), "-3"), 0) << "another sun shines in the same light";
    EXPECT_GT(saves.made_for(evening("0.5", "0.4")), 0) << "the air has changed";
    EXPECT_EQ(saves.made_for(evening("0.7", "0.4")), cloud);
}

// Clouds without an air of their own: the light is that of the preset.
TEST(PictureLight, TheLightOfThePresetIsMadeOnceForAllSaves) {
    const int cloud = made_for_cloud(evening("0.6"));
    Saves saves;
    EXPECT_GT(saves.made_for(alone(evening("0.6"))), cloud);
    EXPECT_EQ(saves.made_for(alone(evening("0.5"))), cloud);
}

// --- The cache -----------------------------------------------------------------------------------

class KeptLight : public ::testing::Test {
  protected:
    // The transmittance and radiances of a sky, in a process of its own that has the cache; and how
    // many intermediates it made.
    struct Round {
        std::vector<float> values;
        int made = 0;
    };
    Round round() const {
        Intermediates shared(std::int64_t{1} << 30);
        AssetCache cache(folder_ / "cache");
        AssetMemo files;
        files.sources = {&cache};
        files.cache = &cache;
        PictureLight light(&shared, files);
        const config::Recipe air = test::recipe_of("preset = \"earth_hillaire\"\n");
        const auto tables = light.tables(&air, one_thread);
        const auto sky = light.sky(&air, {0.1, -4}, one_thread);
        EXPECT_TRUE(tables.value && sky);
        Round result;
        if (!tables.value || !sky) return result;
        for (const PreviewAsset& asset : tables.value->assets) {
            result.values.insert(result.values.end(), asset.table.texels.begin(),
                                 asset.table.texels.end());
        }
        for (int elevation = -80; elevation <= 80; elevation += 20) {
            Spectrum radiance{};
            sky->look_up(elevation, 30, data(radiance));
            result.values.push_back(static_cast<float>(radiance[0]));
        }
        result.made = shared.made();
        return result;
    }
    std::vector<fs::path> entries() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache/assets")) {
            if (entry.path().filename().string().size() == 32) found.push_back(entry.path());
        }
        return found;
    }

    TemporaryFolder folder_;
};

TEST_F(KeptLight, IsNotSolvedAgainByTheNextProcess) {
    const Round first = round();
    EXPECT_GT(first.made, 0);
    EXPECT_EQ(entries().size(), 3U);
    const Round second = round();
    EXPECT_EQ(second.made, 0);
    EXPECT_EQ(second.values, first.values);
}

TEST_F(KeptLight, OfADamagedEntryIsMadeAgain) {
    const Round first = round();
    for (const fs::path& entry : entries()) {
        for (const auto& file : fs::directory_iterator(entry)) {
            std::string bytes = read_bytes(file.path());
            bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
            write_bytes(file.path(), bytes);
            const Round again = round();
            EXPECT_EQ(again.values, first.values) << file.path();
            EXPECT_EQ(round().made, 0) << "the entry is whole again";
            break;
        }
    }
    for (const fs::path& entry : entries()) fs::remove(entry / "manifest.json");
    EXPECT_GT(round().made, 0);
}

// An entry under a key that is not its own is none.
TEST_F(KeptLight, OfAForeignEntryIsNotTaken) {
    const Round first = round();
    const std::vector<fs::path> found = entries();
    ASSERT_EQ(found.size(), 3U);
    for (std::size_t i = 0; i < found.size(); ++i)
        fs::rename(found[i], folder_ / std::to_string(i));
    for (std::size_t i = 0; i < found.size(); ++i) {
        fs::rename(folder_ / std::to_string(i), found[(i + 1) % found.size()]);
    }
    const Round again = round();
    EXPECT_GT(again.made, 0);
    EXPECT_EQ(again.values, first.values);
}

}  // namespace
}  // namespace skybake
