#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <span>

#include "bakers/assets/environment/environment_table.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using test::baked;
using test::kDegree;

// A layer of 4 x 4 km from 1 to 2 km whose voxels are a function of their place, in shares of it.
template <class Density>
CloudMedium layer_of(const std::array<int, 3>& size, double extinction_per_m,
                     const Density& density, bool repeats = true) {
    config::Cloud cloud;
    cloud.extent = {config::Length{4000}, config::Length{4000}, config::Length{1000}};
    cloud.base_altitude = {1000};
    cloud.extinction_scale.per_meter = extinction_per_m;
    std::vector<float> voxels;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        voxels.push_back(static_cast<float>(
            density((x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2])));
    });
    CloudMedium medium = cloud_medium(cloud, voxels.data(), size, 1, 1, repeats);
    medium.leaps = leaps_of_voxels(medium, 4, 1);
    return medium;
}

using Media = std::span<const CloudMedium>;

Media only(const CloudMedium& medium) { return {&medium, 1}; }

EnvironmentBake bake_of(std::array<int, 2> size, double sun) {
    EnvironmentBake bake = test::map_bake(size, sun);
    bake.clouds = {"clouds"};
    return bake;
}

double uneven(double x, double y, double z) {
    return std::max(0.0, std::sin(9 * x + 2 * z) * std::cos(7 * y) + 0.2);
}

// Beer's law through a slab, whose depth along a slant is that of the vertical over the sine.
TEST(EnvironmentClouds, TransmitByBeersLawHoweverThick) {
    for (const double extinction : {1e-4, 1e-2, 0.3}) {
        const CloudMedium slab =
            layer_of({64, 64, 32}, extinction, [](double, double, double) { return 1; });
        const EnvironmentBake bake = bake_of({4, 2}, 30);
        const EnvironmentLayout layout(bake.mapping, bake.size);
        const CloudsAround clouds(only(slab), bake, layout, true, {.threads = 1});
        for (const double elevation : {90.0, 50.0, 20.0}) {
            const double depth = 1000 * extinction / std::sin(elevation * kDegree);
            if (depth > 150) continue;
            const double found =
                clouds.transmittance(direction_of_angles({0.4, elevation * kDegree}));
            EXPECT_NEAR(-std::log(found) / depth, 1, 0.004) << extinction << " " << elevation;
        }
        EXPECT_EQ(clouds.transmittance(direction_of_angles({0, -30 * kDegree})), 1);
    }
}

TEST(EnvironmentClouds, NothingChangesTheClearSky) {
    const CloudMedium nothing = layer_of({8, 8, 4}, 0.1, [](double, double, double) { return 0; });
    const EnvironmentBake bake = bake_of({64, 32}, 20);
    const Image2<float> with = baked(bake, only(nothing)).image();
    const Image2<float> without = baked(bake, {}).image();
    for (std::size_t i = 0; i < with.texels.size(); ++i) {
        EXPECT_NEAR(with.texels[i], without.texels[i], 2e-3 * without.texels[i]);
    }
}

// A lump straight ahead is in the middle of the map, one to the right is at 3/4.
TEST(EnvironmentClouds, StandWhereTheLayerHasThem) {
    const auto lump_at = [](double lump_x, double lump_y) {
        return layer_of(
            {32, 32, 4}, 0.1,
            [=](double x, double y, double) {
                return std::hypot(x - lump_x, y - lump_y) < 0.12 ? 1.0 : 0.0;
            },
            false);
    };
    const auto darkest_column = [](const CloudMedium& medium) {
        EnvironmentBake bake = bake_of({64, 32}, 20);
        bake.camera_x = {2000};
        bake.camera_y = {2000};
        const EnvironmentLayout layout(bake.mapping, bake.size);
        const CloudsAround clouds(only(medium), bake, layout, true, {.threads = 1});
        double sum = 0;
        double moment = 0;
        for (int x = 0; x < 64; ++x) {
            for (int y = 0; y < 16; ++y) {
                const double opacity = 1 - clouds.texel(0, x, y).transmittance;
                sum += opacity;
                moment += opacity * (x + 0.5);
            }
        }
        EXPECT_GT(sum, 1);
        return moment / sum;
    };
    EXPECT_NEAR(darkest_column(lump_at(0.85, 0.5)), 32, 0.5);
    EXPECT_NEAR(darkest_column(lump_at(0.5, 0.15)), 48, 0.5);
    EXPECT_NEAR(darkest_column(lump_at(0.5, 0.85)), 16, 0.5);
}

