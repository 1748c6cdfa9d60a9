#include "bakers/render/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/math/vectors.h"
#include "config/text/moment.h"
#include "tests/support/number_rows.h"

namespace skybake {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAccuracy_degrees = 0.01;  // as the header states it

glm::dvec3 direction(const SunPosition& sun) {
    const double elevation = sun.elevation_degrees * kDegree;
    const double azimuth = sun.azimuth_degrees * kDegree;
    return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
            std::sin(elevation)};
}

// The angle between two directions in degrees, without cancellation.
double degrees_between(const SunPosition& a, const SunPosition& b) {
    const glm::dvec3 apart = direction(a) - direction(b);
    return 2 * std::asin(0.5 * std::sqrt(glm::dot(apart, apart))) / kDegree;
}

SunPosition sun_at(const char* time, const EarthPlace& place) {
    const auto moment = config::parse_moment(time);
    EXPECT_TRUE(moment) << time;
    return sun_position(config::utc_seconds(*moment, place.longitude_degrees), place);
}

// Reda and Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications", table A5.1:
// the topocentric elevation without refraction. The zenith angle of 50.11162 degrees there is that
// of refracted light, 0.01633 degrees less.
TEST(SunPosition, IsThatOfRedaAndAndreas) {
    const SunPosition sun = sun_at("2003-10-17 12:30:30 -07:00", {39.742476, -105.1786});
    const SunPosition published = {39.872046, 194.340241};
    EXPECT_LT(degrees_between(sun, published), kAccuracy_degrees);
    const SunPosition refracted = {90 - 50.11162, 194.340241};
    EXPECT_GT(degrees_between(sun, refracted), kAccuracy_degrees);
}

// Meeus, "Astronomical Algorithms", example 25.b: the apparent right ascension and declination on
// 1992 October 13 at 0 h of terrestrial time by the complete theory, seen from the pole, where the
// elevation is the declination but for the parallax.
TEST(SunPosition, IsThatOfMeeus) {
    const double declination = -7.783871;
    const double parallax = 8.794 / 3600 * std::cos(declination * kDegree);
    const auto midnight = config::parse_moment("1992-10-13 00:00Z");
    const SunPosition sun = sun_position(midnight->clock_seconds - 69, {90, 0});
    EXPECT_NEAR(sun.elevation_degrees, declination - parallax, kAccuracy_degrees);
}

// Equinoxes and solstices of 2026 (United States Naval Observatory), to the minute.
TEST(SunPosition, CrossesTheEquatorAtTheEquinoxesAndTurnsAtTheSolstices) {
    const EarthPlace pole{90, 0};
    const double parallax = 8.794 / 3600;
    EXPECT_NEAR(sun_at("2026-03-20 14:46Z", pole).elevation_degrees + parallax, 0,
                kAccuracy_degrees);
    EXPECT_NEAR(sun_at("2026-09-23 00:05Z", pole).elevation_degrees + parallax, 0,
                kAccuracy_degrees);
    const double summer = sun_at("2026-06-21 08:24Z", pole).elevation_degrees;
    EXPECT_NEAR(summer, 23.436, kAccuracy_degrees);
    EXPECT_LT(sun_at("2026-06-11 08:24Z", pole).elevation_degrees, summer - 0.1);
    EXPECT_LT(sun_at("2026-07-01 08:24Z", pole).elevation_degrees, summer - 0.1);
    EXPECT_NEAR(sun_at("2026-12-21 20:50Z", {-90, 0}).elevation_degrees, 23.436, kAccuracy_degrees);
}

// Mean solar noon is solar noon but for the equation of time, which is 0 on April 15.
TEST(SunPosition, IsInTheSouthAtMeanSolarNoonOfTheNorth) {
    for (const double longitude : {-170.0, -60.0, 0.0, 8.5, 139.7}) {
        EXPECT_NEAR(sun_at("2026-04-15 12:00", {47.4, longitude}).azimuth_degrees, 180, 0.3);
        EXPECT_NEAR(
            std::remainder(sun_at("2026-04-15 12:00", {-47.4, longitude}).azimuth_degrees, 360.0),
            0, 0.3);
        EXPECT_LT(sun_at("2026-04-15 06:30", {47.4, longitude}).azimuth_degrees, 95);
    }
}

// data/sun_positions.csv says how its positions were computed.
TEST(SunPosition, IsThatOfAnotherProgramAtAnyTimeAndPlace) {
    const auto rows = test::number_rows(SKYBAKE_TEST_DATA "/sun_positions.csv");
    ASSERT_EQ(rows.size(), 120U);
    double sum = 0;
    for (const std::vector<double>& v : rows) {
        ASSERT_EQ(v.size(), 5U);
        const double error = degrees_between(sun_position(v[0], {v[1], v[2]}), {v[3], v[4]});
        EXPECT_LT(error, kAccuracy_degrees) << v[0];
        sum += error * error / 120;
    }
    EXPECT_LT(std::sqrt(sum), 0.0035);  // 0.0031 is measured
}

TEST(SunPosition, IsFiniteAtThePolesAndTheZenith) {
    for (const EarthPlace& place : {EarthPlace{90, 0}, EarthPlace{-90, 180}, EarthPlace{0, -180}}) {
        const SunPosition sun = sun_at("2026-06-21 12:00Z", place);
        EXPECT_TRUE(std::isfinite(sun.elevation_degrees));
        EXPECT_GE(sun.azimuth_degrees, 0);
        EXPECT_LT(sun.azimuth_degrees, 360);
    }
}

}  // namespace
}  // namespace skybake
