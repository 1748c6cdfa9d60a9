#include "bakers/render/sky_view.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/sky_reference.h"
#include "bakers/render/sky_rays.h"
#include "tests/preview/skies.h"
#include "tests/support/every_target.h"
#include "tests/support/number_rows.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

using test::earth;

// Every path of the kernel: exponential and piecewise layers, forward and backward phases, both
// mappings of both tables, both contents, one channel.
test::Sky peculiar_sky() {
    return test::sky_of(
        "mars_rgb",
        {"wavelengths=[\"550 nm\"]", "atmosphere.ground_albedo=1",
         "atmosphere.layers.rayleigh.scattering=\"2.5e-7 /m\"",
         "atmosphere.layers.dust.scattering=\"4e-5 /m\"",
         "atmosphere.layers.dust.single_scattering_albedo=0.9",
         "atmosphere.layers.dust.phase=\"henyey_greenstein\"", "atmosphere.layers.dust.g=-0.7",
         "atmosphere.layers.cloud.profile=\"slab\"",
         "atmosphere.layers.cloud.bottom_altitude=\"20 km\"",
         "atmosphere.layers.cloud.top_altitude=\"21 km\"",
         "atmosphere.layers.cloud.scattering=\"1e-4 /m\"",
         "atmosphere.layers.cloud.phase=\"isotropic\"", "bake.transmittance.mapping=\"ue\"",
         "bake.transmittance.content=\"optical_depth\"",
         "bake.multiple_scattering.mapping=\"twilight\"",
         "bake.multiple_scattering.max_texel_error=0.02"});
}

// All orders solved, as "hillaire" or "moments".
test::Sky solved_sky(const char* preset, const char* content, const char* setting = "format=1") {
    return test::sky_of(preset,
                        {"bake.multiple_scattering.method=\"solved\"",
                         "bake.multiple_scattering.mapping=\"twilight\"",
                         fmt::format("bake.multiple_scattering.content=\"{}\"", content), setting});
}

// Views that reach the hard places: sun on the horizon, below it and in the zenith, camera on the
// ground, above it and at the top, ground and sky.
std::vector<SkyView> hard_views(double thickness_km) {
    std::vector<SkyView> views;
    for (const double sun : {90.0, 30.0, 0.0, -0.5, -4.0, -18.0, -90.0}) {
        for (const double altitude : {0.0, 0.2, thickness_km}) {
            views.push_back(test::dome(17, altitude, sun));
            views.push_back(test::panorama(18, altitude, sun));
        }
    }
    return views;
}

TEST(SkyView, HasTheSameBitsOnEveryTarget) {
    for (const test::Sky& sky :
         {test::sky_of("earth_hillaire"), peculiar_sky(), test::sky_of("earth_clear_mountain"),
          solved_sky("earth_hillaire", "moments", "bake.multiple_scattering.degree=3")}) {
        for (const SkyView& view : {test::dome(37, 0.2, 5), test::panorama(46, 3, -3)}) {
            const Image2<float> wanted = render_sky(sky.medium, sky.tables, view, 1);
            EXPECT_GT(std::ranges::max(wanted.texels), 0);
            test::on_every_target([&](const char* target) {
                EXPECT_EQ(render_sky(sky.medium, sky.tables, view, 1).texels, wanted.texels)
                    << target;
            });
        }
    }
}

TEST(SkyView, DoesNotDependOnThreads) {
    const SkyView view = test::panorama(50, 0.2, 2);
    const Image2<float> one = render_sky(earth().medium, earth().tables, view, 1);
    for (const int threads : {2, 3, 7}) {
        EXPECT_EQ(render_sky(earth().medium, earth().tables, view, threads).texels, one.texels);
    }
}

