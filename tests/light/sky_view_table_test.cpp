#include "bakers/assets/sky_view/sky_view_table.h"

#include <gtest/gtest.h>

#include "bakers/assets/sky/sky_asset.h"
#include "bakers/field/interpolation.h"
#include "bakers/math/relative_error.h"
#include "config/assets/sky_view.h"
#include "tests/light/sky_media.h"
#include "tests/support/bakes.h"

namespace skybake {
namespace {

using config::SkyOrders;
using test::kDegree;
using test::TestSky;

config::SkyViewBake bake_of(std::array<int, 2> size, double altitude_km,
                            const std::vector<double>& suns) {
    config::SkyViewBake bake;
    bake.size = size;
    bake.altitude = {altitude_km * 1000};
    for (const double sun : suns) bake.sun_elevations.push_back({sun * kDegree});
    return bake;
}

config::Outcome<Baked> bake(const SkyLight& light, const config::SkyViewBake& asset,
                            Certification certification = Certification::off) {
    Baked table;
    table.name = "view";
    table.channel_names = {"R", "G", "B"};
    return bake_sky_view(light, asset, {.threads = 1, .certification = certification}, table);
}

TEST(SkyViewTable, HoldsWhatTheIntegratorSees) {
    const auto baked =
        bake(test::earth().light(), bake_of({48, 36}, 0.5, {30, -4}), Certification::quick);
    ASSERT_TRUE(baked.value);
    const Certificate& certificate = baked.value->certificate;
    EXPECT_LT(certificate.texel.max, 5e-3);
    EXPECT_LT(certificate.texel.rms, 5e-4);
    EXPECT_LT(certificate.lookup.rms, 0.02);
    EXPECT_EQ(certificate.texel_points, 512);
    EXPECT_EQ(baked.value->image().height, 72);
}

// A range of light has no end that anybody would ask for.
TEST(SkyViewTable, SaysWhereLightCameOutNegative) {
    TableModel model;
    model.channels = 3;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    model.cost_per_texel = {1};
    model.error = relative_error;
    model.row = [](int, double, const std::vector<double>& x, double* values) {
        std::fill_n(values, 3 * x.size(), -1.16e-7);
    };
    model.reference = [](double, const std::vector<double>& x, double* values) {
        std::fill_n(values, 3 * x.size(), 0.0);
    };
    Baked table;
    table.name = "view";
    table.channel_names = {"R", "G", "B"};
    const auto outcome = finish_table(
        model, sky_table_request({4, 4}), {.threads = 1, .certification = Certification::off},
        [](double x, double) {
            return Place{{"azimuth_deg", 180 * x}};
        },
        table);
    ASSERT_EQ(outcome.diagnostics.size(), 1U);
    EXPECT_EQ(outcome.diagnostics[0].code, "E0405");
    EXPECT_EQ(outcome.diagnostics[0].message,
              "`view`: the light at azimuth_deg 0 came out negative: -1.16e-07");
}

TEST(SkyViewTable, StacksTheTablesOfItsSuns) {
    const auto both = bake(test::earth().light(), bake_of({8, 6}, 0.5, {30, 5}));
    const auto second = bake(test::earth().light(), bake_of({8, 6}, 0.5, {5}));
    ASSERT_TRUE(both.value && second.value);
    const Image2<float>& stack = both.value->image();
    const Image2<float>& alone = second.value->image();
    EXPECT_TRUE(std::equal(alone.texels.begin(), alone.texels.end(),
                           stack.texels.begin() + static_cast<std::ptrdiff_t>(stack.offset(0, 6))));
    // Each sun has its share of the probes, which find there what its table alone would give.
    int of_second = 0;
    for (const Probe& probe : both.value->levels[0].probes) {
        const bool in_second = probe.uvw[1] > 0.5;
        const auto sun = std::find_if(probe.at.begin(), probe.at.end(), [](const auto& place) {
            return place.first == "sun_elevation_deg";
        });
        ASSERT_NE(sun, probe.at.end());
        EXPECT_NEAR(sun->second, in_second ? 5 : 30, 1e-12);
        if (!in_second) continue;
        ++of_second;
        std::array<double, 3> expected{};
        bilinear(alone, probe.uvw[0], 2 * probe.uvw[1] - 1, expected.data());
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(probe.value[c], expected[c], 1e-12);
            EXPECT_GT(probe.tolerance[c], 0);
        }
    }
    EXPECT_GE(of_second, 12);
    EXPECT_GE(static_cast<int>(both.value->levels[0].probes.size()) - of_second, 12);
}

TEST(SkyViewTable, IsBlackWithoutAirButForTheGround) {
    const TestSky sky(test::preset_atmosphere("vacuum", {"atmosphere.ground_albedo=0.5"}),
                      SkyOrders::single);
    const auto single = bake(sky.light(), bake_of({4, 4}, 1, {30, -30}));
    ASSERT_TRUE(single.value);
    for (const float texel : single.value->image().texels) EXPECT_EQ(texel, 0);
    const SkyLight lit(test::preset_sky("vacuum", {"atmosphere.ground_albedo=0.5"}), SkyOrders::all,
                       nullptr);
    const auto all = bake(lit, bake_of({4, 4}, 0, {30}));
    ASSERT_TRUE(all.value);
    EXPECT_NEAR(*all.value->image().texel(1, 0), 0.5 / std::numbers::pi * 0.5, 1e-7);
    EXPECT_EQ(*all.value->image().texel(1, 3), 0);
}

TEST(SkyViewTable, TakesAnySizeCameraAndSun) {
    for (const std::array<int, 2> size : {std::array<int, 2>{1, 1}, {2, 2}, {3, 5}, {1, 4}}) {
        for (const double altitude : {0.0, 1e-3, 99.9999, 100.0, 100.0001, 1000.0, 1e6}) {
            const auto baked =
                bake(test::earth().light(), bake_of(size, altitude, {90, 0, -6, -90}));
            ASSERT_TRUE(baked.value) << altitude;
            for (const float texel : baked.value->image().texels) {
                EXPECT_TRUE(std::isfinite(texel) && texel >= 0) << altitude;
            }
        }
    }
}

TEST(SkyViewTable, IsContinuousWhereTheCameraMoves) {
    const auto view = [&](double altitude) {
        return bake(test::earth().light(), bake_of({4, 8}, altitude, {20})).value->image();
    };
    const Image2<float> ground = view(0);
    const Image2<float> above = view(1e-6);
    for (std::size_t i = 0; i < ground.texels.size(); ++i) {
        EXPECT_NEAR(ground.texels[i], above.texels[i], 2e-3 * ground.texels[i]);
    }
    // From above, only rays that look down see something.
    const Image2<float> top = view(100);
    const Image2<float> beyond = view(100 + 1e-8);
    for (std::size_t i = 0; i < top.texels.size(); ++i) {
        EXPECT_NEAR(top.texels[i], beyond.texels[i], 2e-3 * top.texels[i] + 1e-9);
    }
}

TEST(SkyViewTable, SaysWhatHalfLoses) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::single);
    config::SkyViewBake asset = bake_of({16, 16}, 0, {-12});
    asset.pixel_type = config::PixelType::half;
    const auto baked = bake(sky.light(), asset);
    ASSERT_TRUE(baked.value);
    EXPECT_GT(baked.value->range.below_normal, 0);
    ASSERT_EQ(baked.diagnostics.size(), 1u);
    EXPECT_EQ(baked.diagnostics[0].code, "W0201");
}

// Bakes a table as a recipe asks for it: one layer's single scattering, with its probes in place.
TEST(SkyViewTable, IsBakedByARecipe) {
    const auto baked = test::bake_first(
        "preset = 'earth_hillaire'\n[bake.haze]\nasset = 'sky_view'\nsize = [16, 12]\n"
        "orders = 'single'\nlayers = ['mie']\nsun_elevations = ['30 deg', '5 deg']\n");
    ASSERT_TRUE(baked.value);
    EXPECT_EQ(baked.value->kind, "sky_view");
    EXPECT_NE(baked.value->content.find("single scattering by mie"), std::string::npos);
    EXPECT_NE(baked.value->parameters.find("layers = [\"mie\"]"), std::string::npos);
    for (const Probe& probe : baked.value->levels[0].probes) {
        ASSERT_EQ(probe.at.size(), 3u);
        std::vector<double> found(3);
        bilinear(baked.value->image(), probe.uvw[0], probe.uvw[1], found.data());
        for (std::size_t c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(found[c], probe.value[c]);
    }
}

}  // namespace
}  // namespace skybake
