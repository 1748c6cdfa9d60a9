// Bruneton's tables of colours, and how far colours bear what a runtime does with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <map>
#include <string>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/color/spectral_color.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/transcendental.h"
#include "config/assets/bruneton.h"
#include "tests/light/sky_media.h"
#include "tests/support/shared_bakes.h"
#include "tests/support/volumes.h"

namespace skybake::test {
namespace {

using testing::voxels_of;

constexpr const char* kSmall =
    "[bake.a]\nasset = 'bruneton'\npixel_type = 'float'\nsize = [16, 8, 4]\nnu_size = 4\n";
constexpr const char* kFlat = "[bake.a]\nasset = 'bruneton'\npixel_type = 'float'\n";

// Bakes of one test share what they are made from.
class BrunetonColors : public ::testing::Test {
  protected:
    Baked baked(const std::string& section, const std::vector<std::string>& settings) {
        const config::Recipe recipe = recipe_of("preset = 'earth'\n" + section, settings);
        return bakes_.baked(recipe, recipe.parameters.bakes.back());
    }

  private:
    SharedBakes bakes_;
};

// Each channel of a table of colours is the weighted sum of the channels of one of wavelengths.
void hold_to_wavelengths(const Baked& color, const Baked& light, std::size_t color_channel,
                         std::size_t weight, std::size_t first_light, double scale,
                         const std::string& what) {
    const std::vector<double>& weights = color.conventions.color->weights;
    const std::vector<float> colors = voxels_of(color, color_channel);
    std::vector<double> sums(colors.size());
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<float> one = voxels_of(light, first_light + k);
        for (std::size_t i = 0; i < one.size(); ++i) {
            sums[i] += weights[3 * k + weight] * double{one[i]} * scale;
            largest = std::max(largest, std::fabs(sums[i]));
        }
    }
    EXPECT_GT(largest, 0) << what;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        ASSERT_NEAR(colors[i], sums[i], 1e-6 * largest) << what << " " << i;
    }
}

TEST_F(BrunetonColors, AreWeightedSumsOfWavelengths) {
    const std::string sun = "solar_irradiance = [1, 2, 0.5]\n";
    for (const std::string& table :
         {std::string(kSmall) + "combined = false\n",
          std::string(kSmall) + "table = 'higher_orders'\norders = 2\n",
          std::string(kSmall) + "table = 'single_mie'\n",
          std::string(kFlat) + "table = 'irradiance'\nsize = [8, 4, 1]\n"}) {
        const Baked color = baked(table + sun, {"wavelengths='best 3'"});
        const Baked light = baked(table, {"wavelengths='best 3'", "color.space='none'"});
        ASSERT_TRUE(color.conventions.color->is_applied);
        EXPECT_EQ(color.channel_names, (std::vector<std::string>{"R", "G", "B"}));
        for (std::size_t c = 0; c < 3; ++c) {
            hold_to_wavelengths(color, light, c, c, 0, std::vector{1.0, 2.0, 0.5}[c], table);
        }
    }
}

// A of a combined table is the red of the Mie layers' colours.
TEST_F(BrunetonColors, AlphaIsTheRedOfSingleMie) {
    const Baked combined = baked(std::string(kSmall) + "orders = 1\ncombined = true\n", {});
    const Baked mie = baked(std::string(kSmall) + "table = 'single_mie'\n", {});
    EXPECT_EQ(combined.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(voxels_of(combined, 3), voxels_of(mie, 0));
}

TEST_F(BrunetonColors, TransmittanceIsTheShareOfSunlight) {
    const std::string table = std::string(kFlat) + "table = 'transmittance'\nsize = [16, 8, 1]\n";
    const Baked color = baked(table, {"wavelengths='best 3'"});
    const Baked light = baked(table, {"wavelengths='best 3'", "color.space='none'"});
    for (std::size_t c = 0; c < 3; ++c) {
        double white = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            white += color.conventions.color->weights.at(3 * k + c);
        }
        hold_to_wavelengths(color, light, c, c, 0, 1 / white, table);
    }
}

// Six wavelengths are two packets: four and two.
TEST_F(BrunetonColors, AreMadeOfAllPackets) {
    const std::string all = "'430 nm', '470 nm', '510 nm', '550 nm', '600 nm', '650 nm'";
    const std::string table = std::string(kSmall) + "table = 'single_mie'\n";
    const Baked color = baked(table, {"wavelengths=[" + all + "]", "color.space='linear_srgb'"});
    const auto light = [&](const std::string& three) {
        return baked(table, {"wavelengths=[" + three + "]", "color.space='none'"});
    };
    const Baked blue = light("'430 nm', '470 nm', '510 nm'");
    const Baked red = light("'550 nm', '600 nm', '650 nm'");
    const std::vector<double>& weights = color.conventions.color->weights;
    ASSERT_EQ(weights.size(), 18u);
    const std::vector<float> green = voxels_of(color, 1);
    for (std::size_t i = 0; i < green.size(); ++i) {
        double sum = 0;
        double scale = 0;
        for (std::size_t k = 0; k < 6; ++k) {
            const double one = voxels_of(k < 3 ? blue : red, k % 3)[i];
            sum += weights[3 * k + 1] * one;
            scale = std::max(scale, one);
        }
        ASSERT_NEAR(green[i], sum, 2e-4 * scale + 1e-9) << i;
        i += 12;  // every few texels are enough
    }
}

