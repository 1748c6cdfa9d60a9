#include "bakers/render/sun_position.h"

#include <cmath>
#include <numbers>

#include "bakers/math/vectors.h"

namespace skybake {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTerrestrialAhead_s = 69;
constexpr double kUnixEpoch = 2440587.5;            // Julian days
constexpr double kJ2000 = 2451545.0;                // Julian days
constexpr double kParallax_degrees = 8.794 / 3600;  // of the sun at a distance of 1 au

double sine(double degrees) { return std::sin(degrees * kDegree); }
double cosine(double degrees) { return std::cos(degrees * kDegree); }

struct Nutation {
    double longitude_degrees = 0;
    double obliquity_degrees = 0;
};

// Chapter 22, in the short form with an accuracy of 0.5 and 0.1 arc seconds.
Nutation nutation(double t) {
    const double node = 125.04452 - 1934.136261 * t;
    const double sun = 280.4665 + 36000.7698 * t;
    const double moon = 218.3165 + 481267.8813 * t;
    return {(-17.20 * sine(node) - 1.32 * sine(2 * sun) - 0.23 * sine(2 * moon) +
             0.21 * sine(2 * node)) /
                3600,
            (9.20 * cosine(node) + 0.57 * cosine(2 * sun) + 0.10 * cosine(2 * moon) -
             0.09 * cosine(2 * node)) /
                3600};
}

struct ApparentSun {
    double longitude_degrees = 0;  // apparent, on the ecliptic of date
    double distance_au = 1;
};

// Chapter 25, in the form of low accuracy.
ApparentSun apparent_sun(double t, const Nutation& shift) {
    const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
    const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
    const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sine(anomaly) +
                          (0.019993 - t * 0.000101) * sine(2 * anomaly) +
                          0.000289 * sine(3 * anomaly);
    ApparentSun sun;
    sun.distance_au = 1.000001018 * (1 - eccentricity * eccentricity) /
                      (1 + eccentricity * cosine(anomaly + centre));
    const double aberration = -20.4898 / 3600 / sun.distance_au;
    sun.longitude_degrees = mean_longitude + centre + shift.longitude_degrees + aberration;
    return sun;
}

}  // namespace

SunPosition sun_position(double utc_seconds, const EarthPlace& place) {
    const double days = utc_seconds / 86400 + (kUnixEpoch - kJ2000);  // from J2000, of UTC
    const double t = (days + kTerrestrialAhead_s / 86400) / 36525;
    const Nutation shift = nutation(t);
    const ApparentSun sun = apparent_sun(t, shift);
    const double obliquity =
        23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.036e-7)) + shift.obliquity_degrees;

    // The sun's direction in the equator's coordinates: x towards the equinox, z towards the pole.
    const double longitude = sun.longitude_degrees;
    const glm::dvec3 of_equator(cosine(longitude), sine(longitude) * cosine(obliquity),
                                sine(longitude) * sine(obliquity));
    const double sidereal = 280.46061837 + 360.98564736629 * days +
                            shift.longitude_degrees * cosine(obliquity) + place.longitude_degrees;
    // The same, turned so that x lies in the meridian of the place and y points to its east.
    const glm::dvec3 of_meridian(of_equator.x * cosine(sidereal) + of_equator.y * sine(sidereal),
                                 of_equator.y * cosine(sidereal) - of_equator.x * sine(sidereal),
                                 of_equator.z);
    const double latitude = place.latitude_degrees;
    const double north = of_meridian.z * cosine(latitude) - of_meridian.x * sine(latitude);
    // From the surface, which is an Earth's radius above the centre, the sun stands lower.
    const double up = of_meridian.z * sine(latitude) + of_meridian.x * cosine(latitude) -
                      kParallax_degrees * kDegree / sun.distance_au;
    const double east = of_meridian.y;
    const double azimuth = std::atan2(east, north) / kDegree;
    return {std::atan2(up, std::hypot(east, north)) / kDegree,
            azimuth < 0 ? azimuth + 360 : azimuth};
}

}  // namespace skybake
