// The cases in which atmospheric integrals go wrong, each held against something that cannot:
// 113-bit arithmetic from the definition, a closed form, or an identity.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/baked.h"
#include "bakers/field/interpolation.h"
#include "tests/support/bakes.h"
#include "tests/support/hard_case.h"
#include "tests/support/referee.h"

namespace skybake {
namespace {

using test::hold;
using test::Quad;

Medium one_layer(double ground_km, double thickness_km) {
    Medium medium;
    medium.channels = 3;
    medium.ground_radius_km = ground_km;
    medium.thickness_km = thickness_km;
    return medium;
}

Medium with_exponential(double ground_km, double thickness_km, double scale_height_km,
                        double extinction_per_km = 1) {
    Medium medium = one_layer(ground_km, thickness_km);
    const Spectrum extinction = {extinction_per_km, extinction_per_km, extinction_per_km, 0};
    medium.exponential_layers.push_back({scale_height_km, extinction, extinction});
    return medium;
}

Medium with_slab(double ground_km, double thickness_km, double bottom_km, double top_km,
                 double extinction_per_km) {
    Medium medium = one_layer(ground_km, thickness_km);
    const Spectrum extinction = {extinction_per_km, extinction_per_km, extinction_per_km, 0};
    medium.piecewise_layers.push_back({{{bottom_km, top_km, 1, 1, 0}}, extinction, extinction});
    return medium;
}

// The largest relative error over rays from some altitudes, mu from the horizon (or 0) to 1.
double worst_over_rays(const Medium& medium, std::initializer_list<double> altitudes_km,
                       int count = 24) {
    double worst = 0;
    for (const double h : altitudes_km) {
        const double r = medium.ground_radius_km + h;
        // A hair above the horizon: in 113 bits the rounded horizon itself passes under the ground.
        const double rho = horizon_distance_km(shell_of(medium), h) * (1 - 1e-9);
        for (int i = 0; i <= count; ++i) {
            const double t = static_cast<double>(i) / count;
            // Crowded about the horizontal.
            const double s = std::min(r, -rho + (r + rho) * t * t * t);
            worst = std::max(
                worst, test::relative_difference(optical_depth_to_top(medium, h, s),
                                                 test::referee_optical_depth_to_top(medium, h, s)));
        }
    }
    return worst;
}

void hold_to_referee(const std::string& name, double worst, double bound) {
    hold(name, "113-bit quadrature, relative", worst, bound);
}

TEST(TransmittanceHardCase, Case01TentOzone) {
    Medium tent = one_layer(6360, 100);
    tent.piecewise_layers.push_back(
        {{{10, 25, 0, 1, 1.0 / 15}, {25, 40, 1, 0, -1.0 / 15}}, {1, 1, 1, 0}, {1, 1, 1, 0}});
    hold_to_referee("1 tent ozone, kinks at any angle",
                    worst_over_rays(tent, {0.0, 5.0, 10.0, 17.0, 25.0, 33.0, 39.9, 60.0}), 1e-11);
    // The vertical in closed form: half the base.
    hold("1 tent ozone, straight up", "closed form 15 km",
         std::fabs(optical_depth_to_top(tent, 0, 6360)[0] - 15), 1e-13);
}

TEST(TransmittanceHardCase, Case02GrazingExponential) {
    double worst = 0;
    for (const double scale_height : {8.0, 1.2, 0.1}) {
        worst = std::max(worst, worst_over_rays(with_exponential(6360, 100, scale_height),
                                                {0.0, 0.001, 1.0, 12.0}));
    }
    hold_to_referee("2 exponential layers at grazing angles", worst, 1e-11);
    const Medium rayleigh = with_exponential(6360, 60, 8);
    hold("2 horizontal ray, 6360 to 6420 km, H 8 km", "282.807663541508 km (physics)",
         std::fabs(optical_depth_to_top(rayleigh, 0, 0)[0] - 282.807663541508), 1e-11);
}

TEST(TransmittanceHardCase, Case03CancellationAtPlanetRadius) {
    // Centimetres above a planet of a million kilometres, and altitudes back along the ray.
    double worst = 0;
    for (const double ground : {10.0, 6360.0, 1e6}) {
        const Shell shell = {ground, 100};
        for (const double h : {1e-8, 1e-5, 0.01, 1.0}) {
            for (const double mu : {1.0, 1e-3, 0.0, -1e-6}) {
                for (const double x : {1e-7, 1e-3, 1.0, 50.0}) {
                    const double s = (ground + h) * mu;
                    const Quad r = Quad(ground) + h;
                    const Quad exact =
                        sqrt(r * r + Quad(x) * (Quad(x) + 2 * Quad(s))) - Quad(ground);
                    const double altitude = altitude_along_km(shell, h, s, x);
                    // Errors are relative to the altitude or, going down, to the drop.
                    const double scale = std::max(h, std::fabs(static_cast<double>(exact)));
                    worst = std::max(
                        worst, std::fabs(static_cast<double>(Quad(altitude) - exact)) / scale);
                }
            }
        }
    }
    hold("3 altitude along a ray, R to 1e6 km, h from 10 um", "113-bit, relative", worst, 1e-14);
    hold_to_referee("3 optical depth at R = 1e6 km, h from 1 mm",
                    worst_over_rays(with_exponential(1e6, 100, 8), {1e-6, 1e-3, 1.0}), 1e-11);
}

TEST(TransmittanceHardCase, Case04HorizonZenithAndTop) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const Shell shell = shell_of(earth);
    // Across the horizontal, where the form of the integral changes, from both sides.
    double seam = 0;
    for (const double h : {0.5, 10.0, 99.0}) {
        const Spectrum above = optical_depth_to_top(earth, h, 1e-9);
        const Spectrum below = optical_depth_to_top(earth, h, -1e-9);
        for (std::size_t c = 0; c < 3; ++c)
            seam = std::max(seam, std::fabs(above[c] / below[c] - 1));
    }
    hold("4 continuity at mu = +-0", "its own limit, relative", seam, 1e-10);
    // Every texel of the last column and of the top row, odd and even sizes.
    double out_of_range = 0;
    for (const int size : {1, 2, 3, 64, 65}) {
        for (int i = 0; i < size; ++i) {
            const double x = size == 1 ? 0.5 : static_cast<double>(i) / (size - 1);
            for (const UnitCoordinates at : {UnitCoordinates{1, x}, UnitCoordinates{x, 1},
                                             UnitCoordinates{0, x}, UnitCoordinates{x, 0}}) {
                const TransmittanceRay ray = transmittance_ray(shell, at);
                const Spectrum tau = optical_depth_to_top(earth, ray.altitude_km, ray.s_km);
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    if (!(tau[c] >= 0 && std::isfinite(tau[c]))) out_of_range = 1;
                }
            }
        }
    }
    hold("4 every edge of the table, sizes 1 to 65", "finite and not negative (count)",
         out_of_range, 0);
    const Spectrum top = optical_depth_to_top(earth, 100, 6460);
    hold("4 r at the top, straight up", "exactly 0", top[0] + top[1] + top[2], 0);
}

