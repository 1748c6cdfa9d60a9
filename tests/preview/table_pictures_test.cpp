#include "bakers/preview/pictures/asset_pictures.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "bakers/preview/pictures/table_geometry.h"
#include "tests/preview/captions.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

const std::vector<std::string> presets = {"earth_hillaire", "tiny_planet", "vacuum"};

// Both tables of a preset, small, each with every mapping.
const std::vector<PreviewAsset>& tables_of(const std::string& preset) {
    static std::map<std::string, std::vector<PreviewAsset>> baked;
    const auto [found, fresh] = baked.try_emplace(preset);
    if (!fresh) return found->second;
    found->second = test::baked("preset = \"" + preset + "\"\n" + R"(
[bake.t]
asset = "transmittance"
size = [24, 8]
[bake.ue]
asset = "transmittance"
mapping = "ue"
content = "optical_depth"
size = [24, 8]
[bake.m]
asset = "multiple_scattering"
method = "converged"
mapping = "hillaire"
size = [16, 6]
max_texel_error = 0.05
[bake.twilight]
asset = "multiple_scattering"
method = "converged"
mapping = "twilight"
size = [16, 6]
max_texel_error = 0.05
)")
                        .assets;
    return found->second;
}

// The probes say of places where they are in the texture, in the bakers' own words.
TEST(TableGeometry, AgreesWithTheProbes) {
    for (const std::string& preset : presets) {
        for (const PreviewAsset& asset : tables_of(preset)) {
            const auto geometry = TableGeometry::of(asset.entry);
            ASSERT_TRUE(geometry.has_value()) << preset << " " << asset.entry.name;
            ASSERT_FALSE(asset.entry.levels[0].probes.empty());
            for (const Probe& probe : asset.entry.levels[0].probes) {
                const double angle = std::acos(probe.at[1].second) * 180 / std::numbers::pi;
                const auto uv = geometry->texture_coordinates(probe.at[0].second, angle);
                EXPECT_NEAR(uv[0], probe.uvw[0], 1e-6) << preset << " " << asset.entry.name;
                EXPECT_NEAR(uv[1], probe.uvw[1], 1e-9);
            }
        }
    }
}

TEST(TableGeometry, InvertsItself) {
    const std::vector<PreviewAsset>& assets = tables_of("earth_hillaire");
    ASSERT_EQ(assets.size(), 4U);
    EXPECT_TRUE(rc::check([&] {
        const auto geometry = TableGeometry::of((*rc::gen::elementOf(assets)).entry);
        const double u = *rc::gen::inRange(100, 901) / 1000.0;
        const double v = *rc::gen::inRange(100, 901) / 1000.0;
        const double altitude = geometry->altitude_km(v);
        const double angle = geometry->zenith_angle(u, altitude);
        RC_ASSERT(angle <= geometry->largest_zenith_angle(altitude));
        const auto uv = geometry->texture_coordinates(altitude, angle);
        RC_ASSERT(std::abs(uv[0] - u) < 1e-6);
        RC_ASSERT(std::abs(uv[1] - v) < 1e-9);
    }));
}

TEST(TableGeometry, StaysMonotonicBeyondItsEndPoints) {
    for (const PreviewAsset& asset : tables_of("earth_hillaire")) {
        const auto geometry = TableGeometry::of(asset.entry);
        for (int i = 0; i < 100; ++i) {
            const double t = i / 100.0;
            EXPECT_LT(geometry->altitude_km(t), geometry->altitude_km(t + 0.01));
            const double change =
                geometry->zenith_angle(t + 0.01, 0) - geometry->zenith_angle(t, 0);
            EXPECT_TRUE(geometry->is_transmittance() ? change > 0 : change < 0);
        }
    }
}

TEST(TablePictures, ShowEachTableWithItsChannels) {
    for (const std::string& preset : presets) {
        std::set<std::string> names;
        for (const PreviewAsset& asset : tables_of(preset)) {
            const std::vector<PreviewPicture> pictures = table_pictures(asset);
            EXPECT_EQ(pictures.size(), asset.entry.channels.size() + 4);
            for (const PreviewPicture& picture : pictures) {
                EXPECT_TRUE(names.insert(picture.name).second) << picture.name;
                EXPECT_FALSE(picture.title.empty());
                test::expect_sentences(picture);
                EXPECT_GT(picture.picture.width, 500);
                EXPECT_LT(picture.picture.width, 900);
            }
        }
    }
}

// Rays that hit the ground have no texel: grey, right of a horizon that dips with altitude.
TEST(TablePictures, AreGreyBelowTheHorizon) {
    const std::vector<PreviewAsset>& assets = tables_of("earth_hillaire");
    const Picture view = table_pictures(assets[0])[0].picture;
    const auto grey_in_row = [&](int y) {
        int count = 0;
        for (int x = 0; x < view.width; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * view.width + x);
            count += view.rgb[at] == 0xd4 && view.rgb[at + 1] == 0xd4 && view.rgb[at + 2] == 0xd4;
        }
        return count;
    };
    // 512 columns to 105 degrees; the horizon is at 90 degrees at the ground and at 100 at the top.
    const int top = 60, bottom = 350;
    EXPECT_NEAR(grey_in_row(top), 512 * (105 - 100) / 105, 6);
    EXPECT_NEAR(grey_in_row(bottom), 512 * (105 - 91) / 105, 8);
}

TEST(TablePictures, OfUnknownParametersAreTheTexelsAlone) {
    PreviewAsset asset = tables_of("earth_hillaire")[0];
    asset.entry.parameters = "[from.the.future]\nx = 1\n";
    const std::vector<PreviewPicture> pictures = table_pictures(asset);
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].name, "t_texels");
}

TEST(TablePictures, OfOtherAssetsAreNone) {
    PreviewAsset asset = tables_of("earth_hillaire")[0];
    asset.entry.kind = "from the future";
    EXPECT_TRUE(asset_pictures(asset).empty());
    asset.table = Image2<float>();
    EXPECT_TRUE(table_pictures(asset).empty());
}

}  // namespace
}  // namespace skybake
