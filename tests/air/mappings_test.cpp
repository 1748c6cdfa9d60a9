#include <gtest/gtest.h>

#include <cmath>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "config/assets/transmittance.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

using config::MultipleScatteringMapping;

TEST(MultipleScatteringMapping, RoundTripsAndEndPoints) {
    for (const auto mapping :
         {MultipleScatteringMapping::hillaire, MultipleScatteringMapping::twilight}) {
        for (const int size : {2, 3, 32, 33}) {
            for (int i = 0; i < size; ++i) {
                const double x = static_cast<double>(i) / (size - 1);
                EXPECT_NEAR(sun_coordinate(mapping, sun_cos_zenith_at(mapping, x)), x, 1e-12);
            }
        }
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0), -1);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0.5), 0);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 1), 1);
    }
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::hillaire, 0.75), 0.5);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.75), 0.25);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.25), -0.25);
}

TEST(TransmittanceMapping, RoundTripsAtEachTexelCentre) {
    for (const std::string& preset : test::preset_list()) {
        const Shell shell = shell_of(test::preset_medium(preset));
        for (const int size : {1, 2, 3, 17, 64}) {
            for (int j = 0; j < size; ++j) {
                for (int i = 0; i < size; ++i) {
                    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
                    const UnitCoordinates x = {texel_coordinate(kConvention, i, size),
                                               texel_coordinate(kConvention, j, size)};
                    const TransmittanceRay ray = transmittance_ray(shell, x);
                    const UnitCoordinates back = transmittance_coordinates(
                        shell, ray.altitude_km, cos_zenith_of(shell, ray));
                    EXPECT_NEAR(back.x_r, x.x_r, 1e-12) << preset << ' ' << i << ' ' << j;
                    EXPECT_NEAR(back.x_mu, x.x_mu, 1e-12) << preset << ' ' << i << ' ' << j;
                }
            }
        }
    }
}

TEST(TransmittanceMapping, EndPoints) {
    const Shell earth = {6360, 100};
    EXPECT_EQ(cos_zenith_of(earth, transmittance_ray(earth, {0, 0})), 1);
    EXPECT_EQ(transmittance_ray(earth, {1, 0}).s_km, 0);
    EXPECT_EQ(cos_zenith_of(earth, transmittance_ray(earth, {0, 1})), 1);
    const TransmittanceRay horizon = transmittance_ray(earth, {1, 1});
    EXPECT_EQ(horizon.altitude_km, 100);
    EXPECT_NEAR(horizon.s_km, -horizon_distance_km(earth, 100), 1e-9);
}

TEST(TransmittanceMapping, IsBrunetonsFormula) {
    // Written as in the paper, in plain double, at moderate places where it does not cancel.
    const Shell earth = {6360, 100};
    for (const double h : {1.0, 20.0, 77.0}) {
        for (const double mu : {0.9, 0.3, 0.02}) {
            const double r = 6360 + h;
            const double big_h = std::sqrt(6460.0 * 6460 - 6360.0 * 6360);
            const double rho = std::sqrt(r * r - 6360.0 * 6360);
            const double d = -r * mu + std::sqrt(r * r * (mu * mu - 1) + 6460.0 * 6460);
            const UnitCoordinates x = transmittance_coordinates(earth, h, mu);
            EXPECT_NEAR(x.x_mu, (d - (6460 - r)) / (rho + big_h - (6460 - r)), 1e-11);
            EXPECT_NEAR(x.x_r, rho / big_h, 1e-11);
        }
    }
}

}  // namespace
}  // namespace skybake