TEST_F(BrunetonColors, TakramsParametersAreThoseOfSunlight) {
    const std::string recipe =
        "wavelengths = 'best 4'\n"
        "[atmosphere]\nground_radius = '6360 km'\ntop_radius = '6420 km'\nground_albedo = 0.1\n"
        "[atmosphere.layers.air]\ngas = 'air'\npressure = '1013.25 hPa'\n"
        "profile = 'exponential'\nscale_height = '8 km'\nphase = 'rayleigh'\n"
        "[atmosphere.layers.haze]\noptical_depth = 0.1\nangstrom_exponent = 1\n"
        "single_scattering_albedo = 1\nprofile = 'exponential'\nscale_height = '1.2 km'\n"
        "phase = 'cornette_shanks'\ng = 0.8\n"
        "[bake.scattering]\nasset = 'bruneton'\nconvention = 'takram'\n"
        "size = [16, 8, 4]\nnu_size = 4\norders = 1\n";
    const config::Recipe parsed = recipe_of(recipe);
    const auto outcome = bake_asset(parsed, parsed.parameters.bakes.back(),
                                    {.threads = 2, .certification = Certification::off});
    ASSERT_TRUE(outcome.value && outcome.value->companion);
    EXPECT_EQ(outcome.value->channel_names.size(), 4u);
    const std::string& text = outcome.value->companion->text;
    const auto numbers = [&](const std::string& name) {
        const std::size_t at = text.find("\"" + name + "\": [") + name.size() + 5;
        glm::dvec3 found(0);
        EXPECT_EQ(std::sscanf(text.c_str() + at, "%lf, %lf, %lf", &found.x, &found.y, &found.z), 3)
            << name << text;
        return found;
    };
    // The weights make white of sunlight, and a haze that absorbs nothing has equal coefficients.
    const glm::dvec3 sun = numbers("solarIrradiance");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sun[c], 1, 0.03);
    EXPECT_EQ(numbers("mieScattering"), numbers("mieExtinction"));
    // Rayleigh's law is applied to the sun's light in very little air. In red little is left of it:
    // the light is bluer than any that screens show.
    std::vector<double> nm;
    std::vector<double> scattering;
    for (double at = 380; at <= 780; at += 5) {
        nm.push_back(at);
        scattering.push_back(0.0121 * std::pow(550 / at, 4.08));
    }
    const glm::dvec3 wanted = color_of(nm, scattering, ColorTarget{});
    const glm::dvec3 rayleigh = numbers("rayleighScattering");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rayleigh[c], wanted[c], 0.03 * wanted.z) << c;
}

// --- Spheres ------------------------------------------------------------------------------------

// Where phase functions differ between wavelengths, what a runtime makes of a texel is the colour
// of what it would make of the wavelengths.
TEST_F(BrunetonColors, MieLightIsThatOfItsOwnPhaseFunctions) {
    const config::Recipe recipe = recipe_of(
        "preset = 'earth'\n[particles.haze]\npreset = 'haze'\n"
        "[atmosphere.layers.spheres]\nprofile = 'exponential'\nscale_height = '1 km'\n"
        "phase = 'mie'\nparticles = 'haze'\nnumber_density = '100 /cm3'\n"
        "[bake.a]\nasset = 'bruneton'\ntable = 'single_mie'\nmie_layers = ['spheres']\n");
    const SkyMedium medium = make_sky_medium(recipe.parameters.atmosphere);
    const auto& bake = recipe.parameters.bakes.back().as<config::BrunetonBake>();
    const ScatteringContent packet(medium, bake);
    const std::vector<glm::dvec3> weights = {
        {0.05, -0.1, 0.9}, {-0.4, 0.7, 0.1}, {0.7, 0.4, -0.1}, {0.6, -0.05, 0.02}};
    const TableContent content({&packet}, weights, {1, 1, 1});
    ScatteringParts parts;
    parts.mie = {0.3, 0.2, 0.15, 0.1};
    for (const double nu : {-0.9, 0.2, 0.95}) {
        const Spectrum phase = packet.mie_phase(nu);
        ASSERT_GT(std::fabs(phase[0] / phase[3] - 1), 1e-3);
        glm::dvec3 wanted(0);
        for (std::size_t i = 0; i < 4; ++i) wanted += weights[i] * (parts.mie[i] * phase[i]);
        const Spectrum found = content.radiance(content.texel({&parts, 1}, nu), nu);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], wanted[static_cast<int>(c)], 1e-12);
        }
    }
}

