// The fast quadrature against nested adaptive quadrature of the definition: minutes, so labelled
// slow.
#include "tests/support/multiple_scattering_reference.h"

#include <gtest/gtest.h>

#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

// A relative difference, where values are above a thousandth of the brightest sky's.
void expect_agreement(const Medium& medium, double altitude_km, double sun_cos_zenith,
                      double tolerance) {
    const MultipleScatteringTerms exact =
        reference_multiple_scattering(medium, altitude_km, sun_cos_zenith, 1e-4);
    const std::vector<double> altitudes = quadrature_altitudes_km(medium);
    const Sunlight sunlight(medium, altitudes, {768, 128}, 1);
    const RowQuadrature row = make_row_quadrature(medium, altitudes, altitude_km, {40, 1e-4, 1e-5});
    Spectrum psi{};
    integrate_row(medium, sunlight, row, &sun_cos_zenith, 1, &psi.x);
    for (std::size_t c = 0; c < static_cast<std::size_t>(medium.channels); ++c) {
        EXPECT_NEAR(psi[c], exact.psi[c], tolerance * exact.psi[c] + 1e-7)
            << altitude_km << ' ' << sun_cos_zenith << " channel " << c;
        EXPECT_NEAR(row.escape[c], exact.escape[c], 1e-5 * exact.escape[c]);
    }
}

TEST(MultipleScatteringReference, Earth) {
    const Medium earth = test::preset_medium("earth_hillaire");
    for (const double sun : {0.7, 0.01, -0.05}) expect_agreement(earth, 4, sun, 5e-4);
}

TEST(MultipleScatteringReference, Mars) {
    const Medium mars = test::preset_medium("mars_rgb");
    for (const double sun : {0.7, 0.0}) expect_agreement(mars, 10, sun, 5e-4);
}

TEST(MultipleScatteringReference, DenseEarth) {
    const Medium dense = test::preset_medium("dense_earth");
    for (const double sun : {0.7, 0.02}) expect_agreement(dense, 8, sun, 1e-3);
}

TEST(MultipleScatteringReference, ThinSlab) {
    // A hundred metres of air a hundred times as dense as the ground's, inside and below.
    const Medium slab = test::preset_medium(
        "vacuum", {"atmosphere.layers.veil={profile=\"slab\", bottom_altitude=\"10 km\", "
                   "top_altitude=\"10.1 km\", scattering=\"1e-2 /m\"}"});
    for (const double altitude : {10.05, 9.0}) expect_agreement(slab, altitude, 0.7, 2e-3);
}

TEST(MultipleScatteringReference, TinyPlanet) {
    const Medium tiny = test::preset_medium("tiny_planet");
    for (const double sun : {0.7, 0.0, -0.3}) expect_agreement(tiny, 3, sun, 1e-3);
}

}  // namespace
}  // namespace skybake
