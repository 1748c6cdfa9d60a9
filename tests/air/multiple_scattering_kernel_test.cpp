#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/atmospheres.h"
#include "tests/support/every_target.h"
#include "tests/support/multiple_scattering_as_in_paper.h"
#include "tests/support/number_rows.h"

namespace skybake {
namespace {

// Psi at one place by a fine quadrature.
Spectrum psi_at(const Medium& medium, double altitude_km, double sun_cos_zenith,
                QuadratureLevel level = {28, 3e-4, 3e-5}, RowQuadrature* row_out = nullptr) {
    const std::vector<double> altitudes = quadrature_altitudes_km(medium);
    const Sunlight sunlight(medium, altitudes, {768, 128}, 1);
    const RowQuadrature row = make_row_quadrature(medium, altitudes, altitude_km, level);
    Spectrum psi{};
    integrate_row(medium, sunlight, row, &sun_cos_zenith, 1, data(psi));
    if (row_out != nullptr) *row_out = row;
    return psi;
}

// Golden values of an independent program: Mie absorption 4.40e-6 /m, albedo 0.3.
TEST(MultipleScatteringKernel, ReproducesTheGoldenValues) {
    const Medium medium = test::preset_medium(
        "earth_hillaire",
        {"atmosphere.layers.mie.absorption=\"4.40e-6 /m\"", "atmosphere.ground_albedo=0.3"});
    RowQuadrature row;
    const Spectrum psi = psi_at(medium, 0, 1, {40, 1e-4, 1e-5}, &row);
    const double expected[] = {0.05488525182, 0.05984517780, 0.06956475093};
    const double scattered[] = {0.07764070, 0.14077679, 0.24352543};
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(psi[c], expected[c], 2e-6 * expected[c]);
        EXPECT_NEAR(1 - row.escape[c], scattered[c], 1e-7);
    }
}

// Values of the nested adaptive reference at 1e-5, kept so that every run can check against them;
// multiple_scattering_reference_test.cpp makes them anew.
TEST(MultipleScatteringKernel, AgreesWithTheAdaptiveReference) {
    const Medium earth = test::preset_medium("earth_hillaire");
    struct Anchor {
        double altitude_km, sun_cos_zenith;
        double psi[3];
        double relative;
    };
    const Anchor anchors[] = {
        {0, 1, {0.0555880053, 0.060775534, 0.0707288078}, 1e-05},
        {0.5, 0.3, {0.0193882678, 0.0214562877, 0.0256257474}, 5e-05},
        {0, 0.02, {0.00346825595, 0.00259683014, 0.00245387676}, 0.0001},
        {2, -0.04, {0.000780792419, 0.000426861705, 0.000584655391}, 0.0005},
        {20, 0.05, {0.00542505998, 0.00574793171, 0.0107519236}, 5e-05},
        {20, -0.08, {0.000229292202, 0.000111482592, 0.000249108945}, 0.001},
        {50, 0.5, {0.0217814733, 0.020903581, 0.026841559}, 1e-05},
        {90, 0.1, {0.00549096822, 0.00542231715, 0.00898394647}, 5e-05},
    };
    for (const Anchor& anchor : anchors) {
        const Spectrum psi = psi_at(earth, anchor.altitude_km, anchor.sun_cos_zenith);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(psi[c], anchor.psi[c], anchor.relative * anchor.psi[c])
                << anchor.altitude_km << ' ' << anchor.sun_cos_zenith;
        }
    }
}

// Monte Carlo truth of the isotropic closure's own quantity, one bounce: P1_iso is the mean
// radiance of light scattered once, all isotropic, which is L_2nd; set H0 has albedo 0.
TEST(MultipleScatteringKernel, SecondOrderAgreesWithPathTracing) {
    const Medium medium = test::preset_medium("earth_hillaire", {"atmosphere.ground_albedo=0"});
    int compared = 0;
    for (const auto& v : test::number_rows(SKYBAKE_TEST_DATA "/truth_mslut_setH0.csv")) {
        const double sun_cos_zenith = std::cos(v[1] * 3.14159265358979323846 / 180);
        const auto channel = static_cast<std::size_t>(v[2]);
        RowQuadrature row;
        const Spectrum psi = psi_at(medium, v[0], sun_cos_zenith, {14, 3e-3, 3e-4}, &row);
        const double second_order = psi[channel] * row.escape[channel];
        // se_iso belongs to all orders, so it is an upper bound here; five of them.
        EXPECT_NEAR(second_order, v[6], 5 * v[8] + 2e-3 * v[6]) << v[0] << ' ' << v[1];
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(MultipleScatteringKernel, HasTheSameBitsOnEveryTarget) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const std::vector<double> altitudes = quadrature_altitudes_km(earth);
    const Sunlight sunlight(earth, altitudes, {256, 128}, 1);
    std::vector<double> suns;
    for (int i = 0; i < 37; ++i) suns.push_back(-1 + i / 18.0);
    const int count = static_cast<int>(suns.size());
    for (const double altitude : {0.0, 3.3, 61.0, 100.0}) {
        const RowQuadrature row =
            make_row_quadrature(earth, altitudes, altitude, quadrature_levels()[3]);
        std::vector<double> first;
        test::on_every_target([&](const char* target) {
            std::vector<double> psi(3 * suns.size());
            integrate_row(earth, sunlight, row, suns.data(), count, psi.data());
            if (first.empty()) first = psi;
            EXPECT_EQ(psi, first) << target;
        });
    }
}

TEST(MultipleScatteringKernel, LevelsConverge) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const std::vector<double> altitudes = quadrature_altitudes_km(earth);
    const Sunlight sunlight(earth, altitudes, {256, 128}, 1);
    std::vector<double> suns;
    for (int i = 0; i < 32; ++i) suns.push_back(-1 + i / 15.5);
    std::vector<double> finest(96);
    const RowQuadrature fine =
        make_row_quadrature(earth, altitudes, 12, quadrature_levels().back());
    integrate_row(earth, sunlight, fine, suns.data(), 32, finest.data());
    double last = INFINITY;
    for (const QuadratureLevel& level :
         {quadrature_levels()[2], quadrature_levels()[5], quadrature_levels()[8]}) {
        std::vector<double> psi(96);
        integrate_row(earth, sunlight, make_row_quadrature(earth, altitudes, 12, level),
                      suns.data(), 32, psi.data());
        double worst = 0;
        for (std::size_t i = 0; i < psi.size(); ++i) {
            worst = std::max(worst, std::fabs(psi[i] - finest[i]) / std::max(finest[i], 5e-5));
        }
        EXPECT_LT(worst, 0.5 * last);
        last = worst;
    }
    EXPECT_LT(last, 3e-3);
}

// The paper's own quadrature is the same formula: off by its quadrature error, not by a factor.
TEST(MultipleScatteringKernel, AsInThePaperIsTheSameFormula) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const Image2<float> transmittance = as_in_paper::transmittance(earth);
    for (const double sun_cos_zenith : {1.0, 0.5, 0.1}) {
        const Spectrum paper =
            as_in_paper::multiple_scattering(earth, transmittance, 0.5, sun_cos_zenith);
        const Spectrum psi = psi_at(earth, 0.5, sun_cos_zenith);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(paper[c], psi[c], 0.3 * psi[c]);
    }
}

}  // namespace
}  // namespace skybake