RC_GTEST_PROP(SkyView, DirectionsAreMirrorImagesAndUnitVectors, ()) {
    SkyView view = test::dome(*rc::gen::inRange(1, 60), 0, *rc::gen::inRange(-90, 91));
    if (*rc::gen::arbitrary<bool>()) view.projection = SkyProjection::panorama;
    view.height = *rc::gen::inRange(1, 60);
    const int x = *rc::gen::inRange(0, view.width);
    const int y = *rc::gen::inRange(0, view.height);
    const auto left = direction_at(view, x, y);
    const auto right = direction_at(view, view.width - 1 - x, y);
    RC_ASSERT(left.has_value() == right.has_value());
    if (!left) {
        RC_ASSERT(coverage_at(view, x, y) == 0);
        return;
    }
    RC_ASSERT(std::fabs(left->mu - right->mu) < 1e-15);
    RC_ASSERT(std::fabs(left->one_minus_cosine - right->one_minus_cosine) < 1e-14);
    RC_ASSERT(std::fabs(left->one_minus_cosine - (1 - left->cosine_to_sun)) < 1e-14);
    RC_ASSERT(std::fabs(left->one_plus_cosine - (1 + left->cosine_to_sun)) < 1e-14);
}

// The zenith in the middle, the sun upwards; the sun's azimuth in a panorama's middle.
TEST(SkyView, LooksWhereItSays) {
    const SkyView view = test::dome(101, 0, 30);
    EXPECT_EQ(direction_at(view, 50, 50)->mu, 1);
    const auto up = direction_at(view, 50, 50 - 34);  // 34 of 50.5 pixels: 60.6 degrees
    EXPECT_NEAR(std::acos(up->mu) * 180 / std::numbers::pi, 34 / 50.5 * 90, 1e-9);
    EXPECT_GT(up->cosine_to_sun, std::cos(std::numbers::pi / 180));
    EXPECT_FALSE(direction_at(view, 0, 0));
    const SkyView around = test::panorama(101, 0, 30);  // 50 rows from 90 to -90 degrees
    const auto ahead = direction_at(around, 50, 16);
    EXPECT_NEAR(ahead->mu, std::sin((90 - 16.5 * 3.6) * std::numbers::pi / 180), 1e-12);
    EXPECT_GT(ahead->cosine_to_sun, std::cos(1 * std::numbers::pi / 180));
}

// Half as many columns over half as many degrees are the middle of a panorama all around.
TEST(SkyView, APanoramaSpansTheAzimuthsThatItIsAskedFor) {
    const SkyView around = test::panorama(100, 0, 30);
    SkyView ahead = around;
    ahead.width = 50;
    ahead.azimuth_span_degrees = 180;
    for (const int x : {0, 13, 49}) {
        EXPECT_NEAR(direction_at(ahead, x, 20)->cosine_to_sun,
                    direction_at(around, 25 + x, 20)->cosine_to_sun, 1e-12);
    }
}

TEST(SkyView, IsFiniteAndNotNegativeInHardPlaces) {
    std::vector<test::Sky> skies = {peculiar_sky(), solved_sky("earth_urban_haze", "moments")};
    for (const std::string& preset : test::preset_list()) skies.push_back(test::sky_of(preset));
    for (const test::Sky& sky : skies) {
        for (const SkyView& view : hard_views(sky.medium.air.thickness_km)) {
            for (const float value : render_sky(sky.medium, sky.tables, view, 1).texels) {
                ASSERT_TRUE(value >= 0 && value < 1e3)
                    << sky.transmittance.entry.parameters << view.sun_elevation_degrees << ' '
                    << view.camera_altitude_km;
            }
        }
    }
}

// Against the path-traced radiance of Earth's air over black ground that integrated_sky_test.cpp has.
TEST(SkyView, MomentsAreNearerToPathsThanTheMeanRadiance) {
    const auto rows = test::number_rows(SKYBAKE_TEST_DATA "/truth_sky_setH0_h0.5.csv");
    const auto median_error = [&](const char* content) {
        const test::Sky sky = solved_sky("earth_hillaire", content, "atmosphere.ground_albedo=0");
        std::vector<SkyRay> rays;
        for (const auto& v : rows) {
            const SunZenith sun = {std::cos(v[1] / kDegreesPerRadian),
                                   std::sin(v[1] / kDegreesPerRadian)};
            const double zenith = v[2] / kDegreesPerRadian;
            rays.push_back(sky_ray(shell_of(sky.medium.air), v[0], sun,
                                   sky_direction(sun, std::cos(zenith), std::sin(zenith),
                                                 std::cos(v[3] / kDegreesPerRadian))));
        }
        const std::vector<Spectrum> found = march_sky(sky.medium, sky.tables, rays, 160, 1);
        std::vector<double> errors;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            errors.push_back(
                std::fabs(found[i][static_cast<std::size_t>(rows[i][4])] / rows[i][11] - 1));
        }
        std::sort(errors.begin(), errors.end());
        return errors[errors.size() / 2];
    };
    EXPECT_LT(median_error("moments"), 0.5 * median_error("hillaire"));
}

