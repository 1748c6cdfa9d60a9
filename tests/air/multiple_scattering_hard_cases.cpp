// Where multiple scattering goes wrong, held against identities, limits and nested adaptive
// quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "bakers/field/baked.h"
#include "tests/support/bakes.h"
#include "tests/support/hard_case.h"
#include "tests/support/multiple_scattering_reference.h"

namespace skybake {
namespace {

using test::hold;

constexpr QuadratureLevel kFine = {20, 1e-3, 1e-4};

struct Row {
    RowQuadrature quadrature;
    std::vector<double> psi;  // channel c of sun i at [c * suns + i]
};

Row integrate(const Medium& medium, double altitude_km, const std::vector<double>& suns,
              QuadratureLevel level = kFine) {
    const std::vector<double> altitudes = quadrature_altitudes_km(medium);
    const Sunlight sunlight(medium, altitudes, {256, 128}, 1);
    Row row{make_row_quadrature(medium, altitudes, altitude_km, level), {}};
    row.psi.resize(suns.size() * static_cast<std::size_t>(medium.channels));
    integrate_row(medium, sunlight, row.quadrature, suns.data(), static_cast<int>(suns.size()),
                  row.psi.data());
    return row;
}

// f and 1 - f by the definition; 3 angles' worth of work instead of the sun's.
double worst_escape(const Medium& medium, double altitude_km) {
    const Row row = integrate(medium, altitude_km, {1.0});
    // The dark side costs the reference nothing in the sun's part.
    const MultipleScatteringTerms exact =
        reference_multiple_scattering(medium, altitude_km, -1, 1e-7);
    double worst = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(medium.channels); ++c) {
        worst = std::max(worst, std::fabs(row.quadrature.escape[c] / exact.escape[c] - 1));
    }
    return worst;
}

TEST(MultipleScatteringHardCase, Case06DenseAir) {
    hold("6 50x Rayleigh: 1 - f", "adaptive quadrature, relative",
         worst_escape(test::preset_medium("dense_earth"), 5), 1e-3);
    const Medium thousand = test::preset_medium(
        "earth_hillaire",
        {"atmosphere.layers.rayleigh.scattering=[\"5.802e-3 /m\", \"1.3558e-2 /m\", "
         "\"3.31e-2 /m\"]"});
    hold("6 1000x Rayleigh: 1 - f", "adaptive quadrature, relative", worst_escape(thousand, 30),
         1e-3);
    const Row row = integrate(thousand, 30, {1.0, 0.1, -0.5});
    double bad = 0;
    for (const double value : row.psi) bad += std::isfinite(value) && value >= 0 ? 0 : 1;
    hold("6 1000x Rayleigh: Psi", "finite and not negative (count)", bad, 0);
}

TEST(MultipleScatteringHardCase, Case07ConservativeMedium) {
    // No absorption anywhere: what is not scattered comes out, so f + mean transmittance = 1.
    double worst = 0;
    double scattered_share = 0;
    for (const char* scattering : {"3.31e-7 /m", "3.31e-5 /m", "3.31e-3 /m"}) {
        const Medium medium = test::preset_medium(
            "earth_hillaire",
            {"atmosphere.layers.mie.enabled=false", "atmosphere.layers.ozone.enabled=false",
             std::string("atmosphere.layers.rayleigh.scattering=\"") + scattering + "\""});
        for (const double altitude : {0.0, 8.0, 40.0}) {
            const Row row = integrate(medium, altitude, {1.0});
            double mean_transmittance = 0;
            double f = 0;
            for (const WeightedRay& ray : row.quadrature.rays) {
                mean_transmittance += ray.weight * ray.end_transmittance[2];
                for (const RayNode& node : ray.nodes) f += ray.weight * node.weight[2];
            }
            // The baker's 1 - f is the mean transmittance itself, to the last bit.
            worst = std::max(worst, std::fabs(row.quadrature.escape[2] / mean_transmittance - 1));
            scattered_share = std::max(scattered_share, std::fabs(f + mean_transmittance - 1));
        }
    }
    hold("7 conservative: 1 - f is the mean transmittance", "same nodes, relative", worst, 1e-15);
    hold("7 conservative: scattered + transmitted = 1", "same nodes", scattered_share, 1e-4);
}

TEST(MultipleScatteringHardCase, Case09Vacuum) {
    const Medium vacuum = test::preset_medium("vacuum", {"atmosphere.ground_albedo=0.5"});
    const Row row = integrate(vacuum, 0, {1.0, 0.5, -0.1});
    // Bare Lambert ground fills half of all directions with albedo / pi * mu_s.
    double worst = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double expected = 0.5 * 0.5 / 3.14159265358979324 * (i == 0 ? 1.0 : 0.5);
        worst = std::max(worst, std::fabs(row.psi[i] / expected - 1));
    }
    worst = std::max(worst, row.psi[2]);
    hold("9 no air over Lambert ground", "albedo mu_s / 2 pi, relative", worst, 1e-14);
}

