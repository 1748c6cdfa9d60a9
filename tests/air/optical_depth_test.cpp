#include "bakers/air/optical_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/air/transmittance_mapping.h"
#include "tests/support/atmospheres.h"
#include "tests/support/every_target.h"
#include "tests/support/number_rows.h"
#include "tests/support/referee.h"

namespace skybake {
namespace {

struct Ray {
    double altitude_km;
    double s_km;
};

// The rays of a 256x64 table, every `step`-th of each axis and the last.
std::vector<Ray> table_rays(const Medium& medium, int step) {
    const Shell shell = shell_of(medium);
    std::vector<Ray> rays;
    for (int y = 0; y < 64; y += step) {
        for (int x = 0; x < 256; x += step) {
            const TransmittanceRay ray = transmittance_ray(shell, {x / 255.0, y / 63.0});
            rays.push_back({ray.altitude_km, ray.s_km});
        }
        const TransmittanceRay horizon = transmittance_ray(shell, {1, y / 63.0});
        rays.push_back({horizon.altitude_km, horizon.s_km});
    }
    return rays;
}

void expect_agreement_with_the_referee(const Medium& medium) {
    for (const Ray& ray : table_rays(medium, 21)) {
        const Spectrum tau = optical_depth_to_top(medium, ray.altitude_km, ray.s_km);
        const auto exact = test::referee_optical_depth_to_top(medium, ray.altitude_km, ray.s_km);
        for (std::size_t c = 0; c < static_cast<std::size_t>(medium.channels); ++c) {
            const double expected = static_cast<double>(exact[c]);
            EXPECT_NEAR(tau[c], expected, 1e-12 * expected + 1e-15)
                << "altitude " << ray.altitude_km << " s " << ray.s_km;
        }
    }
}

// The bar: 1e-6 tau + 1e-12 at every texel of all presets. Held four hundred million times closer
// at a sample, in 113-bit arithmetic.
TEST(OpticalDepth, AgreesWithTheRefereeOnAllPresets) {
    for (const std::string& preset : test::preset_list()) {
        SCOPED_TRACE(preset);
        expect_agreement_with_the_referee(test::preset_medium(preset));
    }
}

TEST(OpticalDepth, AgreesWithTheAdaptiveReferenceAtEveryTexelOfAllPresets) {
    for (const std::string& preset : test::preset_list()) {
        const Medium medium = test::preset_medium(preset);
        for (const Ray& ray : table_rays(medium, 3)) {
            const Spectrum tau = optical_depth_to_top(medium, ray.altitude_km, ray.s_km);
            const Spectrum expected =
                reference_optical_depth_to_top(medium, ray.altitude_km, ray.s_km, 1e-11);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(tau[c], expected[c], 1e-9 * expected[c] + 1e-14)
                    << preset << " altitude " << ray.altitude_km << " s " << ray.s_km;
            }
        }
    }
}

// Standard profiles: two tables share their pieces' climbs, and the third has altitudes of its own.
TEST(OpticalDepth, AgreesWithTheRefereeInTables) {
    const Medium earth = test::preset_medium("earth");
    ASSERT_EQ(earth.piecewise_layers.size(), 2u);
    Medium mixed = earth;  // with tables in another order, one of altitudes of its own
    PiecewiseLayer moved = earth.piecewise_layers[1];
    for (LinearPiece& piece : moved.pieces) {
        piece.bottom_km += 0.3;
        piece.top_km += 0.3;
    }
    mixed.piecewise_layers = {earth.piecewise_layers[1], moved, earth.piecewise_layers[0]};
    for (const Medium& medium : {earth, mixed}) expect_agreement_with_the_referee(medium);
}

// The least and the greatest scale height that a recipe may name, and planets of a metre and of a
// kilometre. Rays that pass a metre above the ground from far above have altitudes there that are
// differences of a thousand kilometres: a reference that computes them so does not end, because the
// rounding of a density that falls by e in a millimetre is greater than what it is to agree within.
TEST(OpticalDepth, TheReferenceEndsAndAgreesAtTheExtremesOfRecipes) {
    const auto exponential = [](double radius_km, double thickness_km, double scale_height_km) {
        Medium medium;
        medium.channels = 1;
        medium.ground_radius_km = radius_km;
        medium.thickness_km = thickness_km;
        medium.exponential_layers = {{scale_height_km, {}, {1, 0, 0, 0}}};
        return medium;
    };
    const std::vector<Medium> media = {exponential(6360, 100, 1e-6), exponential(6360, 100, 1e-3),
                                       exponential(6360, 100, 1e3),  exponential(1e-3, 1, 1e-6),
                                       exponential(1, 1, 1e-3),      exponential(1e6, 100, 8)};
    for (const Medium& medium : media) {
        for (const Ray& ray : table_rays(medium, 21)) {
            const double tau = optical_depth_to_top(medium, ray.altitude_km, ray.s_km)[0];
            const double expected =
                reference_optical_depth_to_top(medium, ray.altitude_km, ray.s_km, 1e-10)[0];
            EXPECT_NEAR(tau, expected, 2e-7 * expected + 1e-16)
                << medium.ground_radius_km << " altitude " << ray.altitude_km << " s " << ray.s_km;
        }
    }
}

// The lower end of a path that falls is where the air is densest.
TEST(OpticalDepth, TheReferenceIsTheSameFromBothEndsOfAPath) {
    const Medium earth =
        test::preset_medium("earth_hillaire", {"atmosphere.layers.mie.scale_height=\"1 mm\""});
    const Shell shell = shell_of(earth);
    for (const double s : {6360.0, 5000.0, 600.0, 10.0}) {
        for (const double length : {1e-6, 1e-3, 1.0, 90.0}) {
            const double end = altitude_along_km(shell, 0, s, length);
            const Spectrum up = reference_optical_depth_along(earth, 0, s, length, 1e-10);
            const Spectrum down =
                reference_optical_depth_along(earth, end, -(s + length), length, 1e-10);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(down[c], up[c], 1e-6 * up[c]) << s << " " << length;
            }
        }
    }
}

