#include <gtest/gtest.h>

#include "bakers/air/forward_peak.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/field/baked.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_irradiance.h"
#include "bakers/math/quadrature.h"
#include "config/assets/irradiance.h"
#include "tests/light/sky_media.h"
#include "tests/support/bakes.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

// Returns the table that a baker is given before it makes one.
Baked colours() {
    Baked table;
    table.channel_names = {"R", "G", "B"};
    return table;
}

using config::SkyOrders;
using test::kDegree;
using test::TestSky;

// The integral over the hemisphere by other nodes: evenly spaced azimuths, Gauss in the cosine.
Spectrum brute_force(const SkyLight& light, double altitude_km, const SunZenith& sun) {
    const QuadratureRule rule = gauss_legendre(32);
    constexpr int kAzimuths = 48;
    Spectrum sum{};
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double mu = rule.nodes[i];
        for (int k = 0; k < kAzimuths; ++k) {
            const double azimuth = std::numbers::pi * (k + 0.5) / kAzimuths;
            const SkyDirection direction =
                sky_direction(sun, mu, std::sqrt(1 - mu * mu), std::cos(azimuth));
            const Spectrum radiance =
                light.wanted(light.integrator().radiance(altitude_km, sun, direction));
            const double weight = rule.weights[i] * mu * 2 * std::numbers::pi / kAzimuths;
            sum += weight * radiance;
        }
    }
    return sum;
}

TEST(SkyIrradiance, IsTheIntegralOverTheSky) {
    for (const char* preset : {"earth_hillaire", "tiny_planet"}) {
        const TestSky sky(test::preset_atmosphere(preset), SkyOrders::all);
        for (const double elevation : {90.0, 40.0, 2.0, -5.0}) {
            const SunZenith sun = sun_at_elevation(elevation * kDegree);
            const Spectrum wanted = brute_force(sky.light(), 0.5, sun);
            const Spectrum found = sky_irradiances(sky.light(), 0.5, {sun.cosine}, {16}).front();
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(found[c] / wanted[c], 1, 4e-3) << preset << ' ' << elevation;
            }
        }
    }
}

TEST(SkyIrradiance, PartsAddUp) {
    const config::Atmosphere earth = test::preset_atmosphere("earth_hillaire");
    const TestSky all(earth, SkyOrders::all);
    const TestSky rest(earth, SkyOrders::multiple);
    const TestSky mie(earth, SkyOrders::single, {"mie"});
    const TestSky rayleigh(earth, SkyOrders::single, {"rayleigh"});
    const auto of = [](const TestSky& sky) {
        return sky_irradiances(sky.light(), 3, {0.4}, {8}).front();
    };
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(of(rest)[c] + of(mie)[c] + of(rayleigh)[c], of(all)[c], 1e-13);
    }
}

// Sharing between surfaces at one altitude changes nothing.
TEST(SkyIrradiance, UnderManySunsIsThatUnderEach) {
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet"}) {
        const TestSky sky(test::preset_atmosphere(preset), SkyOrders::all);
        const Medium& air = sky.light().medium().air;
        for (const double altitude_km : {0.0, 0.03 * air.thickness_km, 0.4 * air.thickness_km}) {
            std::vector<double> suns;
            for (const double elevation : {70.0, 8.0, -1.0, 0.0, -3.0, 30.0}) {
                suns.push_back(sun_at_elevation(elevation * kDegree).cosine);
            }
            const std::vector<Spectrum> together =
                sky_irradiances(sky.light(), altitude_km, suns, {8, 8, 4});
            for (std::size_t i = 0; i < suns.size(); ++i) {
                const Spectrum alone =
                    sky_irradiances(sky.light(), altitude_km, {suns[i]}, {8, 8, 4}).front();
                EXPECT_EQ(together[i], alone) << preset << ' ' << suns[i];
            }
        }
    }
}

TEST(SkyIrradiance, IsNothingAtTheTopInVacuumAndAtNight) {
    EXPECT_EQ(sky_irradiances(test::earth().light(), 100, {0.5}, {6}).front(), Spectrum{});
    const TestSky vacuum(test::preset_atmosphere("vacuum"), SkyOrders::all);
    EXPECT_EQ(sky_irradiances(vacuum.light(), 0, {0.5}, {6}).front(), Spectrum{});
    const TestSky single(test::preset_atmosphere("earth_hillaire"), SkyOrders::single);
    EXPECT_EQ(sky_irradiances(single.light(), 0, {-1}, {6}).front(), Spectrum{});
    for (const double mu : {-1.0, -0.1, 0.0, 1e-12, 1.0}) {
        const Spectrum irradiance = sky_irradiances(test::earth().light(), 0, {mu}, {6}).front();
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            EXPECT_TRUE(std::isfinite(irradiance[c]) && irradiance[c] >= 0) << mu;
        }
    }
}