TEST(MultipleScatteringHardCase, Case10ThinFog) {
    const Medium fog = test::preset_medium(
        "earth_hillaire",
        {"atmosphere.layers.fog={profile=\"slab\", bottom_altitude=\"0 m\", "
         "top_altitude=\"1 m\", scattering=\"0.2 /m\", single_scattering_albedo=0.999}"});
    hold("10 one metre of fog: 1 - f at 0.5 m", "adaptive quadrature, relative",
         worst_escape(fog, 0.0005), 1e-3);
    const Medium shell = test::preset_medium(
        "earth_hillaire", {"atmosphere.layers.veil={profile=\"slab\", bottom_altitude=\"10 km\", "
                           "top_altitude=\"10.1 km\", scattering=\"1e-2 /m\"}"});
    hold("10 a shell of 100 m at 10 km: 1 - f below it", "adaptive quadrature, relative",
         worst_escape(shell, 3), 1e-3);
}

TEST(MultipleScatteringHardCase, Case11TinyPlanet) {
    hold("11 tiny planet: 1 - f", "adaptive quadrature, relative",
         worst_escape(test::preset_medium("tiny_planet"), 2), 1e-3);
}

TEST(MultipleScatteringHardCase, Case12HugePlanetHasNoAzimuth) {
    // Where the ground is flat the sun's cosine is the same all along a ray: one azimuth or eight.
    const Medium huge = test::preset_medium(
        "earth_hillaire",
        {"atmosphere.ground_radius=\"1e6 km\"", "atmosphere.top_radius=\"1000100 km\""});
    const Row one = integrate(huge, 1, {0.5}, {20, 1e-3, 1e9});
    const Row eight = integrate(huge, 1, {0.5}, {20, 1e-3, 0});
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::fabs(one.psi[c] / eight.psi[c] - 1));
    }
    hold("12 R = 1e6 km: no azimuth in the flat limit", "eight azimuths, relative", worst, 1e-5);
}

TEST(MultipleScatteringHardCase, Case13SunBelowTheHorizon) {
    // From the horizon down to 108 degrees: never a rise. Seen from the ground the last light is
    // gone when the sun is twice the dip of the shell's top, 10.1 degrees, below the horizon.
    const Medium earth = test::preset_medium("earth_hillaire");
    std::vector<double> suns;
    for (double zenith = 90; zenith <= 108; zenith += 0.25) {
        suns.push_back(std::cos(zenith * 3.14159265358979324 / 180));
    }
    double rise = 0;
    for (const double altitude : {0.0, 10.0, 60.0}) {
        const Row row = integrate(earth, altitude, suns, {28, 3e-4, 3e-5});
        for (std::size_t c = 0; c < 3; ++c) {
            const double* psi = row.psi.data() + c * suns.size();
            for (std::size_t i = 0; i + 1 < suns.size(); ++i) {
                if (psi[i] > 1e-8) rise = std::max(rise, psi[i + 1] / psi[i] - 1);
            }
        }
    }
    hold("13 twilight falls monotonically to 108 degrees", "largest relative rise", rise, 1e-2);
    const std::vector<double> deep = {std::cos(110.4 * 3.14159265358979324 / 180), -0.5, -1};
    double night = 0;
    for (const double value : integrate(earth, 0, deep).psi) night += value;
    hold("13 no light through the ground beyond 110.3 degrees", "exactly 0", night, 0);
}

