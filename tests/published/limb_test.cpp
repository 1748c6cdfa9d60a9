// Skies at the limb of a round planet against the comparison of seven programs by Zawada et al. 2021
// (AMT 14, 3953; Zenodo 4292303): 351 nm, a planet of 6371 km, air without depolarisation, ozone and
// a stratospheric aerosol over black ground, seen from 100 km, with the sun 70 degrees from the
// vertical at the tangent point. Their radiances are means over the programs, which spread by 0.2 %.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/light/sky_radiance.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/number_rows.h"

namespace skybake::test {
namespace {

struct LimbLine {
    double tangent_km;
    double view_zenith;  // degrees, at the observer
    double sun_zenith;
    double sun_azimuth;  // from the view
    double single;       // radiance in 1/sr for a solar irradiance of 1
    double all;          // of all orders, of light that is polarised
};

constexpr LimbLine kLines[] = {
#include "tests/published/limb_lines_351nm.inc"
};

constexpr double kAirCrossSection = 2.8788469859e-30;  // m^2
constexpr double kOzoneCrossSection = 1.22579807e-26;  // m^2
constexpr double kAerosolAlbedo = 0.9999218597738659;  // of single scattering
constexpr double kAerosolMeanCosine = 0.707679618076749;
// All lines scatter the sun's light by 35.53 degrees, where the aerosol's published phase function
// is this many times that of isotropic scattering.
constexpr double kAerosolPhase = 3.0757;

// Altitude, air, ozone, aerosol.
std::vector<std::vector<double>> profile() {
    return number_rows(SKYBAKE_TEST_DATA "/limb_air_351nm.csv");
}

// A layer whose density is a column of the profile over its largest value.
std::string layer_of(const std::vector<std::vector<double>>& rows, std::size_t column,
                     double scattering_share, double cross_section, const std::string& rest) {
    double most = 0;
    for (const auto& row : rows) most = std::max(most, row[column]);
    std::string table;
    for (const auto& row : rows) {
        table +=
            fmt::format("{}['{} km', {}]", table.empty() ? "" : ", ", row[0], row[column] / most);
        if (row[column] == 0) break;
    }
    const double extinction = most * cross_section;
    return fmt::format(
        "profile = 'tabulated'\ntable = [{}]\nscattering = '{} /m'\nabsorption = '{} /m'\n{}\n",
        table, extinction * scattering_share, extinction * (1 - scattering_share), rest);
}

SkyMedium limb_air() {
    const auto rows = profile();
    return make_sky_medium(
        recipe_of("wavelengths = ['351 nm']\n[atmosphere]\nground_radius = '6371 km'\n"
                  "top_radius = '6471 km'\nground_albedo = 0\n[atmosphere.layers.air]\n" +
                  layer_of(rows, 1, 1, kAirCrossSection, "phase = 'rayleigh'") +
                  "[atmosphere.layers.ozone]\n" + layer_of(rows, 2, 0, kOzoneCrossSection, "") +
                  "[atmosphere.layers.aerosol]\n" +
                  layer_of(rows, 3, kAerosolAlbedo, 1,
                           fmt::format("phase = 'henyey_greenstein'\ng = {}", kAerosolMeanCosine)))
            .parameters.atmosphere);
}

// The aerosol's phase function as it is at the angle of all lines, for light scattered once.
SkyMedium with_published_phase(SkyMedium air) {
    for (SkyLayer& layer : air.layers) {
        if (layer.phase.functions.empty() || layer.phase.functions.front().g == 0) continue;
        layer.phase.functions = {{.constant = kAerosolPhase / (4 * std::numbers::pi)}};
    }
    return air;
}

View view_of(const LimbLine& line) {
    return view_at(100, line.sun_zenith, line.view_zenith, line.sun_azimuth);
}

TEST(Limb, LightScatteredOnceIsWhatSevenProgramsFind) {
    ASSERT_EQ(profile().size(), 101U);
    const SkyMedium air = with_published_phase(limb_air());
    const SkyIntegrator integrator(air, nullptr);
    double worst = 0;
    for (const LimbLine& line : kLines) {
        const View view = view_of(line);
        const double single =
            integrator.radiance(view.altitude_km, view.sun, view.direction).single[0];
        worst = std::max(worst, std::fabs(single / line.single - 1));
        EXPECT_NEAR(single, line.single, 3e-3 * line.single) << line.tangent_km;
    }
    fmt::print("limb, single scattering: at most {:.2e} off\n", worst);
}

// The published light is polarised, which changes what is scattered again: a scalar program is off
// by some percent.
TEST(Limb, AllOrdersAreOffByWhatPolarisationMakes) {
    const SkyMedium air = limb_air();
    const SkyMedium published = with_published_phase(air);
    const SkyIntegrator henyey_greenstein(air, nullptr);
    const SkyIntegrator single(published, nullptr);
    const PathMedium path_medium(air);
    std::uint32_t ray = 0;
    double least = 1;
    double most = -1;
    for (const LimbLine& line : kLines) {
        const View view = view_of(line);
        const auto once = [&](const SkyIntegrator& of) {
            return of.radiance(view.altitude_km, view.sun, view.direction).single[0];
        };
        const PathTracedRadiance traced = trace(path_medium, view, paths(8192, ++ray), 2);
        const double all = traced.radiance[0] - once(henyey_greenstein) + once(single);
        EXPECT_LT(traced.standard_error[0], 3e-3 * line.all) << line.tangent_km;
        least = std::min(least, all / line.all - 1);
        most = std::max(most, all / line.all - 1);
    }
    fmt::print("limb, all orders without polarisation: {:.2e} to {:.2e} off\n", least, most);
    EXPECT_GT(least, -0.05);
    EXPECT_LT(most, 0.05);
}

}  // namespace
}  // namespace skybake::test