// Independent anchors: optical lengths of the three layers to 1e-13, of another program.
TEST(OpticalDepth, AgreesWithTheAnchors) {
    const std::vector<std::string> layers = {"rayleigh", "mie", "ozone"};
    std::vector<Medium> media;
    for (const std::string& layer : layers) {
        // One layer alone with extinction 1 /km gives its optical length.
        std::vector<std::string> settings;
        for (const std::string& other : layers) {
            if (other != layer) settings.push_back("atmosphere.layers." + other + ".enabled=false");
        }
        settings.push_back("atmosphere.layers." + layer + ".scattering=\"0 /m\"");
        settings.push_back("atmosphere.layers." + layer + ".absorption=\"1 /km\"");
        media.push_back(test::preset_medium("earth_hillaire", settings));
    }
    const auto rows = test::number_rows(SKYBAKE_TEST_DATA "/exact_transmittance_setH.csv", 1);
    for (const std::vector<double>& values : rows) {
        const double altitude = values[0];
        const double s = (6360 + altitude) * values[1];
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = optical_depth_to_top(media[i], altitude, s)[0];
            EXPECT_NEAR(length, values[4 + i], 1e-10 * values[4 + i] + 1e-10)
                << layers[i] << ": " << altitude << ' ' << values[1];
        }
    }
    EXPECT_EQ(rows.size(), 129U);
}

// Zenith optical depths in closed form, physics of the model.
TEST(OpticalDepth, ZenithOfEarth) {
    const Medium earth = test::preset_medium("earth_hillaire");
    const Spectrum tau = optical_depth_to_top(earth, 0, 6360);
    const double rayleigh = -8 * std::expm1(-100 / 8.0);
    const double mie = -1.2 * std::expm1(-100 / 1.2);
    const double expected[] = {5.802e-3 * rayleigh + 4.44e-3 * mie + 6.5e-4 * 15,
                               1.3558e-2 * rayleigh + 4.44e-3 * mie + 1.881e-3 * 15,
                               3.31e-2 * rayleigh + 4.44e-3 * mie + 8.5e-5 * 15};
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(tau[c], expected[c], 1e-14);
}

// Rays that rise, that fall, and that turn at their lowest point between the distances.
TEST(OpticalDepth, ManyDistancesHaveTheBitsOfEach) {
    const Medium medium = test::preset_medium("earth_hillaire");
    for (const double mu : {1.0, 0.2, 0.0, -0.02, -0.05}) {
        const double length = distance_to_top_km(shell_of(medium), 20, 6380 * mu);
        std::vector<double> distances;
        for (const double share : {1e-8, 1e-3, 0.05, 0.2, 0.4, 0.7, 1.0}) {
            distances.push_back(share * length);
        }
        std::vector<double> depths(distances.size() * 3);
        optical_depth_along(medium, 20, mu, distances, depths.data());
        for (std::size_t i = 0; i < distances.size(); ++i) {
            const Spectrum wanted = optical_depth_along(medium, 20, mu, distances[i]);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(depths[c * distances.size() + i], wanted[c]) << mu << ' ' << distances[i];
            }
        }
    }
}

TEST(OpticalDepth, SegmentsAddUp) {
    const Medium earth = test::preset_medium("earth_hillaire");
    for (const double mu : {1.0, 0.3, 0.0, -0.05, -0.1}) {
        const double altitude = 40;
        const Shell shell = shell_of(earth);
        const double s = (6360 + altitude) * mu;
        const double length = distance_to_top_km(shell, altitude, s);
        const Spectrum whole = optical_depth_to_top(earth, altitude, s);
        for (const double share : {1e-9, 0.01, 0.3, 0.5, 0.9, 1.0}) {
            const Spectrum first = optical_depth_along(earth, altitude, mu, share * length);
            const double middle = altitude_along_km(shell, altitude, s, share * length);
            const Spectrum second =
                optical_depth_to_top(earth, std::min(middle, 100.0), s + share * length);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(first[c] + second[c], whole[c], 1e-11 * whole[c]) << mu << " " << share;
            }
        }
    }
}

// Same bits for every vector width that this machine and this build know.
TEST(OpticalDepth, HasTheSameBitsOnEveryTarget) {
    const Medium earth = test::preset_medium("earth_hillaire");
    std::vector<double> s;
    for (int i = 0; i < 61; ++i) s.push_back(-700 + 119.3 * i);
    std::vector<double> scalar(3 * s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Spectrum tau = optical_depth_to_top(earth, 41.7, s[i]);
        for (std::size_t c = 0; c < 3; ++c) scalar[c * s.size() + i] = tau[c];
    }
    int targets = 0;
    test::on_every_target([&](const char* target) {
        std::vector<double> vector(scalar.size());
        optical_depth_to_top(earth, 41.7, s.data(), static_cast<int>(s.size()), vector.data());
        EXPECT_EQ(vector, scalar) << target;
        ++targets;
    });
    EXPECT_GE(targets, 2);
}

}  // namespace
}  // namespace skybake