TEST(MultipleScatteringHardCase, Case14SunAtZenithAndHorizon) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const double step = 1e-9;
    const Row row = integrate(earth, 2, {1.0, 1 - step, step, 0.0, -step, -1 + step, -1.0});
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double* psi = row.psi.data() + c * 7;
        worst = std::max({worst, std::fabs(psi[1] / psi[0] - 1), std::fabs(psi[2] / psi[3] - 1),
                          std::fabs(psi[4] / psi[3] - 1), psi[5], psi[6]});
    }
    hold("14 sun at zenith, horizon and nadir", "its own limits, relative", worst, 1e-6);
}

TEST(MultipleScatteringHardCase, Case15GroundAndTopAreLimits) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const std::vector<double> suns = {1.0, 0.2, -0.02};
    double worst = 0;
    for (const auto& [at, near] : {std::pair{0.0, 1e-6}, {100.0, 100 - 1e-6}}) {
        const Row limit = integrate(earth, at, suns);
        const Row close = integrate(earth, near, suns);
        for (std::size_t i = 0; i < limit.psi.size(); ++i) {
            worst = std::max(worst, std::fabs(close.psi[i] / limit.psi[i] - 1));
        }
    }
    hold("15 h = 0 and h at the top", "1 mm inside, relative", worst, 2e-3);
}

TEST(MultipleScatteringHardCase, Case17SizesOneTwoAndOdd) {
    double worst = 0;
    for (const std::string size : {"[1, 1]", "[2, 2]", "[33, 1]", "[1, 5]", "[7, 3]"}) {
        const auto outcome = test::bake_first(
            "preset = \"earth_hillaire\"\n[bake.multiple_scattering]\nmethod = 'converged'\n"
            "mapping = 'hillaire'\nsize = " +
            size + "\n");
        ASSERT_TRUE(outcome.value) << size;
        worst = std::max(worst, outcome.value->certificate.texel.max);
    }
    hold("17 sizes 1, 2 and odd", "reference at each texel, relative", worst, 2.001e-3);
}

TEST(MultipleScatteringHardCase, Case19GroundBounceOnce) {
    // L_2nd is linear in albedo, and 1 - f does not know it.
    const auto second_order = [](double albedo) {
        const Medium earth = test::preset_medium(
            "earth_hillaire", {"atmosphere.ground_albedo=" + std::to_string(albedo)});
        const Row row = integrate(earth, 1, {0.6});
        Spectrum value{};
        for (std::size_t c = 0; c < 3; ++c) value[c] = row.psi[c] * row.quadrature.escape[c];
        return value;
    };
    const Spectrum none = second_order(0);
    const Spectrum half = second_order(0.5);
    const Spectrum full = second_order(1);
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::fabs((full[c] - none[c]) / (2 * (half[c] - none[c])) - 1));
    }
    hold("19 ground bounce counted once", "linear in albedo, relative", worst, 1e-13);
}

TEST(MultipleScatteringHardCase, Case21ThreadsAndOrder) {
    const config::Recipe recipe = test::recipe_of(
        "preset = \"tiny_planet\"\n[bake.multiple_scattering]\nmethod = 'converged'\n"
        "mapping = 'hillaire'\nsize = [32, 32]\nmax_texel_error = \"2 %\"\n");
    test::hold_on_threads("multiple scattering", [&](int threads) {
        const Baked table = *test::bake_first(recipe, {threads}).value;
        return std::tuple(table.image().texels, table.certificate.lookup.max,
                          table.certificate.texel.rms);
    });
}

}  // namespace
}  // namespace skybake
