// The solver and paths of light in plane-parallel air, against doubling with 64 nodes, which is held
// to values that others published: the test problems of DISORT (Stamnes et al. 1988), whose values
// are those of Sweigart 1970, of van de Hulst 1980, and of Garcia & Siewert 1985. The air is a slab
// 100 m high on a planet with a radius of a million km over black ground.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/path_tracer/path_media.h"
#include "tests/published/published_slabs.h"
#include "tests/published/slab.h"

namespace skybake::test {
namespace {

config::Atmosphere atmosphere_of(const Slab& slab) {
    return slab_atmosphere(slab.depth, slab.albedo, slab.phase);
}

struct ViewOfSlab {
    SlabView view;
    double cosine;  // to the vertical
    bool is_up;
    double published;
    double radiance;  // by doubling
};

// All published values, in the sun's azimuth.
std::vector<ViewOfSlab> views_of(const Slab& slab) {
    const DoubledSlab exact = doubled(slab);
    std::vector<ViewOfSlab> views;
    for (std::size_t i = 0; i < slab.cosines.size(); ++i) {
        for (const bool is_up : {true, false}) {
            const SunZenith sun = slab_sun(slab.sun_cosine);
            views.push_back({slab_view(sun, slab.cosines[i], is_up), slab.cosines[i], is_up,
                             is_up ? slab.up[i] : slab.down[i], exact.leaving(i, is_up, 1)});
        }
    }
    return views;
}

// The radiance of a slab's light, by the solver.
double solved_radiance(const SkyLight& light, const Slab& slab, const SlabView& view) {
    const SkyRadiance found =
        light.integrator().radiance(view.altitude_km, slab_sun(slab.sun_cosine), view.direction);
    return slab.beam * (found.single[0] + found.multiple[0]);
}

// The same with the ray cut into a hundred pieces.
double finely_cut_radiance(const SkyLight& light, const Slab& slab, const SlabView& view) {
    const SkyRay ray =
        sky_ray(light.shell(), view.altitude_km, slab_sun(slab.sun_cosine), view.direction);
    std::vector<double> ends_km;
    for (int i = 1; i < 100; ++i) ends_km.push_back(ray.length_km * i / 100);
    ends_km.push_back(ray.length_km);
    const SkyRadiance found = light.integrator().up_to(ray, ends_km).back();
    return slab.beam * (found.single[0] + found.multiple[0]);
}

// Radiance and standard error, by paths.
struct TracedRadiance {
    double radiance;
    double standard_error;
};

TracedRadiance traced_radiance(const PathMedium& path_medium, const Slab& slab,
                               const SlabView& view, std::int64_t count, std::uint32_t ray) {
    PathTracerSettings settings = paths(count, ray);
    settings.include_seen_ground = false;
    const PathTracedRadiance found = trace_paths(
        path_medium, view.altitude_km, slab_sun(slab.sun_cosine), view.direction, settings, 2);
    return {slab.beam * found.radiance[0], slab.beam * found.standard_error[0]};
}

TEST(PlaneParallel, DoublingFindsThePublishedRadiance) {
    for (const Slab& slab : slabs()) {
        double worst = 0;
        for (const ViewOfSlab& at : views_of(slab)) {
            worst = std::max(worst, std::fabs(at.published / at.radiance - 1));
        }
        fmt::print("{}: published values are within {:.2e}\n", slab.name, worst);
        EXPECT_LT(worst, slab.published_bound) << slab.name;
    }
}

void expect_solver_as_used(const Slab& slab) {
    const SkyLight light(atmosphere_of(slab), config::SkyOrders::all, {}, {.threads = 2});
    EXPECT_FALSE(light.problem("sky"));
    double worst = 0;
    for (const ViewOfSlab& at : views_of(slab)) {
        worst = std::max(worst, std::fabs(solved_radiance(light, slab, at.view) / at.radiance - 1));
    }
    fmt::print("{}: solver {:.2e}\n", slab.name, worst);
    EXPECT_LT(worst, slab.default_bound) << slab.name;
}

TEST(PlaneParallel, SolverAsItIsUsed) {
    for (const char* name : {"1a", "1b", "2a", "2b", "3a", "1e", "2c", "2d"}) {
        expect_solver_as_used(slab_named(name));
    }
}

// The error that is left at the default settings falls with the altitudes at which light is solved for, with
// the columns of sunlight, with the degree of moments for peaked phase functions, and with the pieces
// in which rays to the eye are cut, since light rises steeply behind the slab's surfaces: a grazing
// ray that leaves thick air at its bottom sees little more than the space between two altitudes.
struct FinerCase {
    const char* name;
    double bound;
    double level_scale = 2;
    int degree = 8;
    int degree_of_all_orders = 8;
    int suns = 48;
    int zenith_nodes = 8;
};

void expect_finer_solver(const FinerCase& of) {
    const Slab& slab = slab_named(of.name);
    SolverSettings settings;
    settings.degree = of.degree;
    settings.degree_of_all_orders = of.degree_of_all_orders;
    settings.suns = of.suns;
    settings.zenith_nodes = of.zenith_nodes;
    settings.first_zenith_nodes = of.zenith_nodes;
    settings.level_scale = of.level_scale;
    settings.sunlight.columns = 1024;
    settings.tolerance = 1e-5;
    const SkyMedium medium = make_sky_medium(atmosphere_of(slab));
    const SolvedLight solved = solve_light(medium, settings, 2);
    const SkyLight light(medium, config::SkyOrders::all,
                         std::make_unique<SolvedOrders>(medium, solved, settings.degree));
    double worst = 0;
    for (const ViewOfSlab& at : views_of(slab)) {
        worst =
            std::max(worst, std::fabs(finely_cut_radiance(light, slab, at.view) / at.radiance - 1));
    }
    fmt::print("{}: finer solver {:.2e}\n", slab.name, worst);
    EXPECT_LT(worst, of.bound) << slab.name;
}

TEST(PlaneParallel, FinerSolver) {
    for (const FinerCase& of : {FinerCase{"1a", 5e-5}, FinerCase{"1b", 2e-4}, FinerCase{"2a", 2e-4},
                                FinerCase{"2b", 3e-4}}) {
        expect_finer_solver(of);
    }
}

TEST(SlowPlaneParallel, FinerSolverInThickAir) {
    for (const FinerCase& of : {FinerCase{"2c", 3e-4, 3}, FinerCase{"2d", 3e-4, 3}}) {
        expect_finer_solver(of);
    }
}

TEST(SlowPlaneParallel, FinerSolverInThickestAir) { expect_finer_solver({"1e", 1e-3, 3}); }

TEST(SlowPlaneParallel, FinerSolverOfPeakedScattering) {
    expect_finer_solver({"3a", 1e-3, 2, 24, 16, 96, 24});
}

TEST(PlaneParallel, PathsFindTheRadiance) {
    for (const Slab& slab : slabs()) {
        if (slab.depth > 5) continue;
        const SkyMedium medium = make_sky_medium(atmosphere_of(slab));
        const PathMedium path_medium(medium);
        std::uint32_t ray = 0;
        for (const ViewOfSlab& at : views_of(slab)) {
            const TracedRadiance found =
                traced_radiance(path_medium, slab, at.view, slab.depth > 1 ? 8192 : 32768, ++ray);
            EXPECT_NEAR(found.radiance, at.radiance,
                        1e-4 * at.radiance + kFourDeviations * found.standard_error)
                << slab.name << ' ' << at.cosine << ' ' << at.is_up;
        }
    }
}

// Scalar Rayleigh scattering without absorption, depth 0.5, the sun's cosine 0.2, as published for
// doubling with 64 nodes: radiance for a beam of pi, at azimuths of 0, 90 and 180 degrees from the
// sun.
struct RayleighValue {
    std::size_t cosine;  // of kRayleighCosines
    double azimuth_cosine;
    double up;
    double down;
};
constexpr std::array kRayleighCosines = {0.10, 0.52, 1.0};
constexpr RayleighValue kRayleighValues[] = {
    {0, 1, 0.331399, 0.118957}, {0, 0, 0.212722, 0.088377}, {0, -1, 0.341342, 0.116600},
    {1, 1, 0.127755, 0.112444}, {1, 0, 0.099560, 0.079821}, {1, -1, 0.145839, 0.099708},
    {2, 1, 0.058358, 0.051855}};

TEST(PlaneParallel, RayleighScatteringAgreesWithThePublishedTable) {
    const Slab slab = {"Rayleigh", kRayleigh,        {1, 0, 0.1}, 0.5, 1, 0.2,
                       kPi,        kRayleighCosines, {},          {},  0, 0};
    const DoubledSlab exact = doubled(slab);
    const SkyMedium medium = make_sky_medium(atmosphere_of(slab));
    const PathMedium path_medium(medium);
    SolverSettings settings;
    settings.degree = 8;
    settings.level_scale = 2;
    const SolvedLight solved = solve_light(medium, settings, 2);
    const SkyLight light(medium, config::SkyOrders::all,
                         std::make_unique<SolvedOrders>(medium, solved, settings.degree));
    double worst = 0;
    double as_used = 0;
    std::uint32_t ray = 200;
    for (const RayleighValue& value : kRayleighValues) {
        for (const bool is_up : {true, false}) {
            const double expected = is_up ? value.up : value.down;
            EXPECT_NEAR(exact.leaving(value.cosine, is_up, value.azimuth_cosine), expected, 1.1e-6);
            const SlabView view =
                slab_view(slab_sun(slab.sun_cosine), kRayleighCosines[value.cosine], is_up,
                          value.azimuth_cosine);
            const TracedRadiance traced = traced_radiance(path_medium, slab, view, 65536, ++ray);
            EXPECT_NEAR(traced.radiance, expected,
                        1e-4 * expected + kFourDeviations * traced.standard_error)
                << kRayleighCosines[value.cosine] << ' ' << value.azimuth_cosine;
            worst =
                std::max(worst, std::fabs(finely_cut_radiance(light, slab, view) / expected - 1));
            as_used =
                std::max(as_used, std::fabs(solved_radiance(light, slab, view) / expected - 1));
        }
    }
    fmt::print("Rayleigh: solver {:.2e}, with rays cut as usual {:.2e}\n", worst, as_used);
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(as_used, 5e-4);
}

}  // namespace
}  // namespace skybake::test