// The first moment is the mean radiance, and pictures of a table show it alone.
TEST(SkyTables, PicturesOfMomentsAreThoseOfTheMeanRadiance) {
    const auto shown = table_pictures(solved_sky("earth_hillaire", "moments").multiple_scattering);
    const auto mean = table_pictures(solved_sky("earth_hillaire", "hillaire").multiple_scattering);
    EXPECT_EQ(shown.at(6).picture.rgb, mean.at(6).picture.rgb);
}

// Larger tables leave less of the difference to direct integration, down to what marching costs.
TEST(SkyView, ApproachesDirectIntegrationAsTablesGrow) {
    const test::Sky small =
        test::sky_of("earth_hillaire",
                     {"bake.transmittance.size=[64,16]", "bake.multiple_scattering.size=[16,8]"});
    const test::Sky large = test::sky_of("earth_hillaire", test::large_tables());
    const test::Sky finest = test::sky_of("earth_hillaire", test::finest_tables());
    const SkyLight light = test::integrated(finest);
    for (const double sun : {10.0, -4.0}) {
        const SkyView view = test::dome(24, 0.2, sun);
        const Image2<float> direct = render_sky_reference(light, view, 1);
        const auto rms = [&](const test::Sky& sky) {
            const Image2<float> picture = render_sky(sky.medium, sky.tables, view, 1);
            return sky_difference(picture, direct, view).error.rms;
        };
        // In twilight a texel of so small a table may happen to lie right.
        if (sun > 0) {
            EXPECT_LT(rms(earth()), 0.5 * rms(small));
        }
        EXPECT_LT(rms(large), 0.5 * rms(earth())) << sun;
        EXPECT_LT(rms(large), 0.007) << sun;
    }
}

// Ground and sky, other planets, other cameras: what large tables and 40 steps leave. Through 50
// times Earth's air light falls by a factor of 10 within 1.6 km, so its table has rows enough to
// see that, and blue light still suffers from steps of many optical depths.
TEST(SkyView, IsNearDirectIntegrationOnOtherPlanets) {
    struct Case {
        const char* preset;
        double altitude_km;
        double sun;
        double rms;
    };
    const auto sky_with = [](std::vector<std::string> tables, const std::string& preset,
                             const std::string& rows) {
        if (preset == "dense_earth") {
            tables.push_back("bake.multiple_scattering.size=[32," + rows + "]");
        }
        return test::sky_of(preset, tables);
    };
    std::map<std::string, std::array<test::Sky, 2>> skies;
    for (const Case& at : {Case{"earth_hillaire", 100, 20, 0.01},
                           Case{"earth_hillaire", 0, 3, 0.01}, Case{"mars_rgb", 0.2, 15, 0.01},
                           Case{"mars_rgb", 0.2, -5, 0.03}, Case{"tiny_planet", 0.2, 10, 0.015},
                           Case{"dense_earth", 0.2, 40, 0.3}, Case{"vacuum", 0.2, 40, 1e-4}}) {
        if (!skies.contains(at.preset)) {
            skies[at.preset] = {sky_with(test::large_tables(), at.preset, "256"),
                                sky_with(test::finest_tables(), at.preset, "512")};
        }
        const auto& [sky, finest] = skies[at.preset];
        const SkyView view = test::panorama(20, at.altitude_km, at.sun);
        const Image2<float> direct = render_sky_reference(test::integrated(finest), view, 1);
        const Image2<float> picture = render_sky(sky.medium, sky.tables, view, 1);
        EXPECT_LT(sky_difference(picture, direct, view).error.rms, at.rms)
            << at.preset << ' ' << at.altitude_km << ' ' << at.sun;
    }
}

