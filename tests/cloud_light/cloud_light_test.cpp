// The asset as recipes bake it: what its channels hold, and that its certificate tells wrong texels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/cloud_light_truth.h"
#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/field/baked.h"
#include "bakers/math/quadrature.h"
#include "tests/cloud_light/layers.h"
#include "tests/support/volumes.h"

namespace skybake::cloud_light {
namespace {

CloudLightBake bake_of(CloudLightContents contents, int cell = 2) {
    CloudLightBake bake;
    bake.of = "cloud";
    bake.contents = contents;
    bake.cell = cell;
    bake.pixel_type = config::PixelType::float32;
    if (config::is_per_sun(contents)) bake.sun_elevations = {{0.6}};
    return bake;
}

Baked baked(const CloudLayer& layer, const CloudLightBake& bake, int threads = 2,
            Certification certification = Certification::off) {
    const BakeOptions options{.threads = threads, .certification = certification};
    const Baked of = test::volume_of(layer);
    auto outcome = bake_cloud_light(of, layer, bake, options, {});
    return outcome.value.value();
}

// With an optical depth of 0.2 a layer, 8 voxels of 8 m high.
CloudLayer slab() { return test::layer_of({8, 8, 8}, 1, 0.2 / 64); }

// Returns the texels of the first channel.
std::vector<float> first_of(const Baked& volume) { return testing::planes_of(volume).front(); }

TEST(CloudLight, OfASlabFallsWithTheDepthBelowItsTop) {
    const Baked volume = baked(slab(), bake_of(CloudLightContents::optical_depth));
    const std::vector<float> depths = first_of(volume);
    ASSERT_EQ(volume.levels.front().size, (std::array{4, 4, 4}));
    for (int z = 0; z < 4; ++z) {
        EXPECT_NEAR(depths[occupancy::index_of({4, 4, 4}, 1, 2, z)],
                    0.2 * (1 - (z + 0.5) / 4) / std::sin(0.6), 0.02);
    }
}

TEST(CloudLight, AShadowIsTheDepthOfTheWholeLayer) {
    const Baked volume = baked(slab(), bake_of(CloudLightContents::shadow));
    ASSERT_EQ(volume.levels.front().size, (std::array{4, 4, 1}));
    for (const float depth : first_of(volume)) EXPECT_NEAR(depth, 0.2 / std::sin(0.6), 1e-6);
}

TEST(CloudLight, TransmittanceIsTheExponentialOfTheDepth) {
    const CloudLayer layer = test::rough_layer({8, 8, 6});
    const auto depths = first_of(baked(layer, bake_of(CloudLightContents::optical_depth, 1)));
    const auto shares = first_of(baked(layer, bake_of(CloudLightContents::transmittance, 1)));
    for (std::size_t i = 0; i < depths.size(); ++i) {
        EXPECT_NEAR(shares[i], std::exp(-depths[i]), 2e-7);
    }
}

// Without cloud the sky is open: its harmonics are those of the upper hemisphere.
TEST(CloudLight, AnEmptyLayerSeesTheWholeSky) {
    const CloudLayer nothing = test::layer_of({8, 8, 8}, 0);
    const auto open =
        testing::planes_of(baked(nothing, bake_of(CloudLightContents::sky_visibility)));
    ASSERT_EQ(open.size(), 4U);
    EXPECT_NEAR(open[0][5], std::sqrt(std::numbers::pi), 1e-5);
    EXPECT_NEAR(open[1][5], 0, 1e-5);
    EXPECT_NEAR(open[2][5], std::sqrt(3 * std::numbers::pi) / 2, 1e-5);
    const auto suns =
        testing::planes_of(baked(nothing, bake_of(CloudLightContents::transmittance_harmonics)));
    EXPECT_NEAR(suns[0][5] / (2 * std::sqrt(std::numbers::pi)), 1, 1e-5);
    EXPECT_NEAR(suns[2][5], 0, 1e-5);
    for (const float depth : first_of(baked(nothing, bake_of(CloudLightContents::optical_depth)))) {
        EXPECT_EQ(depth, 0);
    }
}

// Diffuse light of a uniform sky through a slab: the flux below is 2 E_3(tau) of the open sky's, and
// the mean of the transmittance over solid angle is E_2(tau). E_2(0.2) = 0.574201, from Abramowitz and
// Stegun 1964, table 5.1: E_1(0.2) = 1.2226505 and E_2(x) = exp(-x) - x E_1(x).
TEST(CloudLight, TheSkyBelowASlabIsTheExponentialIntegral) {
    CloudLightBake bake = bake_of(CloudLightContents::sky_visibility, 1);
    bake.degree = 0;
    CloudLayer layer = slab();
    layer.size = {2, 2, 256};
    layer.voxel_m = {10, 10, 0.25};
    layer.values.assign(occupancy::count_of(layer.size), 1);
    const auto sky = first_of(baked(layer, bake));
    const double below = sky[0] / std::sqrt(std::numbers::pi);
    // The lowest texel's centre is half a voxel above the base.
    const double depth = 0.2 * (1 - 0.5 / 256);
    EXPECT_NEAR(
        below, std::exp(-depth) - depth * (1.2226505 + std::exp(-0.2) / 0.2 * (0.2 - depth)), 2e-3);
}

// Harmonics of degree 2 over suns of a slab: what they say of a sun is near to its transmittance.
TEST(CloudLight, PartsOfHarmonicsAddUpToTheTransmittance) {
    CloudLightBake bake = bake_of(CloudLightContents::transmittance_harmonics, 1);
    bake.degree = 2;
    const glm::dvec3 sun = towards(0.8, 2);
    const Harmonics values = harmonics(sun);
    double sum = 0;
    for (int part = 1; part <= 3; ++part) {
        bake.part = part;
        const auto texels = testing::planes_of(baked(slab(), bake));
        ASSERT_EQ(texels.size(), part < 3 ? 4U : 1U);
        for (std::size_t c = 0; c < texels.size(); ++c) {
            sum += values[static_cast<std::size_t>(4 * (part - 1)) + c] * texels[c][0];
        }
    }
    const double depth = 0.2 * (1 - 0.5 / 8) / std::sin(0.8);
    EXPECT_NEAR(sum, std::exp(-depth), 0.05);
}

TEST(CloudLight, AFinerGridIsNearer) {
    const CloudLayer layer = test::lone_cloud({32, 32, 16}, {4, 6, 3}, {20, 24, 13});
    double first = 0;
    double last = 1;
    for (const int cell : {8, 4, 2, 1}) {
        const Baked volume =
            baked(layer, bake_of(CloudLightContents::optical_depth, cell), 2, Certification::quick);
        const double rms = volume.certificate.lookup.rms;
        EXPECT_LT(rms, last) << cell;
        EXPECT_GT(rms, 0);
        if (first == 0) first = rms;
        last = rms;
    }
    EXPECT_LT(last, first / 5);
}

TEST(CloudLight, SizesThatCellsDoNotDivideSpanTheSameBox) {
    const CloudLayer layer = test::rough_layer({13, 7, 5});
    for (const int cell : {1, 2, 3, 4, 16}) {
        const Baked volume =
            baked(layer, bake_of(CloudLightContents::optical_depth, cell), 2, Certification::quick);
        for (std::size_t a = 0; a < 3; ++a) {
            EXPECT_EQ(volume.levels.front().size[a], (layer.size[a] + cell - 1) / cell);
            EXPECT_NEAR(volume.voxel_size_m[a] * volume.levels.front().size[a],
                        layer.voxel_m[a] * layer.size[a], 1e-9);
        }
        EXPECT_TRUE(std::isfinite(volume.certificate.lookup.max));
    }
}

TEST(CloudLight, BakesHardCases) {
    CloudLayer voxel = test::layer_of({1, 1, 1}, 0.5F);
    EXPECT_NEAR(first_of(baked(voxel, bake_of(CloudLightContents::optical_depth, 4)))[0],
                0.05 * 0.5 * 4 / std::sin(0.6), 1e-6);
    CloudLayer opaque = test::rough_layer({8, 8, 8});
    opaque.optics.extinction_per_m = 1e4;
    for (const float share : first_of(baked(opaque, bake_of(CloudLightContents::transmittance)))) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
    }
}

// Errors of radiance are shares of the source's light. As shares of their own range, which is small where
// there is hardly any cloud, the noise of the paths would exceed 1.
TEST(CloudLight, CertificatesOfRadianceTellSomethingOfHardlyAnyCloud) {
    CloudLayer layer = test::lone_cloud({16, 16, 8}, {6, 6, 3}, {9, 9, 5});
    for (const auto contents :
         {CloudLightContents::sun_radiance, CloudLightContents::sky_radiance}) {
        CloudLightBake bake = bake_of(contents);
        if (contents == CloudLightContents::sun_radiance) bake.sun_elevations = {{0.6}};
        for (const double extinction_per_m : {5e-2, 5e-4}) {
            layer.optics.extinction_per_m = extinction_per_m;
            const Baked volume = baked(layer, bake, 2, Certification::quick);
            EXPECT_GT(volume.certificate.lookup.rms, 0);
            EXPECT_LT(volume.certificate.lookup.rms, 0.015) << extinction_per_m;
            EXPECT_LT(volume.certificate.lookup.max, 0.08) << extinction_per_m;
        }
    }
}

// Paths of light through a thousand depths have millions of collisions.
TEST(CloudLight, QuickCertificatesDoNotWaitForLongPaths) {
    CloudLayer layer = test::layer_of({8, 8, 32}, 1);
    const CloudLightBake bake = bake_of(CloudLightContents::sky_radiance);
    for (const double extinction_per_m : {0.02, 5.0, 1e4}) {
        layer.optics.extinction_per_m = extinction_per_m;
        const Baked volume = baked(layer, bake, 2, Certification::quick);
        const bool is_thin = extinction_per_m < 1;
        EXPECT_EQ(volume.certified, is_thin) << extinction_per_m;
        EXPECT_EQ(fact_named(volume.details, "not_measured").empty(), is_thin) << extinction_per_m;
    }
}

// Texels that are all 0 err by the light itself, which in a thick slab is about that of the source.
TEST(CloudLight, ErrorsOfRadianceAreSharesOfTheSource) {
    const CloudLayer layer = test::layer_of({4, 4, 16}, 1);
    CloudLightBake bake = bake_of(CloudLightContents::sky_radiance);
    const CloudLightTruth truth = cloud_light_truth(layer, bake, 2);
    const std::array<double, 3> top = {0.5, 0.5, 0.99};
    const std::vector<double> wanted = truth.reference(top);
    const std::vector<double> errors =
        truth.comparison.errors(top, std::vector<double>(wanted.size(), 0.0), wanted);
    EXPECT_NEAR(errors[0], -wanted[0] / std::sqrt(std::numbers::pi), 1e-12);
    EXPECT_LT(errors[0], -1);
}

// A slab is even along x, where places have random numbers of their own.
TEST(CloudLight, StandardErrorsOfRadianceAreTheSpreadOfOtherPaths) {
    const CloudLayer layer = test::layer_of({4, 4, 16}, 1);
    CloudLightBake bake = bake_of(CloudLightContents::sun_radiance);
    bake.sun_elevations = {{0.6}};
    const CloudLightTruth truth = cloud_light_truth(layer, bake, 1);
    constexpr int kPlaces = 48;
    double sum = 0, squares = 0, variance = 0;
    for (int i = 0; i < kPlaces; ++i) {
        const std::vector<double> found = truth.reference({(i + 0.5) / kPlaces, 0.5, 0.7});
        ASSERT_EQ(found.size(), 8U);
        sum += found[0] / kPlaces;
        squares += found[0] * found[0] / kPlaces;
        const double noise =
            truth.comparison.noise(found)[0] * cloud_light::unshaded_coefficient(bake);
        variance += noise * noise / kPlaces;
    }
    EXPECT_NEAR(std::sqrt(squares - sum * sum) / std::sqrt(variance), 1, 0.35);
}

TEST(CloudLight, ErrorsOfDepthsAreSharesOfTheSun) {
    const CloudLayer layer = test::layer_of({4, 4, 16}, 1);
    const std::array<double, 3> middle = {0.5, 0.5, 0.5};
    const auto error_of = [&](CloudLightContents contents, double found, double wanted) {
        const CloudLightTruth truth = cloud_light_truth(layer, bake_of(contents), 2);
        return truth.comparison.errors(middle, {found}, {wanted})[0];
    };
    for (const auto contents : {CloudLightContents::optical_depth, CloudLightContents::shadow}) {
        EXPECT_NEAR(error_of(contents, 0, std::numbers::ln2), 0.5, 1e-12);
        EXPECT_NEAR(error_of(contents, 30, 40), 0, 1e-12);
    }
    EXPECT_NEAR(error_of(CloudLightContents::transmittance, 0.75, 0.25), 0.5, 1e-12);
    // Where nothing shades, the sky is seen from half of all directions: its coefficient is 2 pi Y_00.
    EXPECT_NEAR(error_of(CloudLightContents::sky_visibility, 1, 0) * std::sqrt(std::numbers::pi), 1,
                1e-6);
}

// Three quarters of the cloud are in one voxel, and as many of the points.
TEST(CloudLight, PointsAreAsDenseAsTheCloud) {
    CloudLayer layer = test::layer_of({5, 3, 4}, 0);
    layer.values[occupancy::index_of(layer.size, 1, 2, 0)] = 0.75F;
    layer.values[occupancy::index_of(layer.size, 4, 0, 3)] = 0.25F;
    const auto truth = cloud_light_truth(layer, bake_of(CloudLightContents::optical_depth), 1);
    constexpr int kPoints = 4000;
    std::array<double, 3> mean{};
    int thick = 0;
    for (int i = 0; i < kPoints; ++i) {
        const auto at = truth.comparison.lookup_place(low_discrepancy_point(i));
        std::array<int, 3> voxel{};
        for (std::size_t a = 0; a < 3; ++a) voxel[a] = static_cast<int>(at[a] * layer.size[a]);
        if (voxel != std::array{1, 2, 0}) {
            EXPECT_EQ(voxel, (std::array{4, 0, 3}));
            continue;
        }
        ++thick;
        for (std::size_t a = 0; a < 3; ++a) mean[a] += at[a] * layer.size[a] - voxel[a];
    }
    EXPECT_NEAR(thick, 0.75 * kPoints, 0.01 * kPoints);
    for (const double sum : mean) EXPECT_NEAR(sum / thick, 0.5, 0.01);
}

TEST(CloudLight, AllDensityIsAroundTheNearestPlace) {
    const CloudLayer layer = test::rough_layer({12, 6, 5});
    const PlaceGrid places = place_grid(layer.size, 2, false);
    std::vector<double> sums(occupancy::count_of(places.count));
    testing::for_each_voxel(layer.size, [&](int x, int y, int z) {
        const glm::dvec3 voxel(x + 0.5, y + 0.5, z + 0.5);
        std::array<int, 3> nearest{};
        for (std::size_t a = 0; a < 3; ++a) {
            const auto distance = [&](int i) {
                const auto at = static_cast<glm::length_t>(a);
                return std::fabs(places.place(i, i, i)[at] - voxel[at]);
            };
            for (int i = 1; i < places.count[a]; ++i) {
                if (distance(i) < distance(nearest[a])) nearest[a] = i;
            }
        }
        sums[occupancy::index_of(places.count, nearest[0], nearest[1], nearest[2])] +=
            double{layer.value(x, y, z)};
    });
    const std::vector<float> found = density_around(layer, places, 2);
    for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_NEAR(found[i], sums[i], 1e-5) << i;
}

// Where texels are fitted, the values to which they are fitted say how right the light itself is.
TEST(CloudLight, TexelErrorsAreThoseOfTheLightBeforeItIsFitted) {
    const CloudLayer layer = test::lone_cloud({16, 16, 8}, {4, 4, 2}, {11, 12, 6});
    const Baked volume =
        baked(layer, bake_of(CloudLightContents::optical_depth, 4), 2, Certification::quick);
    EXPECT_LT(volume.certificate.texel.max, 1e-4);
    EXPECT_GT(volume.certificate.lookup.rms, 0.03);
}

TEST(CloudLight, GivesTheSameHashForAnyNumberOfThreads) {
    const CloudLayer layer = test::rough_layer({24, 16, 8}, 0.3);
    CloudLightBake bake = bake_of(CloudLightContents::sky_visibility, 4);
    EXPECT_EQ(baked(layer, bake, 1).levels.front().content_hash,
              baked(layer, bake, 3).levels.front().content_hash);
}

}  // namespace
}  // namespace skybake::cloud_light
