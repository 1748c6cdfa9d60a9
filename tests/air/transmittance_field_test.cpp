#include "bakers/air/transmittance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

double interpolated(const TransmittanceField& field, int channel, double altitude_km, double x_mu) {
    const TransmittanceField::Row row = field.row_at(altitude_km);
    const auto at = [&](int column) {
        const int i = column * field.channels() + channel;
        return row.weights[0] * row.values[i] + row.weights[1] * row.values[i + field.row_size()] +
               row.weights[2] * row.slopes[i] + row.weights[3] * row.slopes[i + field.row_size()];
    };
    const double position = x_mu * (field.columns() - 1);
    const int column = std::min(static_cast<int>(position), field.columns() - 2);
    return at(column) + (position - column) * (at(column + 1) - at(column));
}

double rms_error(const Medium& medium, TransmittanceField::Size size) {
    const TransmittanceField field(medium, break_altitudes_km(medium, {1, 4, 12}), size, 1);
    const Shell shell = shell_of(medium);
    double worst = 0;
    double sum = 0;
    for (const PointRow& point : low_discrepancy_points(4000, 1)) {
        const TransmittanceRay ray = transmittance_ray(shell, {point.x[0], point.y});
        const Spectrum tau = optical_depth_to_top(medium, ray.altitude_km, ray.s_km);
        for (int c = 0; c < medium.channels; ++c) {
            const double exact = exponential(-tau[static_cast<std::size_t>(c)]);
            const double value = interpolated(field, c, ray.altitude_km, point.x[0]);
            worst = std::max(worst, std::fabs(value - exact));
            sum += (value - exact) * (value - exact);
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
    }
    EXPECT_LT(worst, 2e-3);  // at the limb, seen from above
    return std::sqrt(sum / 12000);
}

TEST(TransmittanceField, Converges) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const double coarse = rms_error(earth, {256, 128});
    const double fine = rms_error(earth, {512, 256});
    EXPECT_LT(coarse, 6e-5);
    EXPECT_LT(fine, 0.35 * coarse);
}

// Suns from the zenith to the horizon, at the ground, between, and at the top.
TEST(TransmittanceField, IsReadForManySuns) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const Shell shell = shell_of(earth);
    const TransmittanceField field(earth, break_altitudes_km(earth, {1, 4, 12}), {256, 128}, 1);
    for (const double altitude_km : {0.0, 0.3, 7.0, 60.0, shell.thickness_km}) {
        const double r = shell.ground_radius_km + altitude_km;
        std::vector<double> s_km = {-horizon_distance_km(shell, altitude_km)};
        for (const double cosine : {0.0, 0.01, 0.3, 1.0}) s_km.push_back(r * cosine);
        std::vector<double> values(3 * s_km.size());
        field.read(altitude_km, s_km.data(), static_cast<int>(s_km.size()), values.data());
        for (std::size_t i = 0; i < s_km.size(); ++i) {
            const Spectrum exact = exponential(-optical_depth_to_top(earth, altitude_km, s_km[i]));
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(values[c * s_km.size() + i], exact[c], 3e-4) << altitude_km << ' ' << i;
            }
        }
    }
}

// Over a flat planet sunlight fades within the first hundredth of the way to the horizon.
TEST(TransmittanceField, KnowsTheFirstWaysOverAFlatPlanet) {
    Medium slab;
    slab.channels = 1;
    slab.thickness_km = 0.1;
    PiecewiseLayer layer;
    layer.pieces = {{0, 0.1, 1, 1, 0}};
    layer.extinction_per_km = Spectrum(50.0);
    slab.piecewise_layers = {layer};
    for (const double radius_km : {6360.0, 1e6}) {
        slab.ground_radius_km = radius_km;
        const TransmittanceField field(slab, {0, 0.1}, {256, 128}, 1);
        ASSERT_TRUE(field.is_flat());
        for (const double altitude_km : {0.0, 0.03, 0.09}) {
            for (double cosine = 1; cosine > 0.01; cosine *= 0.97) {
                const double s_km = (radius_km + altitude_km) * cosine;
                double value = 0;
                field.read(altitude_km, &s_km, 1, &value);
                const Spectrum depth = optical_depth_to_top(slab, altitude_km, s_km);
                EXPECT_NEAR(value, exponential(-depth[0]), 1e-3) << altitude_km << ' ' << cosine;
            }
        }
    }
}

TEST(TransmittanceField, StaysInRangeWhereALayerIsSharp) {
    const Medium fog = test::preset_medium(
        "vacuum", {"atmosphere.layers.fog={profile=\"slab\", bottom_altitude=\"0 m\", "
                   "top_altitude=\"1 m\", scattering=\"0.5 /m\"}"});
    const TransmittanceField field(fog, break_altitudes_km(fog, {}), {256, 128}, 1);
    for (double altitude = 0; altitude <= fog.thickness_km; altitude += 0.0137) {
        for (double x = 0; x <= 1; x += 0.043) {
            const double value = interpolated(field, 0, altitude, x);
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
        if (altitude > 0.2) altitude += 3;
    }
}

}  // namespace
}  // namespace skybake