// The solver finds the irradiance of the ground by its own directions, with its own rays.
TEST(SkyIrradiance, IsThatOfTheSolvedLightAtTheGround) {
    const SkyLight light(test::preset_atmosphere("earth_hillaire"), SkyOrders::all, {}, {});
    for (const double mu : {1.0, 0.5, 0.1, 0.0, -0.05}) {
        const Spectrum wanted = light.higher_orders()->sky_irradiance(mu);
        const Spectrum found = sky_irradiances(light, 0, {mu}, {16}).front();
        for (std::size_t c = 0; c < 3; ++c) {
            // It looks in few directions: haze about a high sun costs it a thousandth of sunlight.
            EXPECT_NEAR(found[c], wanted[c], 0.004 * wanted[c] + 1e-3) << mu;
        }
    }
}

// Light scattered before, of the twelfth degree in the azimuth.
class TwelveFold : public HigherOrders {
  public:
    explicit TwelveFold(double share) : share_(share) {}
    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering) const override {
        return scattering[0] * (1 + share_ * std::cos(12 * std::acos(point.azimuth_cosine)));
    }
    Spectrum sky_irradiance(double) const override { return {}; }
    int azimuth_degree() const override { return 12; }

  private:
    double share_;
};

// Over all azimuths it cancels, which three or six of them do not see.
TEST(SkyIrradiance, HasAzimuthsForTheDegreeOfLightScatteredBefore) {
    const auto irradiance = [](double share) {
        const SkyLight light(
            make_sky_medium(test::preset_atmosphere("earth_hillaire", {"atmosphere.top_radius="
                                                                       "'6361 km'"})),
            SkyOrders::multiple, std::make_unique<TwelveFold>(share));
        return sky_irradiances(light, 0, {0.5}, {.single = 4, .zenith_angles = 6, .azimuths = 3})
            .front();
    };
    const Spectrum with = irradiance(1);
    const Spectrum without = irradiance(0);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(with[c] / without[c], 1, 0.01);
}

// Light from the peaks around the sun is either the sky's or the sun's: their sum is that of air
// in which peaks count as not scattered, by the same directions.
TEST(SkyIrradiance, PeaksBelongToTheSkyOrToTheSun) {
    const config::Atmosphere fog = test::earth_with_drops().parameters.atmosphere;
    const SkyLight light(fog, SkyOrders::all, {}, {.threads = 2});
    ASSERT_TRUE(light.has_peaks());
    // Its sunlight passes through air without peaks.
    const SkyLight once(light.medium(), SkyOrders::all, nullptr);
    const auto solved = light_of({.atmosphere = fog}, light.medium(), {.threads = 2});
    const SkyLight rest(light.medium(), SkyOrders::multiple,
                        std::make_unique<SolvedOrders>(light.medium(), *solved, solved->degree()));
    const IrradianceNodes nodes{8, 6, 3};
    for (const double mu : {0.9, 0.3}) {
        const Spectrum sun = sun_irradiance(light, 0.2, mu);
        const Spectrum sun_of_once = sun_irradiance(once, 0.2, mu);
        EXPECT_GT(sun_of_once[1], 1.05 * sun[1]);
        const Spectrum found = sun + sky_irradiances(light, 0.2, {mu}, nodes).front();
        const Spectrum wanted = sun_of_once + sky_irradiances(once, 0.2, {mu}, nodes).front() +
                                sky_irradiances(rest, 0.2, {mu}, nodes).front();
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 1e-9) << mu;
    }
}

// For closed forms the peak is what moments up to a degree leave out: which degree that is, is no
// matter of the light on the ground. Thin haze scatters hardly any light twice.
TEST(SkyIrradiance, IsTheSameWhateverCountsAsPeak) {
    const SkyMedium haze =
        test::haze_alone("g = 0.97\nscattering = '0.02 /km'\nextinction = '0.02 /km'\n");
    std::vector<double> sums;
    for (const int degree : {16, 32}) {
        const SkyLight light(delta_scaled(haze, degree), SkyOrders::all, nullptr);
        sums.push_back(sun_irradiance(light, 0, 0.6)[0] +
                       sky_irradiances(light, 0, {0.6}, {.single = 28}).front()[0]);
    }
    EXPECT_NEAR(sums[0], sums[1], 1e-3);
}

// Dust of an optical depth of 0.5 up to where the air ends: light scattered before is as sharp at
// the horizon as light scattered once, so that the finest level looks in as many directions.
TEST(IrradianceTable, HoldsItsErrorInTheDustOfMars) {
    const SkyLight light(test::preset_atmosphere("mars_rgb"), SkyOrders::multiple, {}, {});
    config::IrradianceBake bake;
    bake.size = {8, 2};
    bake.content = config::IrradianceContent::sky;
    bake.orders = SkyOrders::multiple;
    bake.max_texel_error = 0.002;
    const auto table = bake_irradiance(light, bake, {.threads = 2}, colours());
    ASSERT_TRUE(table.value) << table.diagnostics.at(0).message;
    EXPECT_LE(table.value->certificate.texel.max, 0.002);
}

