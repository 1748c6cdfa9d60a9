#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/air/particles/phase_function.h"

#include <gtest/gtest.h>

#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/solver/solve_light.h"
#include "config/assets/bruneton.h"
#include "tests/io/files.h"
#include "tests/io/open_formats.h"
#include "tests/light/sky_media.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::voxels_of;

config::BrunetonBake bake_of(const std::string& preset, const std::string& keys) {
    const config::Recipe recipe =
        test::recipe_of("preset = \"" + preset + "\"\n[bake.a]\nasset = \"bruneton\"\n" + keys);
    return recipe.parameters.bakes.back().as<config::BrunetonBake>();
}

Baked baked(const std::string& preset, const std::string& keys, int threads = 2) {
    BakeOptions options{.threads = threads, .certification = Certification::off};
    Baked volume;
    volume.name = "a";
    return test::without_diagnostics(bake_bruneton(
        {{test::preset_atmosphere(preset)}}, bake_of(preset, keys), options, std::move(volume)));
}

constexpr const char* kSmall = "size = [16, 8, 4]\nnu_size = 4\npixel_type = \"float\"\n";

TEST(BrunetonVolume, HasTheSameBytesForAnyNumberOfThreads) {
    const auto keys = std::string(kSmall) + "table = \"scattering\"\ncombined = true\n";
    const Baked one = baked("earth_hillaire", keys, 1);
    const Baked two = baked("earth_hillaire", keys, 2);
    ASSERT_EQ(one.levels.size(), 1U);
    EXPECT_EQ(one.levels[0].content_hash, two.levels[0].content_hash);
    EXPECT_EQ(one.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST(BrunetonVolume, ScatteringIsTheFirstOrderAndTheRest) {
    // But for what texels of each table are moved by for lookups between them.
    const Baked all = baked("earth_hillaire", kSmall);
    const Baked first = baked("earth_hillaire", std::string(kSmall) + "orders = 1\n");
    const Baked rest = baked("earth_hillaire", std::string(kSmall) + "table = \"higher_orders\"\n");
    const auto a = voxels_of(all, 1);
    const auto b = voxels_of(first, 1);
    const auto c = voxels_of(rest, 1);
    double sum = 0;
    double parts = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += double{a[i]};
        parts += double{b[i]} + double{c[i]};
    }
    EXPECT_GT(sum, 0);
    EXPECT_NEAR(parts / sum, 1, 0.05);
}

TEST(BrunetonVolume, AlphaIsTheRedOfSingleMie) {
    const Baked combined =
        baked("earth_hillaire", std::string(kSmall) + "orders = 1\ncombined = true\n");
    const Baked mie = baked("earth_hillaire", std::string(kSmall) + "table = \"single_mie\"\n");
    EXPECT_EQ(voxels_of(combined, 3), voxels_of(mie, 0));
    EXPECT_EQ(mie.channel_names.size(), 3U);
}

TEST(BrunetonVolume, SolarIrradianceMultipliesLight) {
    const auto keys = std::string(kSmall) + "orders = 1\n";
    const auto one = voxels_of(baked("earth_hillaire", keys), 2);
    const auto four =
        voxels_of(baked("earth_hillaire", keys + "solar_irradiance = [1, 1, 4]\n"), 2);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(4 * one[i], four[i]);
}

TEST(BrunetonVolume, TakramsTablesHaveFourChannelsAndParameters) {
    const Baked scattering =
        baked("takram", "size = [16, 8, 4]\nnu_size = 4\norders = 1\nconvention = \"takram\"\n");
    EXPECT_TRUE(scattering.flip);
    ASSERT_TRUE(scattering.companion.has_value());
    EXPECT_EQ(scattering.companion->format, "json");
    const std::string& text = scattering.companion->text;
    EXPECT_NE(text.find("\"solarIrradiance\": [1.474, 1.8504, 1.91198]"), std::string::npos);
    EXPECT_NE(text.find("\"bottomRadius\": 6360000"), std::string::npos);
    EXPECT_NE(text.find("\"rayleighScattering\": [0.005802, 0.013558, 0.0331]"), std::string::npos);
    EXPECT_NE(text.find("\"muSMin\": -0.5"), std::string::npos);
    const Baked transmittance =
        baked("takram", "size = [8, 4, 1]\ntable = \"transmittance\"\nconvention = \"takram\"\n");
    EXPECT_FALSE(transmittance.companion.has_value());
    EXPECT_EQ(transmittance.channel_names.size(), 4U);
    for (const float alpha : voxels_of(transmittance, 3)) EXPECT_EQ(alpha, 1);
}

TEST(BrunetonVolume, TakramsImageIsUpsideDownAndReadAsItWas) {
    const Baked volume =
        baked("takram",
              "size = [16, 8, 4]\nnu_size = 4\norders = 1\nconvention = \"takram\"\n"
              "pixel_type = \"float\"\n");
    const testing::TemporaryFolder folder;
    for (const auto& [kind, columns] :
         {std::pair{config::SheetLayout::stack, 0}, {config::SheetLayout::atlas, 3}}) {
        Baked laid_out = volume;
        laid_out.layout = kind;
        laid_out.columns = columns;
        testing::write_bytes(folder / "a.exr", "");
        ASSERT_EQ(testing::write_as(config::FileFormat::exr, laid_out, 2, nullptr, folder / "a.exr")
                      .value,
                  true);
        EXPECT_TRUE(laid_out.flip);
        auto image = ExrRows::open(folder / "a.exr");
        ASSERT_TRUE(image.value.has_value());
        std::vector<float> red;
        const auto visit = [&](std::int64_t, std::int64_t count, const float* values) {
            for (std::int64_t i = 0; i < count; ++i) red.push_back(values[4 * i]);
            return true;
        };
        EXPECT_EQ(testing::read_file_of(exr_format(), folder / "a.exr", testing::shape_of(laid_out),
                                        0, visit)
                      .value,
                  true);
        EXPECT_EQ(red, voxels_of(volume, 0));
        // The file's first row is the last one of the last slice in the lowest row of cells.
        std::vector<float> row(static_cast<std::size_t>(image.value->facts().width) * 4);
        ASSERT_FALSE(image.value->read(0, 1, row.data()));
        EXPECT_EQ(row[0], voxels_of(volume, 0)[(3 * 8 + 7) * 16]);
    }
}

TEST(BrunetonVolume, IrradianceFallsFromNoonToNight) {
    const Baked irradiance =
        baked("earth_hillaire",
              "size = [16, 2, 1]\ntable = \"irradiance\"\npixel_type = \"float\"\norders = 2\n");
    const auto green = voxels_of(irradiance, 1);
    EXPECT_GT(green[15], 0.02);
    EXPECT_LT(green[15], 0.3);
    EXPECT_LT(green[0], 1e-8);
    for (int i = 1; i < 16; ++i) {
        EXPECT_GE(green[static_cast<std::size_t>(i)] * 1.05f,
                  green[static_cast<std::size_t>(i - 1)]);
    }
    // Nothing is above the top.
    EXPECT_NEAR(green[31], 0, 1e-6);
}

// The sky as a runtime makes it of two tables, against path tracing down to 96 degrees.
TEST(BrunetonVolume, SkyIsTheTracedOne) {
    const SkyMedium medium = test::preset_sky("earth_hillaire", {"atmosphere.ground_albedo=0"});
    SolverSettings settings;
    settings.degree = sky_degree(medium);
    const SolvedLight light = solve_light(medium, settings, 2);
    const config::BrunetonBake bake = bake_of("earth_hillaire", "combined = false\n");
    const config::BrunetonBake mie_bake = bake_of("earth_hillaire", "table = \"single_mie\"\n");
    const ScatteringMapping mapping(shell_of(medium.air), bake.size, bake.nu_size,
                                    bake.sun_cos_zenith_min);
    const BakeOptions options{.threads = 2};
    const ScatteringContent content(medium, bake);
    const ScatteringContent mie_content(medium, mie_bake);
    const TableParts parts =
        make_parts(medium, &light, make_sunlight(medium.air, 2), content, mapping, options);
    VoxelArray air = scattering_texels(content, mapping, parts);
    VoxelArray mie = scattering_texels(mie_content, mapping, parts);
    fit_lookups(mapping, 3, options, air);
    fit_lookups(mapping, 3, options, mie);
    std::vector<double> errors;
    for (const SkyTruth& value : test::sky_truth_of(SKYBAKE_TEST_DATA "/truth_sky_earth.csv")) {
        if (!(value.radiance > 0)) continue;
        const SkyTruthDirection& at = value.direction;
        const test::View seen = test::view_at(at.altitude_km, at.sun_zenith_degrees,
                                              at.view_zenith_degrees, at.azimuth_degrees);
        const double nu = seen.direction.cosine_to_sun;
        ScatteringView view;
        view.altitude_km = at.altitude_km;
        view.s_km = (6360 + at.altitude_km) * seen.direction.mu;
        view.length_km = distance_to_top_km(mapping.shell(), at.altitude_km, view.s_km);
        const ScatteringCoordinates x = mapping.coordinates(view, seen.sun.cosine, nu);
        const auto c = static_cast<std::size_t>(value.channel);
        const auto half = config::PixelType::half;
        const double found = look_up(air, mapping, x, half)[c] * rayleigh_phase(nu) +
                             look_up(mie, mapping, x, half)[c] * content.mie_phase(nu)[c];
        errors.push_back(std::fabs(found / value.radiance - 1));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors[errors.size() / 2], 0.012);
    EXPECT_LE(errors[errors.size() * 9 / 10], 0.05);
    EXPECT_LE(errors.back(), 0.15);
}

}  // namespace
}  // namespace skybake
