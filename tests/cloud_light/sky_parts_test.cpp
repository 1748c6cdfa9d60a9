// The light of skies along ordinates: against closed forms and plain sums over many directions.
#include "bakers/assets/cloud_light/sky_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/radiance_sweep.h"

namespace skybake::cloud_light {
namespace {

constexpr double kPi = std::numbers::pi;

// Returns the ordinates of the solver.
std::vector<SkyDirection> ordinates() {
    const LayerCells cells{CellFields({1, 1, 1}, 1), {1, 1, 1}};
    return RadianceSweep(cells, 3, {}).sky_ordinates();
}

// Sums of light over a hemisphere.
struct Sums {
    double fluence = 0;
    double irradiance = 0;  // of a level surface
};

Sums sums_of(const std::vector<double>& radiances, const std::vector<SkyDirection>& directions) {
    Sums sums;
    for (std::size_t n = 0; n < directions.size(); ++n) {
        const double light = radiances[n] * directions[n].solid_angle;
        sums.fluence += light;
        sums.irradiance += light * directions[n].direction.z;
    }
    return sums;
}

// Midpoints of a million parts of the same solid angle.
Sums counted(const SkyByDirection& sky) {
    constexpr int kRings = 1000;
    constexpr int kAround = 1000;
    Sums sums;
    for (int i = 0; i < kRings; ++i) {
        const double up = (i + 0.5) / kRings;
        const double level = std::sqrt(1 - up * up);
        for (int k = 0; k < kAround; ++k) {
            const double azimuth = 2 * kPi * (k + 0.5) / kAround;
            const double light = sky({level * std::cos(azimuth), level * std::sin(azimuth), up}) *
                                 2 * kPi / (double{kRings} * kAround);
            sums.fluence += light;
            sums.irradiance += light * up;
        }
    }
    return sums;
}

// A sky with the light next to the sun that air with haze has, and a bright horizon.
SkyByDirection hazy_sky(const glm::dvec3& sun) {
    return [sun](const glm::dvec3& direction) {
        constexpr double kG = 0.9;
        const double along = glm::dot(direction, sun);
        const double aureole = 1 / std::pow(1 + kG * kG - 2 * kG * along, 1.5);
        return 0.01 * aureole + 0.2 / (direction.z + 0.2);
    };
}

TEST(SkyParts, OfAUniformSkyAreThatSky) {
    for (const double light : {0.0, 1.0}) {
        const std::vector<double> radiances =
            ordinate_radiances([light](const glm::dvec3&) { return light; }, ordinates());
        ASSERT_EQ(radiances.size(), 32U);
        for (const double one : radiances) EXPECT_EQ(static_cast<float>(one), light);
    }
}

TEST(SkyParts, HaveTheLightOfAGradient) {
    const SkyByDirection sky = [](const glm::dvec3& d) { return 1 + 0.6 * d.x - 0.2 * d.y + d.z; };
    const Sums found = sums_of(ordinate_radiances(sky, ordinates()), ordinates());
    EXPECT_NEAR(found.fluence, 2 * kPi * 1.5, 1e-9);
    EXPECT_NEAR(found.irradiance, kPi * (1 + 2.0 / 3), 1e-9);
    EXPECT_NEAR(mean_radiance(sky), 1.5, 1e-12);
}

TEST(SkyParts, HaveTheLightOfHazySkies) {
    for (const double degrees : {1.0, 10.0, 60.0, 90.0}) {
        const SkyByDirection sky = hazy_sky(towards(degrees * kPi / 180, 0.3));
        const Sums wanted = counted(sky);
        const std::vector<double> radiances = ordinate_radiances(sky, ordinates());
        const Sums found = sums_of(radiances, ordinates());
        EXPECT_NEAR(found.fluence, wanted.fluence, 1e-3 * wanted.fluence) << degrees;
        EXPECT_NEAR(found.irradiance, wanted.irradiance, 1e-3 * wanted.irradiance) << degrees;
        EXPECT_NEAR(2 * kPi * mean_radiance(sky), wanted.fluence, 1e-3 * wanted.fluence) << degrees;
        EXPECT_GT(*std::min_element(radiances.begin(), radiances.end()), 0) << degrees;
    }
}

// A single sample at each ordinate would miss most of a bright spot, or see too much of it.
TEST(SkyParts, OfASpotAreInItsPart) {
    const std::vector<SkyDirection> directions = ordinates();
    for (const std::size_t lit : {0U, 13U, 31U}) {
        const SkyByDirection sky = [&](const glm::dvec3& d) {
            return std::exp(2000 * (glm::dot(d, directions[lit].direction) - 1));
        };
        const std::vector<double> radiances = ordinate_radiances(sky, directions);
        for (std::size_t n = 0; n < radiances.size(); ++n) {
            // A spot of the solid angle 2 pi / 2000.
            const double wanted = n == lit ? kPi / 1000 / directions[n].solid_angle : 0;
            EXPECT_NEAR(radiances[n], wanted, 0.02 * kPi / 1000 / directions[n].solid_angle)
                << lit << ' ' << n;
        }
    }
}

}  // namespace
}  // namespace skybake::cloud_light
