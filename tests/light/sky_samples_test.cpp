// The directions in which assets are compared with paths of light.
#include "bakers/assets/sky/sky_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skybake::test {
namespace {

constexpr Shell kEarth = {6360, 100};

// The angle to the sun of each direction is that of its coordinates, by vectors.
TEST(SkySamples, AreWhatTheirCoordinatesSay) {
    for (const double altitude_km : {0.0, 0.5, 40.0, 400.0}) {
        const double dip =
            std::acos(kEarth.ground_radius_km / (kEarth.ground_radius_km + altitude_km));
        for (const double sun_deg : {90.0, 37.0, 0.2, -5.0}) {
            for (const SkySample& at : sky_samples(kEarth, altitude_km, sun_deg)) {
                const double elevation = at.above_horizon_deg / kDegreesPerRadian - dip;
                const double sun = sun_deg / kDegreesPerRadian;
                const double azimuth = at.azimuth_deg / kDegreesPerRadian;
                EXPECT_NEAR(at.direction.mu, std::sin(elevation), 1e-9);
                EXPECT_NEAR(at.direction.cosine_to_sun,
                            std::sin(elevation) * std::sin(sun) +
                                std::cos(elevation) * std::cos(sun) * std::cos(azimuth),
                            1e-9);
                EXPECT_GE(std::fabs(at.above_horizon_deg), kHorizonMargin * kDegreesPerRadian);
                EXPECT_TRUE(at.azimuth_deg >= 0 && at.azimuth_deg <= 180);
            }
        }
    }
}

// Some look at the ground, some next to the horizon, and some within three degrees of the sun.
TEST(SkySamples, LieWhereSkiesAreWeakest) {
    for (const double sun_deg : {90.0, 88.5, 45.0, 1.0}) {
        const std::vector<SkySample> samples = sky_samples(kEarth, 0.5, sun_deg);
        EXPECT_EQ(samples.size(), 70u) << sun_deg;
        const auto count = [&](const auto& is) {
            return std::count_if(samples.begin(), samples.end(), is);
        };
        EXPECT_EQ(count([](const SkySample& at) { return at.above_horizon_deg < 0; }), 6);
        EXPECT_GE(count([](const SkySample& at) {
                      return at.above_horizon_deg > 0 && at.above_horizon_deg < 1.5;
                  }),
                  10);
        const double near = std::cos(4.0 / kDegreesPerRadian);
        EXPECT_GE(count([=](const SkySample& at) { return at.direction.cosine_to_sun > near; }), 4)
            << sun_deg;
    }
}

// Cameras and suns that share a list of directions take different ones, and each all in turn.
TEST(SkySamples, AStrideTakesAllDirectionsInTurn) {
    const std::vector<double> suns = {60, 60, 60};
    const std::vector<SkySample> samples = sky_samples(kEarth, {0.5}, suns, 3);
    EXPECT_EQ(samples.size(), sky_samples(kEarth, 0.5, 60).size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_FALSE(samples[i].above_horizon_deg == samples[k].above_horizon_deg &&
                         samples[i].azimuth_deg == samples[k].azimuth_deg);
        }
    }
}

// Suns over level surfaces reach from the zenith into twilight, at several altitudes.
TEST(SkySamples, LevelSurfacesSeeAllSuns) {
    const std::vector<LevelSample> samples = level_samples(kEarth);
    EXPECT_EQ(samples.size(), 42u);
    const auto [lowest, highest] = std::minmax_element(
        samples.begin(), samples.end(), [](const LevelSample& a, const LevelSample& b) {
            return a.sun_elevation_deg < b.sun_elevation_deg;
        });
    EXPECT_LT(lowest->sun_elevation_deg, -4);
    EXPECT_GT(highest->sun_elevation_deg, 85);
    EXPECT_LE(highest->sun_elevation_deg, 90);
    for (const LevelSample& at : samples) {
        EXPECT_NEAR(at.sun.cosine, std::sin(at.sun_elevation_deg / kDegreesPerRadian), 1e-12);
    }
}

}  // namespace
}  // namespace skybake::test
