// The arithmetic of path_medium.h, each formula once: for one path, or for a vector of paths. Real is
// double or Lanes.
#if defined(SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STEPS_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STEPS_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STEPS_INL_H_
#endif

#include <numbers>

#include "bakers/light/path_tracer/air_shells-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Below this 1 - e^-x and its inverse are taken from their series, since the difference has lost
// twelve bits; the first term left out is below 2^-50 of the sum.
constexpr double kThin = 0x1p-12;

// Returns 1 - e^-x for x >= 0, to all its digits.
HWY_INLINE Channels scattered_share(Channels x, Channels transmittance) {
    const Channels one(1.0);
    const Channels series =
        x * (one - (1.0 / 2) * x * (one - (1.0 / 3) * x * (one - (1.0 / 4) * x)));
    return select(x > Channels(kThin), one - transmittance, series);
}

// Returns -ln(1 - y) for y in [0, 1), likewise.
template <class Real>
HWY_INLINE Real depth_of_share(Real y) {
    const Real series =
        y * (Real(1.0) + y * (Real(1.0 / 2) + y * (Real(1.0 / 3) + y * Real(1.0 / 4))));
    return select(y > Real(kThin), -logarithm(Real(1.0) - y), series);
}

HWY_INLINE Channels zero_unless_positive(Channels numerator, Channels denominator) {
    return select(denominator > Channels(0.0), numerator / denominator, Channels(0.0));
}

// --- Directions ----------------------------------------------------------------------------------

// A direction, or those of a vector of paths, which GLM's vectors do not hold.
template <class Real>
struct Direction {
    Real x, y, z;
};

template <class Real>
HWY_INLINE Real dot(const Direction<Real>& a, const Direction<Real>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// 1 - cos and 1 + cos of an angle.
template <class Real>
struct Angle {
    Real one_minus, one_plus;
};

// Returns the angle between two unit vectors.
template <class Real>
HWY_INLINE Angle<Real> angle_between(const Direction<Real>& a, const Direction<Real>& b) {
    const Direction<Real> apart = {a.x - b.x, a.y - b.y, a.z - b.z};
    const Direction<Real> together = {a.x + b.x, a.y + b.y, a.z + b.z};
    return {Real(0.5) * dot(apart, apart), Real(0.5) * dot(together, together)};
}

// See phase_sampling.h.
template <class Real>
HWY_INLINE Direction<Real> scatter(const Direction<Real>& direction, const Angle<Real>& angle,
                                   Real turn) {
    // An orthonormal basis without a branch on small components: Duff et al. 2017.
    const Real sign = select(direction.z < Real(0.0), Real(-1.0), Real(1.0));
    const Real a = Real(-1.0) / (sign + direction.z);
    const Real b = direction.x * direction.y * a;
    const Direction<Real> first = {Real(1.0) + sign * direction.x * direction.x * a, sign * b,
                                   -sign * direction.x};
    const Direction<Real> second = {b, sign + direction.y * direction.y * a, -direction.y};
    const Real sine = square_root(angle.one_minus * angle.one_plus);
    const Real nu = Real(0.5) * (angle.one_plus - angle.one_minus);
    Real sine_of_turn, cosine_of_turn;
    sine_and_cosine(Real(2 * std::numbers::pi) * turn, sine_of_turn, cosine_of_turn);
    const Real along_first = sine * cosine_of_turn;
    const Real along_second = sine * sine_of_turn;
    const auto sum = [&](Real forward, Real right, Real up) {
        return nu * forward + along_first * right + along_second * up;
    };
    const Direction<Real> result = {sum(direction.x, first.x, second.x),
                                    sum(direction.y, first.y, second.y),
                                    sum(direction.z, first.z, second.z)};
    // Rounding of thousands of scatterings would add up.
    const Real scale = Real(1.0) / square_root(dot(result, result));
    return {scale * result.x, scale * result.y, scale * result.z};
}

// Halley's steps converge cubically: after one below this the root has all its digits. It takes two
// for a = b.
constexpr double kLastStep = 1e-5;
constexpr int kMostSteps = 64;

// Inverts a distribution with the density (a + b nu^2) 2 pi, whose integral is 1, where b > 0: nu +
// c nu^3 = (1 + c) u with c = b / 3 a, by Halley's method for the magnitudes of nu and u, both in
// [0, 1]. It begins at u (1 + c (1 - u^2)), which is exact at both ends and to the first order
// about 0.
template <class Real>
HWY_INLINE Angle<Real> sample_quadratic(double a, double b, Real share) {
    const Real c = Real(b / (3 * a));
    const Real u = absolute(Real(2.0) * share - Real(1.0));
    const Real target = (Real(1.0) + c) * u;
    Real nu = u * (Real(1.0) + c * (Real(1.0) - u * u));
    auto going_on = u >= Real(0.0);
    for (int i = 0; i < kMostSteps && any(going_on); ++i) {
        const Real curved = c * nu;
        const Real error = nu * (Real(1.0) + curved * nu) - target;
        const Real slope = Real(1.0) + Real(3.0) * curved * nu;
        const Real step = error * slope / (slope * slope - Real(3.0) * curved * error);
        nu = select(going_on, nu - step, nu);
        going_on = and_not(going_on, absolute(step) <= Real(kLastStep));
    }
    nu = select(share < Real(0.5), -nu, nu);
    return {Real(1.0) - nu, Real(1.0) + nu};
}

// --- Lines ---------------------------------------------------------------------------------------

// The line of a flight. A line that falls has a lowest point, or one where it meets the ground;
// other lines begin at their lowest point. `lowest_s` is |r mu| there.
template <class Real>
struct FlightLine {
    Real s_km;  // r mu at its start
    Real lowest_altitude_km;
    Real lowest_s_km;
    decltype(Real() < Real()) falls;
    decltype(Real() < Real()) hits_ground;
};

template <class Real>
HWY_INLINE FlightLine<Real> flight_line(const Shell& planet, Real altitude_km,
                                        const Direction<Real>& up,
                                        const Direction<Real>& direction) {
    const Real zero = Real(0.0);
    const Real r = Real(planet.ground_radius_km) + altitude_km;
    FlightLine<Real> line;
    const Real s = r * dot(up, direction);
    const Real horizon =
        square_root(altitude_km * (Real(2 * planet.ground_radius_km) + altitude_km));
    line.s_km = s;
    line.falls = s < zero;
    line.hits_ground = s < -horizon;
    const Real drop = s * s / (r + square_root((r - s) * (r + s)));  // to where s = 0
    const Real lowest = select(line.hits_ground, zero, maximum(altitude_km - drop, zero));
    const Real ground_square = (-s - horizon) * (horizon - s);
    const Real ground_s = square_root(select(line.hits_ground, ground_square, zero));
    line.lowest_altitude_km = select(line.falls, lowest, altitude_km);
    line.lowest_s_km = select(line.falls, ground_s, s);
    return line;
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STEPS_INL_H_