TEST(SunIrradiance, IsTheCosineTimesTheTransmittance) {
    const TestSky vacuum(test::preset_atmosphere("vacuum"), SkyOrders::single);
    EXPECT_EQ(sun_irradiance(vacuum.light(), 0, 0.25), Spectrum(0.25));
    EXPECT_EQ(sun_irradiance(vacuum.light(), 50, -0.01), Spectrum{});
    EXPECT_EQ(sun_irradiance(vacuum.light(), 0, 0), Spectrum{});
}

TEST(IrradianceTable, HoldsItsErrorAndAddsUp) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::single);
    config::IrradianceBake bake;
    bake.size = {12, 4};
    bake.orders = SkyOrders::single;
    bake.max_texel_error = 0.005;
    const auto table = [&](config::IrradianceContent content) {
        bake.content = content;
        return bake_irradiance(sky.light(), bake, {.threads = 2}, colours());
    };
    const auto direct = table(config::IrradianceContent::direct);
    const auto diffuse = table(config::IrradianceContent::sky);
    const auto total = table(config::IrradianceContent::total);
    ASSERT_TRUE(direct.value && diffuse.value && total.value);
    EXPECT_LE(diffuse.value->certificate.texel.max, 0.005);
    EXPECT_LT(direct.value->certificate.texel.max, 1e-6);
    const double brightest =
        *std::max_element(total.value->image().texels.begin(), total.value->image().texels.end());
    for (std::size_t i = 0; i < total.value->image().texels.size(); ++i) {
        const double sum =
            double{direct.value->image().texels[i]} + double{diffuse.value->image().texels[i]};
        // Each within half a percent of itself or of a thousandth of the largest.
        EXPECT_NEAR(total.value->image().texels[i], sum, 0.01 * sum + 1e-5 * brightest);
    }
    const Shell& shell = sky.light().shell();
    EXPECT_DOUBLE_EQ(irradiance_coordinate(shell, irradiance_altitude_km(shell, 0.3)), 0.3);
}

// Four texels of sunlight, and a table as it is by default: only one of them warns.
TEST(Irradiance, LookupsThatAreFarOffAreWarnedOf) {
    const auto codes = [](const std::string& size) {
        const auto baked = test::bake_first(
            "preset = \"earth_hillaire\"\n[bake.irradiance]\ncontent = \"direct\"\n" + size);
        EXPECT_TRUE(baked.value);
        return test::codes_of(baked.diagnostics);
    };
    EXPECT_EQ(codes("size = [2, 2]\n"), "W0214 ");
    EXPECT_EQ(codes(""), "");
}

// The line of the key that a diagnostic names: of one that is too strict, and of the size.
TEST(Irradiance, FaultsOfABakeNameTheirLine) {
    const auto fault = [](const std::string& section) {
        return test::bake_first("preset = \"earth_hillaire\"\n" + section).diagnostics.at(0);
    };
    const config::Diagnostic strict =
        fault("[bake.transmittance]\npixel_type = \"half\"\nmax_error = 1e-7\n");
    EXPECT_EQ(strict.code, "E0403");
    EXPECT_EQ(strict.where.source, "test.toml");
    EXPECT_EQ(strict.where.line, 4);
    const config::Diagnostic coarse =
        fault("[bake.irradiance]\ncontent = \"direct\"\nsize = [2, 2]\n");
    EXPECT_EQ(coarse.code, "W0214");
    EXPECT_EQ(coarse.where.line, 4);
}

// Air of a depth of 80000 and air 60000 times as high as its planet is wide, whose light would be
// solved for in hours; their sunlight is a closed form.
TEST(Irradiance, OfAirThatIsTooOpaqueOrTooHighIsRefused) {
    const auto bake = [](const std::string& keys, const std::vector<std::string>& settings) {
        return test::bake_first(
            "preset = \"earth_hillaire\"\n[bake.irradiance]\nsize = [2, 2]\n" + keys,
            {.threads = 1, .certification = Certification::off}, settings);
    };
    const std::vector<std::vector<std::string>> airs = {
        {"atmosphere.layers.rayleigh.scattering=\"10 /m\""},
        {"atmosphere.ground_radius=\"1 m\"", "atmosphere.top_radius=\"60 km\""}};
    for (const std::vector<std::string>& air : airs) {
        EXPECT_EQ(test::expect_refused(bake("", air), "E0405").where.line, 3);
        EXPECT_TRUE(bake("content = \"direct\"\n", air).value);
    }
}

}  // namespace
}  // namespace skybake
