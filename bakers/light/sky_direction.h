// A view direction and where the sun is from it.
#pragma once

namespace skybake {

// A direction at a camera, and the angle to the sun by two sums without cancellation.
struct SkyDirection {
    double mu = 0;  // cosine of the zenith angle
    double cosine_to_sun = 0;
    double one_minus_cosine = 0;
    double one_plus_cosine = 0;
};

// A sun by the cosine and the sine of its zenith angle, both exact at the horizon and the zenith.
struct SunZenith {
    double cosine = 0;
    double sine = 0;  // not negative
};

// From the cosine and sine of the direction's zenith angle and the cosine of its azimuth from the
// sun.
inline SkyDirection sky_direction(const SunZenith& sun, double mu, double sine,
                                  double azimuth_cosine) {
    // Both vectors in the plane of the sun, z up: 1 -+ cos = |a -+ b|^2 / 2.
    const double along = sine * azimuth_cosine;
    const double across_squared = sine * sine * (1 - azimuth_cosine) * (1 + azimuth_cosine);
    const auto half_square = [&](double up, double forward) {
        return 0.5 * (up * up + forward * forward + across_squared);
    };
    SkyDirection direction;
    direction.mu = mu;
    direction.cosine_to_sun = mu * sun.cosine + along * sun.sine;
    direction.one_minus_cosine = half_square(mu - sun.cosine, along - sun.sine);
    direction.one_plus_cosine = half_square(mu + sun.cosine, along + sun.sine);
    return direction;
}

}  // namespace skybake
