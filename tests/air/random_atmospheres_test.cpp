// Properties of any atmosphere: 1 to 6 layers of any kind, radii from 10 km to 1e6 km, coefficients
// over 12 decades.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/air/optical_depth-inl.h"
#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "bakers/math/transcendental.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using test::log_uniform;
using test::uniform;

// A coefficient over 12 decades, or none at all.
double coefficient() { return *rc::gen::inRange(0, 6) == 0 ? 0 : log_uniform(1e-9, 1e3); }

Medium random_medium() {
    Medium medium;
    medium.channels = 3;
    medium.ground_radius_km = log_uniform(10, 1e6);
    medium.thickness_km = medium.ground_radius_km * log_uniform(1e-4, 1);
    medium.ground_albedo = {uniform(0, 1), uniform(0, 1), uniform(0, 1), 0};
    const int layers = *rc::gen::inRange(1, 7);
    for (int i = 0; i < layers; ++i) {
        Spectrum scattering{};
        Spectrum extinction{};
        for (std::size_t c = 0; c < 3; ++c) {
            scattering[c] = coefficient();
            extinction[c] = scattering[c] + coefficient();
        }
        const double thickness = medium.thickness_km;
        if (*rc::gen::inRange(0, 2) == 0) {
            medium.exponential_layers.push_back(
                {thickness * log_uniform(1e-4, 10), scattering, extinction});
            continue;
        }
        const double bottom = uniform(0, 0.9) * thickness;
        const double top = bottom + (thickness - bottom) * log_uniform(1e-6, 1);
        const double middle = 0.5 * (bottom + top);
        const double peak = uniform(0, 1);
        const double slope = peak / (middle - bottom);
        medium.piecewise_layers.push_back(
            {{{bottom, middle, 0, peak, slope}, {middle, top, peak, 0, -peak / (top - middle)}},
             scattering,
             extinction});
    }
    return medium;
}

TEST(RandomAtmospheres, TransmittanceIsInRangeAndMonotoneAlongRays) {
    EXPECT_TRUE(rc::check([] {
        const Medium medium = random_medium();
        const Shell shell = shell_of(medium);
        const double altitude = uniform(0, 1) * medium.thickness_km;
        const double r = shell.ground_radius_km + altitude;
        const double rho = horizon_distance_km(shell, altitude);
        const double s = uniform(0, 1) < 0.5 ? uniform(-rho, r) : uniform(-rho, 0);
        const double length = distance_to_top_km(shell, altitude, s);
        Spectrum last{};
        for (const double share : {0.0, 1e-6, 0.1, 0.4, 0.8, 1.0}) {
            const Spectrum tau = optical_depth_along(medium, altitude, s / r, share * length);
            for (std::size_t c = 0; c < 3; ++c) {
                RC_ASSERT(std::isfinite(tau[c]) && tau[c] >= 0);
                const double transmittance = exponential(-tau[c]);
                RC_ASSERT(transmittance >= 0 && transmittance <= 1);
                RC_ASSERT(tau[c] >= last[c] * (1 - 1e-12));
            }
            last = tau;
        }
    }));
}

TEST(RandomAtmospheres, TransmittanceIsMultiplicativeAlongSegments) {
    EXPECT_TRUE(rc::check([] {
        const Medium medium = random_medium();
        const Shell shell = shell_of(medium);
        const double altitude = uniform(0, 1) * medium.thickness_km;
        const double r = shell.ground_radius_km + altitude;
        const double s = uniform(-0.999 * horizon_distance_km(shell, altitude), r);
        const double length = distance_to_top_km(shell, altitude, s);
        const double first = uniform(0.01, 0.99) * length;
        const double middle = altitude_along_km(shell, altitude, s, first);
        RC_PRE(middle >= 0 && middle <= medium.thickness_km);
        const Spectrum whole = optical_depth_to_top(medium, altitude, s);
        const Spectrum before = optical_depth_along(medium, altitude, s / r, first);
        const Spectrum after = optical_depth_to_top(medium, middle, s + first);
        for (std::size_t c = 0; c < 3; ++c) {
            // In transmittance, and relatively where that is not all but zero. The point between is
            // known to about 1e-16 of the planet's radius, which thin layers notice.
            const double product = exponential(-before[c]) * exponential(-after[c]);
            RC_ASSERT(std::fabs(product - exponential(-whole[c])) < 1e-6);
        }
    }));
}

