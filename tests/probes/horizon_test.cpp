// Probes keep off the horizon, where rounding decides what a runtime sees: told here by angles from
// the C library.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/incremental/bakes.h"

namespace skybake::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRadiusKm = 6360;

Manifest manifest_of(const std::string& recipe) {
    const TemporaryFolder folder;
    TestBake test(recipe_of(recipe), folder.path());
    test.bake.certification = Certification::off;
    const auto baked = test.run();
    EXPECT_TRUE(baked.value.has_value())
        << (baked.diagnostics.empty() ? "" : baked.diagnostics[0].message);
    return *read_manifest(folder.path()).value;
}

double coordinate(const std::vector<std::pair<std::string, double>>& at, const std::string& name) {
    for (const auto& [key, value] : at) {
        if (key == name) return value;
    }
    ADD_FAILURE() << name;
    return 0;
}

// Returns a ray's angle above the horizon, from the altitude and the cosine that a probe names.
double degrees_above_horizon(const std::vector<std::pair<std::string, double>>& at) {
    const double altitude = coordinate(at, "altitude_km");
    const double elevation = std::asin(coordinate(at, "cos_zenith"));
    return (elevation + std::acos(kRadiusKm / (kRadiusKm + altitude))) / kDegree;
}

TEST(ProbesOffTheHorizon, OfTables) {
    const Manifest manifest = manifest_of(R"(
preset = "earth_hillaire"
[bake.transmittance]
size = [64, 16]
[bake.sky_view]
orders = "single"
size = [16, 16]
altitude = "500 m"
sun_elevations = ["3 deg"]
[bake.sky_view_of_space]
asset = "sky_view"
orders = "single"
size = [16, 16]
altitude = "400 km"
sun_elevations = ["20 deg"]
)");
    for (const Probe& probe : manifest.assets[0].levels[0].probes) {
        EXPECT_GE(degrees_above_horizon(probe.at), 0.00999);
    }
    const double dip = std::acos(kRadiusKm / (kRadiusKm + 400));
    const double dip_to_top = std::acos((kRadiusKm + 100) / (kRadiusKm + 400));
    const double edge = (dip - dip_to_top) / kDegree;
    for (const std::size_t table : {1u, 2u}) {
        int below = 0;
        for (const Probe& probe : manifest.assets[table].levels[0].probes) {
            const double angle = coordinate(probe.at, "above_horizon_deg");
            EXPECT_GE(std::fabs(angle), 0.00999);
            below += angle < 0 ? 1 : 0;
            if (table == 2) {
                EXPECT_LE(angle, edge - 0.00999);
            }
        }
        EXPECT_GE(below, 3);
    }
}

TEST(ProbesOffTheHorizon, OfVolumes) {
    const Manifest manifest = manifest_of(R"(
preset = "earth_hillaire"
[bake.transmittance]
asset = "bruneton"
table = "transmittance"
size = [64, 16, 1]
formats = ["bin"]
[bake.scattering]
asset = "bruneton"
table = "scattering"
combined = true
orders = 1
size = [32, 16, 8]
nu_size = 4
formats = ["bin"]
[bake.to_top]
asset = "optical_depth"
kinds = ["rayleigh"]
size = [32, 16, 1]
formats = ["bin"]
[bake.along]
asset = "optical_depth"
table = "between"
coordinates = "distance"
kinds = ["rayleigh"]
size = [16, 8, 8]
formats = ["bin"]
)");
    int to_ground = 0;
    for (const ManifestAsset& asset : manifest.assets) {
        for (const Probe& probe : asset.levels[0].probes) {
            const double above = degrees_above_horizon(probe.at);
            EXPECT_GE(std::fabs(above), 0.00999) << asset.name;
            if (asset.name == "along") continue;
            const bool ground = asset.name == "scattering" && coordinate(probe.at, "ground") != 0;
            to_ground += ground ? 1 : 0;
            EXPECT_EQ(above < 0, ground) << asset.name << " " << above;
        }
    }
    EXPECT_GE(to_ground, 3);
}

}  // namespace
}  // namespace skybake::testing