TEST(TransmittanceHardCase, Case05SegmentsInDenseAir) {
    // Where a ratio of table values would be 0 / 0: segments of 50x air near the ground.
    const Medium dense = test::preset_medium("dense_earth");
    double worst = 0;
    for (const double mu : {1.0, 0.1, 0.0, -0.01}) {
        for (const double length : {1e-6, 1e-3, 1.0, 30.0}) {
            const double altitude = 1.5;
            worst = std::max(worst,
                             test::relative_difference(
                                 optical_depth_along(dense, altitude, mu, length),
                                 test::referee_optical_depth(
                                     dense, altitude, Quad((6360 + altitude)) * Quad(mu), length)));
        }
    }
    hold_to_referee("5 segments of 1 mm to 30 km in 50x air", worst, 1e-9);
}

TEST(TransmittanceHardCase, Case09NoLayersNoThickness) {
    const Medium vacuum = test::preset_medium("vacuum");
    double sum = 0;
    for (const double s : {0.0, 100.0, 6360.0}) {
        const Spectrum tau = optical_depth_to_top(vacuum, 0, s);
        sum += tau.x + tau.y + tau.z;
    }
    hold("9 no layers at all", "exactly 0", sum, 0);
    const Medium thin = with_slab(6360, 100, 3, 3.0000000001, 1e9);
    hold("9 a slab of 100 nm and 1e9 /km", "closed form, straight up",
         std::fabs(optical_depth_to_top(thin, 0, 6360)[0] / ((3.0000000001 - 3) * 1e9) - 1), 1e-12);
    Medium empty_slab = one_layer(6360, 100);
    empty_slab.piecewise_layers.push_back({{{5, 5, 1, 1, 0}}, Spectrum(1.0), Spectrum(1.0)});
    hold("9 a slab without thickness", "exactly 0",
         optical_depth_to_top(empty_slab, 0, 10)[0] + optical_depth_to_top(empty_slab, 5, 0)[0], 0);
}