// A double that counts the exponentials it takes.
struct Counted {
    double v = 0;
    static inline long exponentials = 0;
    Counted() = default;
    Counted(double x) : v(x) {}  // NOLINT: as Lanes
};
Counted operator+(Counted a, Counted b) { return a.v + b.v; }
Counted operator-(Counted a, Counted b) { return a.v - b.v; }
Counted operator*(Counted a, Counted b) { return a.v * b.v; }
Counted operator/(Counted a, Counted b) { return a.v / b.v; }
Counted operator-(Counted a) { return -a.v; }
bool operator<(Counted a, Counted b) { return a.v < b.v; }
bool operator>(Counted a, Counted b) { return a.v > b.v; }
Counted square_root(Counted a) { return std::sqrt(a.v); }
Counted minimum(Counted a, Counted b) { return b.v < a.v ? b : a; }
Counted maximum(Counted a, Counted b) { return a.v < b.v ? b : a; }
Counted absolute(Counted a) { return std::fabs(a.v); }
Counted select(bool mask, Counted yes, Counted no) { return mask ? yes : no; }
Counted exponential(Counted a) {
    ++Counted::exponentials;
    return skybake::exponential(a.v);
}
Counted logarithm(Counted a) { return skybake::logarithm(a.v); }

long evaluations(const Medium& medium, double altitude_km, double s_km) {
    Counted::exponentials = 0;
    Counted tau[kMaxChannels];
    HWY_NAMESPACE::optical_depth_to_top(medium, Counted(altitude_km), Counted(s_km), tau);
    return Counted::exponentials;
}

TEST(RandomAtmospheres, TakesNeverMoreThanTwentyTimesEarthsEvaluations) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const long earths = evaluations(earth, 0, 0);
    EXPECT_GT(earths, 50);
    EXPECT_TRUE(rc::check([earths] {
        const Medium medium = random_medium();
        const Shell shell = shell_of(medium);
        const double altitude = uniform(0, 1) * medium.thickness_km;
        const double rho = horizon_distance_km(shell, altitude);
        RC_ASSERT(evaluations(medium, altitude, uniform(-rho, shell.ground_radius_km + altitude)) <=
                  20 * earths);
        RC_ASSERT(evaluations(medium, 0, 0) <= 20 * earths);
    }));
}

TEST(RandomAtmospheres, MultipleScatteringIsFiniteAndPositiveAndOfBoundedCost) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const auto lookups = [](const Medium& medium, const RowQuadrature& row) {
        (void)medium;
        std::size_t sum = 0;
        for (const WeightedRay& ray : row.rays) sum += ray.nodes.size();
        return sum;
    };
    const QuadratureLevel level = quadrature_levels()[2];
    const std::size_t earths =
        lookups(earth, make_row_quadrature(earth, quadrature_altitudes_km(earth), 10, level));
    EXPECT_TRUE(rc::check([&] {
        const Medium medium = random_medium();
        const std::vector<double> altitudes = quadrature_altitudes_km(medium);
        const Sunlight sunlight(medium, altitudes, {64, 32}, 1);
        const RowQuadrature row =
            make_row_quadrature(medium, altitudes, uniform(0, 1) * medium.thickness_km, level);
        RC_ASSERT(lookups(medium, row) <= 20 * earths);
        const double suns[] = {1.0, uniform(-1, 1), 0.0, -1.0};
        double psi[12];
        integrate_row(medium, sunlight, row, suns, 4, psi);
        for (std::size_t i = 0; i < 12; ++i) {
            // A medium so opaque that no light leaves it has no finite Psi; the bake refuses it.
            if (row.escape[i / 4] < 1e-290) continue;
            RC_ASSERT(std::isfinite(psi[i]) && psi[i] >= 0);
        }
        for (std::size_t c = 0; c < 3; ++c)
            RC_ASSERT(row.escape[c] >= 0 && row.escape[c] < 1 + 1e-2);
    }));
}

}  // namespace
}  // namespace skybake