// Without air: a black sky over ground that sends albedo / pi of what falls on it.
TEST(SkyView, OfAVacuumIsBlackOverLambertsGround) {
    const test::Sky sky = test::sky_of("vacuum");
    const SkyView view = test::panorama(20, 0, 30);
    const Image2<float> picture = render_sky(sky.medium, sky.tables, view, 1);
    EXPECT_EQ(*picture.texel(10, 4), 0);
    EXPECT_NEAR(*picture.texel(10, 9), 0.3 / std::numbers::pi * 0.5, 1e-4);
}

TEST(SkyView, DoesNotChangeWithTheContentOfTheTransmittanceTable) {
    const test::Sky depths =
        test::sky_of("earth_hillaire", {"bake.transmittance.content=\"optical_depth\""});
    const SkyView view = test::dome(24, 0.2, 10);
    const Image2<float> wanted = render_sky(earth().medium, earth().tables, view, 1);
    const Image2<float> picture = render_sky(depths.medium, depths.tables, view, 1);
    EXPECT_LT(sky_difference(picture, wanted, view).error.max, 2e-3);
}

// The manifest's own probes: a flip or half a texel would show.
TEST(SkyTables, LookupsReturnTheProbes) {
    for (const char* mapping : {"bruneton", "ue"}) {
        for (const char* content : {"transmittance", "optical_depth"}) {
            const test::Sky sky = test::sky_of(
                "earth_hillaire", {std::string("bake.transmittance.mapping=\"") + mapping + "\"",
                                   std::string("bake.transmittance.content=\"") + content + "\""});
            const Shell shell = shell_of(sky.medium.air);
            ASSERT_FALSE(sky.transmittance.entry.levels[0].probes.empty());
            for (const Probe& probe : sky.transmittance.entry.levels[0].probes) {
                ASSERT_EQ(probe.at[0].first, "altitude_km");
                const double altitude = probe.at[0].second;
                const double s = (shell.ground_radius_km + altitude) * probe.at[1].second;
                // Probes at the horizon itself may be a rounding below it, where it is dark.
                if (s < -horizon_distance_km(shell, altitude)) continue;
                const Spectrum value = look_up_sunlight(sky.tables, shell, altitude, s);
                for (std::size_t c = 0; c < probe.value.size(); ++c) {
                    const double wanted =
                        sky.tables.holds_optical_depth ? std::exp(-probe.value[c]) : probe.value[c];
                    EXPECT_NEAR(value[c], wanted, 1e-6) << altitude;
                }
            }
        }
    }
}

TEST(SkyTables, KnowsWhatATableHoldsByItsKeyAndNotByItsWords) {
    for (const bool is_depth : {false, true}) {
        const std::string content = is_depth ? "optical_depth" : "transmittance";
        test::Sky sky =
            test::sky_of("earth_hillaire", {"bake.transmittance.content=\"" + content + "\""});
        for (const char* words : {"optical depth", "transmittance", "light"}) {
            sky.transmittance.entry.content = words;
            const auto tables = make_sky_tables(sky.transmittance, &sky.multiple_scattering);
            ASSERT_TRUE(tables.value) << words;
            EXPECT_EQ(tables.value->holds_optical_depth, is_depth) << words;
        }
        sky.transmittance.entry.parameters = "[bake.transmittance]\ncontent = \"shade\"\n";
        EXPECT_FALSE(make_sky_tables(sky.transmittance, &sky.multiple_scattering).value);
    }
}

TEST(SkyTables, RefusesWhatIsNoPair) {
    const test::Sky& sky = earth();
    EXPECT_FALSE(make_sky_tables(sky.multiple_scattering, &sky.transmittance).value);
    PreviewAsset strange = sky.transmittance;
    strange.entry.mapping = "linear";
    EXPECT_FALSE(make_sky_tables(strange, &sky.multiple_scattering).value);
    PreviewAsset cut = solved_sky("earth_hillaire", "moments").multiple_scattering;
    cut.table = Image2<float>(64, 64, 3);  // no six tables
    EXPECT_FALSE(make_sky_tables(sky.transmittance, &cut).value);
    PreviewAsset grey = sky.multiple_scattering;
    grey.table = Image2<float>(32, 32, 1);
    test::expect_refused(make_sky_tables(sky.transmittance, &grey), "E0304");
}

}  // namespace
}  // namespace skybake