TEST(TransmittanceHardCase, Case10ThinLayers) {
    const Medium fog = with_slab(6360, 100, 0, 0.001, 50);
    hold_to_referee("10 one metre of fog", worst_over_rays(fog, {0.0, 0.0005, 0.001, 0.5}), 1e-10);
    const Medium shell = with_slab(6360, 100, 10, 10.1, 1);
    hold_to_referee("10 a shell of 100 m at 10 km",
                    worst_over_rays(shell, {0.0, 10.0, 10.05, 10.1, 40.0}), 1e-10);
    const Medium thin = with_exponential(6360, 100, 0.001);
    hold_to_referee("10 an exponential layer of 1 m", worst_over_rays(thin, {0.0, 0.01, 30.0}, 12),
                    1e-10);
}

TEST(TransmittanceHardCase, Case11TinyPlanet) {
    const Medium tiny = test::preset_medium("tiny_planet");
    hold_to_referee("11 tiny planet, 50/65 km", worst_over_rays(tiny, {0.0, 0.3, 5.0, 15.0}),
                    1e-11);
    const Medium deep = with_exponential(10, 1e5, 1e4);
    hold_to_referee("11 air a thousand radii deep", worst_over_rays(deep, {0.0, 10.0, 1e4}, 12),
                    1e-9);
}

TEST(TransmittanceHardCase, Case12HugePlanetIsPlaneParallel) {
    const Medium huge = with_exponential(1e6, 100, 8);
    const double column = -8 * std::expm1(-100 / 8.0);
    double worst = 0;
    for (const double mu : {1.0, 0.7, 0.3}) {
        // Curvature enters as H (1 - mu^2) / (R mu^2) at first order.
        const double tau = optical_depth_to_top(huge, 0, 1e6 * mu)[0];
        const double bound = 8 * (1 - mu * mu) / (1e6 * mu * mu);
        worst = std::max(worst, std::fabs(tau * mu / column - 1) - 1.01 * bound);
    }
    hold("12 R = 1e6 km", "tau / mu, beyond first order in H / R", worst, 1e-9);
    hold_to_referee("12 R = 1e6 km", worst_over_rays(huge, {0.0, 8.0}), 1e-11);
}

TEST(TransmittanceHardCase, Case16HalfRange) {
    const std::string dense = "preset = \"dense_earth\"\n[bake.transmittance]\n";
    const auto outcome = test::bake_first(dense + "pixel_type = \"half\"\n");
    ASSERT_TRUE(outcome.value);
    const Baked& table = *outcome.value;
    // Transmittances that a double holds and a half does not, by their optical depths.
    const auto depth =
        test::bake_first(dense + "content = \"optical_depth\"\n", {1, Certification::off});
    long below = 0;
    for (const float tau : depth.value->image().texels) {
        if (tau > 14 * std::log(2.0) && tau < 708) ++below;
    }
    EXPECT_GT(below, 1000);
    hold("16 half, 50x air: texels below 6.1e-5 counted", "count of optical depths in (9.7, 708)",
         std::fabs(static_cast<double>(below - table.range.below_normal)), 0);
    ASSERT_EQ(outcome.diagnostics.size(), 1U);
    EXPECT_EQ(outcome.diagnostics[0].code, "W0201");
}

TEST(TransmittanceHardCase, Case17SizesOneTwoAndOdd) {
    double worst = 0;
    for (const std::string size : {"[1, 1]", "[2, 2]", "[1, 7]", "[33, 1]", "[255, 63]"}) {
        const auto outcome = test::bake_first(
            "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = " + size + "\n");
        ASSERT_TRUE(outcome.value) << size;
        worst = std::max(worst, outcome.value->certificate.texel.max);
        for (const Probe& probe : outcome.value->levels[0].probes) {
            for (const double value : probe.value) EXPECT_TRUE(value >= 0 && value <= 1) << size;
        }
    }
    hold("17 sizes 1, 2 and odd", "reference at each texel", worst, 1e-7);
}

TEST(TransmittanceHardCase, Case21ThreadsAndOrder) {
    test::hold_on_threads("transmittance", [](int threads) {
        const Baked table =
            *test::bake_first("preset = \"mars_rgb\"\n[bake.transmittance]\n", {threads}).value;
        return std::tuple(table.image().texels, table.certificate.lookup.rms);
    });
}

}  // namespace
}  // namespace skybake