// The means of texels against means of many other rays at half the step.
TEST(EnvironmentClouds, TexelsAreMeansOfTheirSolidAngle) {
    const CloudMedium medium = layer_of({32, 32, 16}, 0.02, uneven);
    EnvironmentBake bake = bake_of({48, 24}, 35);
    bake.samples = 4;
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(only(medium), bake, layout, true, {.threads = 1});
    double squares = 0;
    double transmitted = 0;
    double expected = 0;
    testing::for_each_texel(48, 10, [&](int x, int y) {
        const SeenClouds texel = clouds.texel(0, x, y);
        const SeenClouds around = clouds.around(0, (x + 0.5) / 48, (y + 0.5) / 24);
        squares += std::pow(texel.transmittance - around.transmittance, 2);
        transmitted += texel.transmittance * layout.solid_angle(0, x, y);
        expected += around.transmittance * layout.solid_angle(0, x, y);
    });
    EXPECT_LT(std::sqrt(squares / 480), 0.02);
    EXPECT_NEAR(transmitted / expected, 1, 5e-3);
}

// Over a slab's upper hemisphere the mean of exp(-t / sin) over the solid angle is the exponential
// integral E2(t), 0.326643862 at t = 0.5 (Abramowitz & Stegun 1964, table 5.4).
TEST(EnvironmentClouds, TexelsWeighRaysByTheirSolidAngle) {
    const CloudMedium slab = layer_of({4, 4, 32}, 5e-4, [](double, double, double) { return 1; });
    EnvironmentBake bake = bake_of({2, 2}, 35);
    bake.samples = 16;
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(only(slab), bake, layout, false, {.threads = 1});
    EXPECT_NEAR(clouds.texel(0, 0, 0).transmittance, 0.326643862, 0.004);
    EXPECT_NEAR(clouds.texel(0, 1, 0).transmittance, 0.326643862, 0.004);
}

TEST(EnvironmentClouds, AreTheSameOnAnyNumberOfThreads) {
    const CloudMedium medium = layer_of({16, 16, 8}, 0.02, uneven);
    const EnvironmentBake bake = bake_of({40, 20}, 35);
    EXPECT_EQ(baked(bake, only(medium)).image().texels,
              baked(bake, only(medium), Certification::off, 3).image().texels);
}

TEST(EnvironmentClouds, CertifyWhatLookupsMiss) {
    const CloudMedium medium = layer_of({16, 16, 8}, 0.02, uneven);
    const Baked map = baked(bake_of({32, 16}, 35), only(medium), Certification::quick);
    EXPECT_TRUE(map.certified);
    EXPECT_GT(map.certificate.texel.max, 1e-4);
    EXPECT_LT(map.certificate.texel.rms, 0.1);
    EXPECT_NE(map.certificate.reference.find("64 rays"), std::string::npos);
}

TEST(EnvironmentClouds, HardCasesAreFinite) {
    const auto one = [](double, double, double) { return 1.0; };
    for (const double extinction : {0.0, 1e3}) {
        for (const double sun : {90.0, -8.0}) {
            for (const double altitude : {0.0, 1500.0, 2500.0}) {
                const CloudMedium medium = layer_of({1, 1, 1}, extinction, one);
                EnvironmentBake bake = bake_of({8, 4}, sun);
                bake.altitude = {altitude};
                bake.samples = 1;
                bake.sun = config::SunInMap::disc;
                const Baked map = baked(bake, only(medium));
                for (const float texel : map.image().texels) {
                    EXPECT_TRUE(std::isfinite(texel) && texel >= 0)
                        << texel << " " << extinction << " " << sun << " " << altitude;
                }
            }
        }
    }
}

}  // namespace
}  // namespace skybake
