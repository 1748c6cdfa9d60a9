// Columns where they are hard: what each case's exact integral and its lookups reach.
#include <gtest/gtest.h>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "config/assets/optical_depth.h"
#include "tests/optical_depth/columns.h"
#include "tests/support/hard_case.h"

namespace skybake::test {
namespace {

// The largest error of the mean density against adaptive quadrature, relative to it, over the paths
// of random places of all kinds and of their corners.
double worst_column(const config::Atmosphere& atmosphere, const std::string& name,
                    std::vector<double> angles, std::vector<double> altitudes) {
    const auto kinds = make_column_kinds(atmosphere, {name});
    const ColumnGeometry geometry = column_geometry(kinds);
    double worst = 0;
    for (const RayKind kind : {RayKind::upward, RayKind::limb, RayKind::ground}) {
        for (const double angle : angles) {
            for (const double altitude : altitudes) {
                for (const double distance : {0.0, 1e-3, 0.5, 1.0}) {
                    const ColumnPath path = path_along(geometry, {kind, angle, altitude, distance});
                    const double exact = mean_density(kinds[0], path);
                    const double reference = reference_mean_density(kinds[0], path);
                    const double floor = 1e-15 / std::max(path.length_km, 1e-3);
                    worst =
                        std::max(worst, std::fabs(exact - reference) / (reference + 1e8 * floor));
                }
            }
        }
    }
    return worst;
}

void hold_lookups(const std::string& name, const config::Atmosphere& atmosphere,
                  const std::string& kind, double top_bound, double between_bound) {
    const std::vector<std::string> tables = {"to the top", "between, altitudes",
                                             "between, distance"};
    std::size_t i = 0;
    for (const auto& bake : path_bakes({256, 128, 1}, {64, 64, 64}, {kind})) {
        hold(name, "transmittance, rms, " + tables[i],
             errors_of(atmosphere, bake, 512).together.rms, i == 0 ? top_bound : between_bound);
        ++i;
    }
}

const std::vector<double> kSome = {0, 0.1, 0.5, 0.9, 1};

TEST(ColumnHardCases, C1_zenith_nadir_and_horizon) {
    for (const std::string& name : earth_kinds()) {
        hold("C1 zenith, nadir, level, grazing: " + name, "column, adaptive quadrature",
             worst_column(earth_with_presets(), name, {0, 1}, kSome), 1e-8);
    }
}

TEST(ColumnHardCases, C2_tangent_rays_through_fog) {
    hold("C2 rays that pass within 100 m of the ground", "column, adaptive quadrature",
         worst_column(earth_with_presets(), "fog", {0.97, 0.98, 0.99, 0.999, 1}, kSome), 1e-8);
    hold_lookups("C2 fog of 100 m alone", earth_with_presets(), "fog", 2e-4, 1e-3);
    config::Atmosphere thinner = earth_with_presets();
    for (config::Layer& layer : thinner.layers) layer.scale_height.meters /= 10;
    hold_lookups("C2 fog of 10 m alone", thinner, "fog", 2e-4, 2e-3);
}

TEST(ColumnHardCases, C3_equal_altitudes_and_no_distance) {
    const config::Atmosphere earth = earth_with_presets();
    const auto kinds = make_column_kinds(earth, {"fog"});
    const ColumnGeometry geometry = column_geometry(kinds);
    double worst = 0;
    for (const double high : kSome) {
        for (const double angle : kSome) {
            const ColumnPath level = path_between(geometry, {RayKind::upward, angle, high, 1});
            const double h = altitude_at(geometry.scale, high);
            worst = std::max(
                worst, std::fabs(mean_density(kinds[0], level) / density_of(kinds[0], h) - 1));
            const ColumnPath across = path_between(geometry, {RayKind::limb, angle, high, 1});
            const double reference = reference_mean_density(kinds[0], across);
            worst = std::max(
                worst, std::fabs(mean_density(kinds[0], across) - reference) / (reference + 1e-9));
        }
    }
    hold("C3 two points of one altitude", "mean density", worst, 1e-8);
}

TEST(ColumnHardCases, C4_huge_and_tiny_planets) {
    for (const double radius_km : {1e6, 20.0}) {
        config::Atmosphere planet = earth_with_presets();
        planet.ground_radius = {radius_km * 1e3};
        planet.top_radius = {radius_km * 1e3 + 100e3};
        const std::string name = radius_km > 1e5 ? "C4 radius 1e6 km" : "C4 radius 20 km";
        // At 1e6 km altitudes along a ray have 2e-10 km of rounding.
        hold(name, "column, adaptive quadrature", worst_column(planet, "rayleigh", kSome, kSome),
             1e-7);
        hold_lookups(name + ", air", planet, "rayleigh", 2e-4, 1e-3);
    }
}

// Where density jumps, what passes just above and what passes just below differ by all of it: no
// smooth coordinate resolves that between two texels. The bounds are what was reached.
TEST(ColumnHardCases, C5_slab_of_rain) {
    config::Atmosphere earth = earth_with_presets();
    for (config::Layer& layer : earth.layers) {
        if (layer.name != "rain") continue;
        layer.profile = config::Profile::slab;
        layer.bottom_altitude = {0};
        layer.top_altitude = {4000};
    }
    hold("C5 rain below 4 km and none above", "column, adaptive quadrature",
         worst_column(earth, "rain", kSome, kSome), 1e-7);
    hold_lookups("C5 rain below 4 km and none above", earth, "rain", 2e-2, 1e-1);
    hold_lookups("C5 ozone, a tent", earth, "ozone", 4e-4, 2e-3);
}

}  // namespace
}  // namespace skybake::test
