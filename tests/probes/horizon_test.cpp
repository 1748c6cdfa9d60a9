// Probes keep off the horizon, where rounding decides what a runtime sees: told here by angles from
// the C library.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/probes/baked_recipe.h"

namespace skybake::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRadiusKm = 6360;

// Returns a ray's angle above the horizon, from the altitude and the cosine that a probe names.
double degrees_above_horizon(const Probe& probe) {
    const double altitude = at(probe, "altitude_km");
    const double elevation = std::asin(at(probe, "cos_zenith"));
    return (elevation + std::acos(kRadiusKm / (kRadiusKm + altitude))) / kDegree;
}

const std::vector<Probe>& probes_of(const std::string& name) {
    return every_asset().asset(name).levels[0].probes;
}

TEST(EveryAsset, HasProbesOffTheHorizonInTables) {
    for (const Probe& probe : probes_of("transmittance")) {
        EXPECT_GE(degrees_above_horizon(probe), 0.00999);
    }
    const double dip = std::acos(kRadiusKm / (kRadiusKm + 400));
    const double dip_to_top = std::acos((kRadiusKm + 100) / (kRadiusKm + 400));
    const double edge = (dip - dip_to_top) / kDegree;
    for (const char* name : {"sky", "sky_of_space"}) {
        int below = 0;
        for (const Probe& probe : probes_of(name)) {
            const double angle = at(probe, "above_horizon_deg");
            EXPECT_GE(std::fabs(angle), 0.00999);
            below += angle < 0 ? 1 : 0;
            if (name == std::string("sky_of_space")) {
                EXPECT_LE(angle, edge - 0.00999);
            }
        }
        EXPECT_GE(below, 3);
    }
}

TEST(EveryAsset, HasProbesOffTheHorizonInVolumes) {
    int to_ground = 0;
    for (const std::string name : {"b_transmittance", "b_scattering", "to_top", "along"}) {
        for (const Probe& probe : probes_of(name)) {
            const double above = degrees_above_horizon(probe);
            EXPECT_GE(std::fabs(above), 0.00999) << name;
            if (name == "along") continue;
            const bool ground = name == "b_scattering" && at(probe, "ground") != 0;
            to_ground += ground ? 1 : 0;
            EXPECT_EQ(above < 0, ground) << name << " " << above;
        }
    }
    EXPECT_GE(to_ground, 3);
}

}  // namespace
}  // namespace skybake::testing
