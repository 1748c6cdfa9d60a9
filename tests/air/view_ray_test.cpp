#include "bakers/air/view_ray.h"

#include <gtest/gtest.h>

#include "bakers/air/optical_depth.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

// Everything that enters a ray is scattered, absorbed or comes out.
TEST(ViewRay, KeepsEnergyAndAgreesWithTheOpticalDepth) {
    for (const std::string& preset : test::preset_list()) {
        const Medium medium = test::preset_medium(preset);
        const Shell shell = shell_of(medium);
        const std::vector<double> altitudes = break_altitudes_km(medium, {0.5, 1, 2, 3.5, 6, 10});
        const double altitude = 0.3 * medium.thickness_km;
        const double r = shell.ground_radius_km + altitude;
        const double horizon = -horizon_distance_km(shell, altitude) / r;
        for (const double mu : {1.0, 0.1, 0.0, 0.5 * horizon, 1.1 * horizon, -1.0}) {
            const bool below = mu < horizon;
            ViewRay ray = trace_view_ray(medium, altitudes, altitude, r * mu, below);
            Spectrum whole{};
            for (const RayCell& cell : ray.cells) {
                whole += cell.near_weight + cell.far_weight;
            }
            refine_view_ray(medium, whole, 1e-4, ray);
            const Spectrum exact = optical_depth_along(medium, altitude, mu, ray.length_km);
            for (std::size_t c = 0; c < 3; ++c) {
                double depth = 0;
                double kept = 0;
                for (const RayCell& cell : ray.cells) {
                    depth += cell.optical_depth[c];
                    kept += cell.near_weight[c] + cell.far_weight[c] + cell.absorbed[c];
                }
                EXPECT_NEAR(depth, exact[c], 1e-5 * exact[c] + 1e-12) << preset << " mu " << mu;
                EXPECT_NEAR(kept + exponential(-depth), 1, 1e-5) << preset << " mu " << mu;
            }
        }
    }
}

TEST(ViewRay, NodesAreExactForLinearLight) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const std::vector<double> altitudes = break_altitudes_km(earth, {0.5, 1, 2, 3.5, 6, 10});
    ViewRay ray = trace_view_ray(earth, altitudes, 2, 6362 * 0.2, false);
    refine_view_ray(earth, {1, 1, 1, 0}, 1e-5, ray);
    Spectrum sum{};
    for (const RayNode& node : nodes_of(earth, ray)) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_GE(node.weight[c], 0);
            sum[c] += node.weight[c] * (1 + 0.01 * node.distance_km);
        }
    }
    const Shell shell = shell_of(earth);
    const auto integrand = [&](double x) {
        const double altitude = altitude_along_km(shell, 2, 6362 * 0.2, x);
        Spectrum value = scattering_at(earth, altitude);
        const Spectrum depth = optical_depth_along(earth, 2, 0.2, x);
        value *= exponential(-depth) * (1 + 0.01 * x);
        return value;
    };
    Spectrum exact{};
    double from = 0;
    for (double to : {5.0, 20.0, 60.0, 150.0, ray.length_km}) {
        const Spectrum part = adaptive_integral<Spectrum>(integrand, from, to, 1e-9, 0, 20);
        exact += part;
        from = to;
    }
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], exact[c], 1e-6 * exact[c]);
}

TEST(ViewRay, ARayWithoutLengthHasOneNodeAndNoWeight) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const ViewRay ray = trace_view_ray(earth, break_altitudes_km(earth, {1}), 0, -6360, true);
    EXPECT_TRUE(ray.cells.empty());
    EXPECT_EQ(nodes_of(earth, ray).size(), 1U);
}

}  // namespace
}  // namespace skybake