// --- Products of colours ------------------------------------------------------------------------

// Clean continental air, whose figures the asset's page has.
constexpr const char* kCleanEarth =
    "preset = 'earth'\n"
    "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
    "[atmosphere.layers.ozone]\ncolumn = '300 DU'\nprofile = 'tent'\n"
    "center_altitude = '22 km'\nhalf_width = '19 km'\n"
    "[atmosphere.layers.aerosol]\noptical_depth = 0.064\nsingle_scattering_albedo = 0.972\n"
    "g = 0.709\n";

// Does as a runtime does with colours where only products of wavelengths are right: it divides the
// transmittances of two points to the top of the air by each other, and subtracts the light of the
// farther point times that from the light of the nearer one. The page of the asset has the errors.
class ProductsOfColors {
  public:
    ProductsOfColors()
        : parameters_(recipe_of(kCleanEarth).parameters),
          medium_(make_sky_medium(parameters_.atmosphere)),
          light_(solve_light(medium_, SolverSettings{}, 2)),
          orders_(medium_, light_, light_.degree()),
          integrator_(medium_, &orders_),
          weights_(colors_of({parameters_.wavelengths, *parameters_.color, parameters_.atmosphere},
                             {.threads = 2})
                       ->weights) {}

    // Adds the errors of the share of sunlight that a stretch lets through, and those of its own
    // light over luminance.
    void measure(double altitude_km, double sun_deg, double view_deg, double distance_km) {
        const Shell shell = shell_of(medium_.air);
        const SunZenith sun = {cosine_of_pi(0.5 - sun_deg / 180), cosine_of_pi(sun_deg / 180)};
        const SkyDirection view = sky_direction(sun, cosine_of_pi(0.5 - view_deg / 180),
                                                cosine_of_pi(view_deg / 180), 0.5);
        const SkyRay ray = sky_ray(shell, altitude_km, sun, view);
        if (distance_km >= ray.length_km || ray.meets_ground) return;
        const SkyRadiance near = integrator_.radiance(ray);
        const SkyRadiance first = integrator_.up_to(ray, {distance_km}).front();
        const Spectrum whole = near.single + near.multiple;
        const Spectrum part = first.single + first.multiple;
        const Spectrum rest = (whole - part) / first.transmittance;
        const glm::dvec3 white = color(Spectrum(1));
        const glm::dvec3 true_share = color(first.transmittance) / white;
        const glm::dvec3 quotient =
            color(near.transmittance) / color(near.transmittance / first.transmittance);
        shares[distance_km].push_back(largest(glm::abs(quotient - true_share)));
        const glm::dvec3 subtracted = color(whole) - quotient * color(rest);
        const glm::dvec3 wanted = color(part);
        lights[distance_km].push_back(largest(glm::abs(subtracted - wanted)) / luminance(wanted));
    }

    std::map<double, std::vector<double>> shares;  // by distance
    std::map<double, std::vector<double>> lights;

  private:
    static double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }
    static double luminance(const glm::dvec3& v) {
        return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
    }
    glm::dvec3 color(const Spectrum& light) const {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < weights_.size(); ++i) sum += weights_[i] * light[i];
        return sum;
    }

    config::Parameters parameters_;
    SkyMedium medium_;
    SolvedLight light_;
    SolvedOrders orders_;
    SkyIntegrator integrator_;
    std::vector<glm::dvec3> weights_;
};

struct Bars {
    double median, ninth_decile;
};

void hold(std::vector<double> errors, const Bars& bars, const std::string& what) {
    std::sort(errors.begin(), errors.end());
    EXPECT_GT(errors.size(), 20u);
    EXPECT_LE(errors[errors.size() / 2], bars.median) << what;
    EXPECT_LE(errors[errors.size() * 9 / 10], bars.ninth_decile) << what;
}

TEST_F(BrunetonColors, ProductsOfColoursHoldInTheMedianAlone) {
    ProductsOfColors products;
    for (const double altitude_km : {0.1, 2.0, 10.0}) {
        for (const double sun_deg : {50.0, 20.0, 5.0, 0.0}) {
            for (const double view_deg : {1.0, 5.0, 30.0}) {
                for (const double distance_km : {2.0, 10.0, 50.0}) {
                    products.measure(altitude_km, sun_deg, view_deg, distance_km);
                }
            }
        }
    }
    hold(products.shares[2], {0.001, 0.2}, "transmittance, 2 km");
    hold(products.shares[10], {0.003, 0.45}, "transmittance, 10 km");
    hold(products.shares[50], {0.01, 1.6}, "transmittance, 50 km");
    hold(products.lights[2], {0.1, 4.1}, "light, 2 km");
    hold(products.lights[10], {0.08, 2.1}, "light, 10 km");
    hold(products.lights[50], {0.04, 2.1}, "light, 50 km");
}

}  // namespace
}  // namespace skybake::test
