// Where the sun stands over a place on the Earth.
//
// The sun's apparent longitude and distance follow Meeus, "Astronomical Algorithms" (2nd edition,
// 1998), chapter 25: a mean longitude L0, a mean anomaly M and an eccentricity that are polynomials
// in the time T in Julian centuries of terrestrial time from J2000, the equation of the centre, and
// aberration. Nutation follows chapter 22 in its four largest terms, sidereal time chapter 12, and
// the sun's parallax is taken off at the end. The perturbations by the planets and the moon are left
// out, which is what limits the accuracy: 0.01 degrees from 1900 to 2100, a fiftieth of the sun's
// width.
//
// Terrestrial time is taken to be 69 s ahead of UTC, as it was in 2020. Between 1900 and 2100 it is
// off by up to 150 s, in which the sun moves along the ecliptic by 0.002 degrees.
//
// Elevations are those of straight rays, without refraction, because the rays of all other light
// here are straight too. Refraction would raise a sun at the horizon by half a degree.
//
// Hard cases: the poles, where a longitude has no meaning but azimuths follow it; the sun at the
// zenith, where the azimuth has none; midnight suns; times before 1970.
#pragma once

namespace skybake {

// Latitudes are geodetic and positive in the north, longitudes are positive in the east.
struct EarthPlace {
    double latitude_degrees = 0;
    double longitude_degrees = 0;
    bool operator==(const EarthPlace&) const = default;
};

struct SunPosition {
    double elevation_degrees = 0;
    double azimuth_degrees = 0;  // from north towards east, in [0, 360)
};

// `utc_seconds` are counted from 1970-01-01 00:00 UTC, without leap seconds.
SunPosition sun_position(double utc_seconds, const EarthPlace& place);

}  // namespace skybake
