// Colours made of a few wavelengths, against those of whole spectra.
#include "bakers/light/sky_colors.h"
#include "config/sections/layer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/vector_double2.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/color/spectral_color.h"
#include "bakers/light/sky_spectra.h"
#include "bakers/math/hash.h"
#include "config/fields/wavelength_reader.h"
#include "tests/support/atmospheres.h"
#include "tests/support/shared_bakes.h"
#include "tests/support/volumes.h"

namespace skybake::test {
namespace {

config::Parameters mountain(const std::string& wavelengths) {
    return recipe_of("preset = 'earth_clear_mountain'\n", {"wavelengths='" + wavelengths + "'"})
        .parameters;
}

SkyColors colors(const config::Parameters& parameters) {
    return *colors_of({parameters.wavelengths, *parameters.color, parameters.atmosphere},
                      {.threads = 2});
}

// Bounds weights near 1 and errors near 3e-3: rows read higher orders at three nodes, rays at five.
constexpr double kRowsAgainstRays = 1e-4;

struct Bar {
    const char* wavelengths;
    double median, ninth_decile, disc;
};

// Returns the mountain's colours. Its spectra are solved for once: its gases are known at any wavelength.
SkyColors mountain_colors(const std::string& wavelengths) {
    const config::Parameters wanted = mountain(wavelengths);
    static const ColorSkies skies(wanted.atmosphere, wanted.wavelengths, {.threads = 2});
    // Wavelengths that a recipe lists come without [color].
    const config::Color color = wanted.color.value_or(config::Color());
    SkyColors found{skies.fitted_weights(wanted.wavelengths, color), {}};
    found.error = skies.error(wanted.wavelengths, color, found.weights);
    return found;
}

// The first two are goals, of the sun's disc too; three wavelengths are what they are.
TEST(SkyColors, FewWavelengthsComeNearWholeSpectra) {
    for (const Bar& bar : {Bar{"best 4", 5e-3, 1.5e-2, 2e-2}, Bar{"best 8", 1e-3, 3e-3, 5e-3},
                           Bar{"best 3", 4e-2, 8e-2, 5e-2}}) {
        const ColorError error = mountain_colors(bar.wavelengths).error;
        EXPECT_GT(error.skies, 100);
        EXPECT_LT(error.median, bar.median) << bar.wavelengths;
        EXPECT_LT(error.ninth_decile, bar.ninth_decile) << bar.wavelengths;
        for (const double disc : error.disc) EXPECT_LT(disc, bar.disc) << bar.wavelengths;
    }
}

// Later runs take kept colours for these.
TEST(SkyColors, AreThoseOfTheirVersion) {
    const SkyColors four = colors(mountain("best 4"));
    const auto* bytes = reinterpret_cast<const char*>(four.weights.data());
    EXPECT_EQ(kColorFitVersion, 2);
    EXPECT_EQ(xxh3_hex({bytes, four.weights.size() * sizeof(glm::dvec3)}),
              "73ff4c94f2d457c3251a2db3663a51fe")
        << "raise kColorFitVersion, and write both anew";
    const auto all = [](const ColorError& error) {
        return std::tuple(error.median, error.ninth_decile, error.max, error.disc, error.skies);
    };
    EXPECT_EQ(all(four.error), all(mountain_colors("best 4").error));
}

// A member that the key leaves out would give one air the colours of another.
TEST(SkyColors, HaveAKeyOfAllThatTheyDependOn) {
    const config::Parameters air = recipe_of("preset = 'earth_maritime'\n").parameters;
    ColorRequest request = {air.wavelengths, *air.color, air.atmosphere};
    config::Color& color = request.color;
    config::Atmosphere& whole = request.atmosphere;
    whole.ground_spectrum.resize(1);
    config::Layer& layer = whole.layers.at(0);
    layer.table.resize(1);
    layer.scattering.resize(1);
    layer.extinction.resize(1);
    layer.gas.emplace();
    layer.aerosol.emplace();
    config::LayerParticles& particles = layer.particles;
    config::SphereKind& kind = particles.kinds.at(0);
    config::Particles& spheres = kind.particles;
    std::set<std::string> keys = {key_text(request)};
    std::size_t changes = 1;
    const auto change_each = [&](auto&... members) {
        const auto change = [&](auto& value) {
            const auto before = value;
            if constexpr (requires { value.pop_back(); }) {
                value.pop_back();
            } else if constexpr (requires { value.reset(); }) {
                value ? value.reset() : void(value.emplace());
            } else if constexpr (std::is_class_v<std::decay_t<decltype(value)>>) {
                auto& [number] = value;
                number += 1;
            } else {
                using Number = std::decay_t<decltype(value)>;
                value = static_cast<Number>(value == Number{} ? 1 : 0);
            }
            keys.insert(key_text(request));
            ++changes;
            value = before;
        };
        (change(members), ...);
        EXPECT_EQ(keys.size(), changes) << sizeof...(members);
    };
    change_each(request.wavelengths, color.space, color.observer, color.sun, color.white);
    change_each(whole.ground_radius, whole.top_radius, whole.ground_albedo, whole.ground_spectrum,
                whole.ground_spectrum[0].wavelength, whole.ground_spectrum[0].value);
    change_each(layer.name, layer.enabled, layer.profile, layer.scale_height, layer.center_altitude,
                layer.half_width, layer.bottom_altitude, layer.top_altitude, layer.table,
                layer.table[0].altitude, layer.table[0].density, layer.scattering, layer.extinction,
                layer.phase, layer.g, layer.depolarization, layer.gas, layer.gas->gas,
                layer.gas->column, layer.aerosol, layer.aerosol->optical_depth,
                layer.aerosol->extinction, layer.aerosol->angstrom_exponent,
                layer.aerosol->single_scattering_albedo, particles.kinds, particles.optical_depth,
                particles.extinction, particles.wavelengths, particles.step);
    change_each(kind.number_density, spheres.name, spheres.material, spheres.refractive_index,
                spheres.absorption_index, spheres.indices, spheres.indices.at(0).wavelength,
                spheres.indices[0].real, spheres.indices[0].imaginary, spheres.sizes,
                spheres.radius, spheres.geometric_deviation, spheres.effective_radius,
                spheres.effective_variance, spheres.alpha, spheres.gamma, spheres.smallest_radius,
                spheres.largest_radius);
}

// Air between that of a mountain and that of a city, under any ozone and over any ground: none of
// these airs had a part in the choice of wavelengths (config/fields/wavelength_reader.cpp).
config::Parameters random_air(std::mt19937& generator, const std::string& wavelengths) {
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    };
    const double optical_depth = std::exp(uniform(std::log(0.01), std::log(1.0)));
    const std::string recipe = fmt::format(
        "wavelengths = '{}'\n[atmosphere]\nground_radius = '6371 km'\ntop_radius = '6471 km'\n"
        "ground_albedo = {}\n[atmosphere.layers.air]\ngas = 'air'\npressure = '{} hPa'\n"
        "profile = 'standard'\nphase = 'rayleigh'\n"
        "[atmosphere.layers.ozone]\ngas = 'ozone'\ncolumn = '{} DU'\nprofile = 'standard'\n"
        "[atmosphere.layers.haze]\n"
        "optical_depth = {}\nangstrom_exponent = {}\nsingle_scattering_albedo = {}\n"
        "profile = 'exponential'\nscale_height = '{} km'\nphase = 'cornette_shanks'\ng = {}\n",
        wavelengths, uniform(0, 0.8), uniform(550, 1040), uniform(100, 500), optical_depth,
        uniform(0, 2), uniform(0.8, 1), uniform(0.6, 4), uniform(0.5, 0.8));
    return recipe_of(recipe).parameters;
}

// The middle one of five airs holds the bars; in the worst, of very much haze, errors are up to six
// times as large. The disc is that of a sun at 5 degrees: lower ones are lost in such haze.
TEST(SkyColors, WavelengthsSuitAirsThatTheyWereNotChosenFor) {
    constexpr double kWorst = 6;
    const std::vector<std::pair<int, Bar>> bars = {{4, Bar{"best 4", 5e-3, 1.5e-2, 2e-2}},
                                                   {8, Bar{"best 8", 1e-3, 3e-3, 5e-3}}};
    std::vector<std::array<std::vector<double>, 3>> errors(bars.size());
    std::mt19937 generator(11);
    for (int i = 0; i < 5; ++i) {
        const config::Parameters air = random_air(generator, "best 4");
        const ColorSkies skies(air.atmosphere, air.wavelengths, {.threads = 2});
        for (std::size_t b = 0; b < bars.size(); ++b) {
            std::vector<config::Length> wavelengths;
            for (const double nm : config::best_wavelengths_nm(bars[b].first)) {
                wavelengths.push_back({nm / 1e9});
            }
            const config::Color& color = *air.color;
            const ColorError error =
                skies.error(wavelengths, color, skies.fitted_weights(wavelengths, color));
            errors[b][0].push_back(error.median / bars[b].second.median);
            errors[b][1].push_back(error.ninth_decile / bars[b].second.ninth_decile);
            errors[b][2].push_back(error.disc[0] / bars[b].second.disc);
        }
    }
    for (std::size_t b = 0; b < bars.size(); ++b) {
        for (std::vector<double>& each : errors[b]) {
            std::sort(each.begin(), each.end());
            EXPECT_LT(each[2], 1) << bars[b].second.wavelengths;
            EXPECT_LT(each[4], kWorst) << bars[b].second.wavelengths;
        }
    }
}

TEST(SkyColors, AllWavelengthsAreTheSpectrum) {
    const ColorError error = mountain_colors("380 nm..780 nm by 5 nm").error;
    EXPECT_LT(error.max, 1e-10);
}

TEST(SkyColors, TheSunOutsideTheAirIsWhite) {
    for (const char* wavelengths : {"best 3", "best 4", "best 8", "best 16"}) {
        glm::dvec3 sum(0);
        for (const glm::dvec3& weight : mountain_colors(wavelengths).weights) sum += weight;
        EXPECT_LT(glm::length(sum - glm::dvec3(1)), 0.03) << wavelengths;
    }
}

// Rows of rays that share their way give the colours of rays one by one. Rows read sunlight from a
// table, which rays integrate.
TEST(SkyColors, AreThoseOfRaysOneByOne) {
    for (const char* preset : {"earth", "earth_clear_mountain", "mars"}) {
        const config::Parameters air = recipe_of(fmt::format("preset = '{}'\n", preset)).parameters;
        const auto skies = [&](SpectrumRays rays) {
            return ColorSkies(sky_spectra(air.atmosphere, air.wavelengths, spectrum_views(),
                                          {.threads = 2}, rays));
        };
        const ColorSkies rows = skies(SpectrumRays::in_rows);
        const ColorSkies rays = skies(SpectrumRays::one_by_one);
        const auto found = rows.fitted_weights(air.wavelengths, *air.color);
        const auto wanted = rays.fitted_weights(air.wavelengths, *air.color);
        const ColorError of_rows = rays.error(air.wavelengths, *air.color, found);
        const ColorError of_rays = rays.error(air.wavelengths, *air.color, wanted);
        EXPECT_NEAR(of_rows.median, of_rays.median, kRowsAgainstRays) << preset;
        // People are told the largest error in hundredths of a per cent at most.
        EXPECT_NEAR(of_rows.max, of_rays.max, 5e-5) << preset;
        // In the dust of Mars weights may move by 2e-4 between neighbours that make the same colours.
        if (std::string(preset) == "mars") continue;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            for (glm::length_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(found[i][c], wanted[i][c], kRowsAgainstRays) << preset << i << c;
            }
        }
    }
}

// --- Where the eye looks first ---------------------------------------------------------------------

// x and y of the CIE's diagram.
glm::dvec2 chromaticity(const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

struct LookedAt {
    double sun_deg, above_deg, azimuth_deg;
};

// Returns for each view the chromaticity of the preset's wavelengths, and that of a spectrum at every
// fifth nm.
std::vector<std::array<glm::dvec2, 2>> chromaticities(const std::string& preset,
                                                      const std::vector<LookedAt>& looks) {
    const config::Parameters parameters =
        recipe_of("preset = '" + preset + "'\n", {"color.space='xyz'", "color.white='space'"})
            .parameters;
    std::vector<SpectrumView> views;
    for (const LookedAt& look : looks) {
        const double elevation = look.sun_deg / 180 * std::numbers::pi;
        views.push_back(
            {{std::sin(elevation), std::cos(elevation)}, look.above_deg, look.azimuth_deg});
    }
    const Spectra whole =
        sky_spectra(parameters.atmosphere, parameters.wavelengths, views, {.threads = 2});
    const Spectra few = at_wavelengths(whole, parameters.wavelengths);
    const SkyColors fitted = colors(parameters);
    std::vector<std::array<glm::dvec2, 2>> result;
    for (std::size_t v = 0; v < views.size(); ++v) {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < fitted.weights.size(); ++i) {
            sum += few[v][i] * fitted.weights[i];
        }
        const glm::dvec3 reference =
            color_of(spectrum_nm(), whole[v], {ColorSpace::xyz, White::own, Sunlight::measured});
        result.push_back({chromaticity(sum), chromaticity(reference)});
        EXPECT_NEAR(result[v][0].x, result[v][1].x, 2e-3) << preset << v;
        EXPECT_NEAR(result[v][0].y, result[v][1].y, 2e-3) << preset << v;
    }
    return result;
}

// CIEDE2000 of two colours in L*a*b* (CIE 142-2001; Sharma, Wu & Dalal 2005, "The CIEDE2000
// color-difference formula", Color Res. Appl. 30).
double ciede2000(const glm::dvec3& first, const glm::dvec3& second) {
    constexpr double kTurn = 2 * std::numbers::pi;
    constexpr double k25To7 = 6103515625;
    const auto share = [](double chroma) {
        return std::sqrt(std::pow(chroma, 7) / (std::pow(chroma, 7) + k25To7));
    };
    const double mean_chroma = (std::hypot(first.y, first.z) + std::hypot(second.y, second.z)) / 2;
    const double stretch = 1 + 0.5 * (1 - share(mean_chroma));
    const double c1 = std::hypot(stretch * first.y, first.z);
    const double c2 = std::hypot(stretch * second.y, second.z);
    const double h1 = std::atan2(first.z, stretch * first.y);
    const double turn = std::remainder(std::atan2(second.z, stretch * second.y) - h1, kTurn);
    const double h = h1 + turn / 2;
    const double l = (first.x + second.x) / 2 - 50;
    const double c = (c1 + c2) / 2;
    const double t = 1 - 0.17 * std::cos(h - kTurn / 12) + 0.24 * std::cos(2 * h) +
                     0.32 * std::cos(3 * h + kTurn / 60) - 0.2 * std::cos(4 * h - kTurn * 63 / 360);
    const double from_blue = std::remainder(h - kTurn * 275 / 360, kTurn) * 360 / kTurn / 25;
    const double rotation = -2 * share(c) * std::sin(kTurn / 6 * std::exp(-from_blue * from_blue));
    const double dl = (second.x - first.x) / (1 + 0.015 * l * l / std::sqrt(20 + l * l));
    const double dc = (c2 - c1) / (1 + 0.045 * c);
    const double dh = 2 * std::sqrt(c1 * c2) * std::sin(turn / 2) / (1 + 0.015 * c * t);
    return std::sqrt(dl * dl + dc * dc + dh * dh + rotation * dc * dh);
}

// Pairs 1, 9, 17 and 25 of Sharma's table.
TEST(Ciede2000, IsThatOfPublishedPairs) {
    EXPECT_NEAR(ciede2000({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, 1e-4);
    EXPECT_NEAR(ciede2000({50, 2.49, -0.001}, {50, -2.49, 0.0009}), 7.1792, 1e-4);
    EXPECT_NEAR(ciede2000({50, 2.5, 0}, {73, 25, -18}), 27.1492, 1e-4);
    EXPECT_NEAR(ciede2000({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644,
                1e-4);
}

// L*a*b* of a colour that is lit as the sun lights white, at a luminance of half that white.
glm::dvec3 lab(const glm::dvec3& xyz) {
    const glm::dvec3 share = xyz / (2 * xyz.y) / sun_xyz(Sunlight::measured);
    const auto root = [](double t) {
        constexpr double kDark = 6.0 / 29;
        return t > kDark * kDark * kDark ? std::cbrt(t) : t / (3 * kDark * kDark) + 4.0 / 29;
    };
    const glm::dvec3 f(root(share.x), root(share.y), root(share.z));
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

// The zenith of twilight is blue because ozone takes yellow light. The sun is x = 0.326.
TEST(SkyColors, OfTheTwilightZenithAreRight) {
    EXPECT_LT(chromaticities("earth", {{-4, 89, 90}})[0][1].x, 0.27);
}

// Dust of Mars absorbs blue light, and scatters it nearest to the sun's direction.
TEST(SkyColors, OfMarsByDayAndAtSunsetAreRight) {
    const auto found = chromaticities("mars", {{30, 60, 120}, {2, 2, 2}});
    EXPECT_GT(found[0][1].x, 0.36);
    EXPECT_LT(found[1][1].x, found[0][1].x - 0.05);
}

TEST(Packets, HaveFourWavelengthsAtMost) {
    const config::Parameters parameters = mountain("380 nm..420 nm by 5 nm");
    const std::vector<config::Atmosphere> packets = packets_of(parameters.atmosphere);
    ASSERT_EQ(packets.size(), 3u);
    EXPECT_EQ(packets[1].ground_albedo.size(), 4u);
    EXPECT_EQ(packets[2].ground_albedo.size(), 1u);
    EXPECT_EQ(packets[1].layers[0].scattering[0], parameters.atmosphere.layers[0].scattering[4]);
}

// --- Tables --------------------------------------------------------------------------------------

// Bakes of one test share what they are made from.
class OfColors : public ::testing::Test {
  protected:
    Baked baked(const config::Recipe& recipe) {
        return bakes_.baked(recipe, recipe.parameters.bakes.at(0));
    }
    Baked baked(const std::string& section, const std::vector<std::string>& settings) {
        return baked(recipe_of("preset = 'earth_clear_mountain'\n" + section, settings));
    }

    // The first row of froxels beyond the air, of each channel.
    std::vector<double> far_froxel(const std::string& content, const std::string& distance,
                                   const std::vector<std::string>& settings);

  private:
    SharedBakes bakes_;
};
using TablesOfColors = OfColors;
using VolumesOfColors = OfColors;
using TablesOfWavelengths = OfColors;

// A table of colours is the sum of the tables of its wavelengths.
TEST_F(TablesOfColors, AreWeightedSumsOfWavelengths) {
    for (const std::string section :
         {"[bake.sky_view]\nsize = [8, 8]\nsun_elevations = ['20 deg', '-3 deg']\n",
          "[bake.environment]\nsize = [8, 4]\nsun_elevation = '10 deg'\n",
          "[bake.irradiance]\nsize = [4, 4]\n"}) {
        const Baked color = baked(section, {"wavelengths='best 3'"});
        const Baked light = baked(section, {"wavelengths='best 3'", "color.space='none'"});
        ASSERT_TRUE(color.conventions.color);
        EXPECT_TRUE(color.conventions.color->is_applied);
        EXPECT_FALSE(light.conventions.color->is_applied);
        const std::vector<double>& weights = color.conventions.color->weights;
        const auto& colors = color.image().texels;
        const auto& lights = light.image().texels;
        ASSERT_EQ(colors.size(), lights.size());
        for (std::size_t i = 0; i < colors.size(); i += 3) {
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = 0;
                double scale = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    sum += weights[3 * k + c] * lights[i + k];
                    scale = std::max(scale, double{lights[i + k]});
                }
                EXPECT_NEAR(colors[i + c], sum, 1e-6 * scale) << section << i;
            }
        }
    }
}

// Skies with the air's own profile, from noon to the end of civil twilight; and at dusk the fit to this
// air is nearer than one to the same amounts of air and ozone in smooth layers.
TEST_F(TablesOfColors, OfFourWavelengthsLookLikeThoseOfEight) {
    const std::vector<std::string> smooth = {
        "atmosphere.layers.air.profile='exponential'", "atmosphere.layers.air.scale_height='8 km'",
        "atmosphere.layers.ozone.profile='tent'", "atmosphere.layers.ozone.center_altitude='25 km'",
        "atmosphere.layers.ozone.half_width='15 km'"};
    const auto recipe = [](const char* wavelengths, const char* space, const char* sun,
                           std::vector<std::string> settings) {
        settings.push_back(std::string("wavelengths='") + wavelengths + "'");
        settings.push_back(std::string("color.space='") + space + "'");
        settings.push_back(std::string("bake.sky_view.sun_elevations=['") + sun + "']");
        return recipe_of(
            "preset = 'earth'\n[color]\nwhite = 'space'\n"
            "[bake.sky_view]\nsize = [6, 8]\naltitude = '500 m'\n",
            settings);
    };
    const auto weights_in = [&](const std::vector<std::string>& settings) {
        return colors(recipe("best 4", "xyz", "2 deg", settings).parameters).weights;
    };
    const auto own = weights_in({});
    const auto of_smooth = weights_in(smooth);
    for (const char* sun : {"30 deg", "2 deg", "-3 deg", "-6 deg"}) {
        const Baked light = baked(recipe("best 4", "none", sun, {}));
        const Baked eight = baked(recipe("best 8", "xyz", sun, {}));
        const auto largest_difference = [&](const std::vector<glm::dvec3>& weights) {
            double largest = 0;
            testing::for_each_texel(6, 8, [&](int x, int y) {
                const float* radiance = light.image().texel(x, y);
                glm::dvec3 sum(0);
                for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * double{radiance[k]};
                const float* right = eight.image().texel(x, y);
                largest = std::max(largest, ciede2000(lab({sum.x, sum.y, sum.z}),
                                                      lab({right[0], right[1], right[2]})));
            });
            return largest;
        };
        EXPECT_LT(largest_difference(own), 1) << sun;
        if (sun[0] != '-') continue;
        EXPECT_LT(largest_difference(own), 0.97 * largest_difference(of_smooth)) << sun;
    }
}

TEST_F(TablesOfColors, HaveThreeChannelsOfAnyNumberOfWavelengths) {
    const Baked table = baked("[bake.irradiance]\nsize = [4, 4]\n", {"wavelengths='best 8'"});
    EXPECT_EQ(table.channel_names, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(table.conventions.wavelengths_nm.size(), 8u);
    EXPECT_EQ(table.conventions.color->weights.size(), 24u);
}

std::vector<double> OfColors::far_froxel(const std::string& content, const std::string& distance,
                                         const std::vector<std::string>& settings) {
    const Baked volume = baked(
        "[bake.aerial]\nasset = 'aerial_perspective'\nsize = [1, 1, 2]\n"
        "altitude = '500 m'\nsun_elevation = '10 deg'\npitch = '36 deg'\n"
        "slices = 'linear'\ncontent = '" +
            content + "'\nview_distance = '" + distance + "'\n",
        settings);
    const auto values = testing::planes_of(*volume.levels.front().voxels, {{0, 0, 1}, {1, 1, 1}},
                                           volume.channel_names.size());
    std::vector<double> voxel;
    for (const std::vector<float>& value : values) voxel.push_back(double{value.front()});
    return voxel;
}

// Beyond the air its light is the sky, whose colours the environment has in the same direction: 36
// degrees up and straight ahead is the middle of the second of five rows.
TEST_F(VolumesOfColors, HoldTheSkysColoursFarAway) {
    for (const char* wavelengths : {"wavelengths='best 4'", "wavelengths='best 8'"}) {
        const Baked sky = baked(
            "[bake.environment]\nsize = [3, 5]\naltitude = '500 m'\nsun_elevation = '10 deg'\n",
            {wavelengths});
        const std::vector<double> air = far_froxel("in_scatter", "2000 km", {wavelengths});
        ASSERT_EQ(air.size(), 3u);
        for (std::size_t c = 0; c < 3; ++c) {
            const double wanted{sky.image().texel(1, 1)[c]};
            EXPECT_NEAR(air[c], wanted, 2e-3 * wanted) << wavelengths << " " << c;
        }
    }
}

// Air that is not there takes nothing from light, under any convention of white. A way through
// much of it takes most from blue light, and A is the mean of the other channels.
TEST_F(VolumesOfColors, TransmittanceIsTheShareOfSunlight) {
    for (const char* white : {"color.white='sun'", "color.white='space'"}) {
        for (const double value : far_froxel("transmittance", "1 mm", {white})) {
            EXPECT_NEAR(value, 1, 1e-6) << white;
        }
        const std::vector<double> far = far_froxel("transmittance", "2000 km", {white});
        ASSERT_EQ(far.size(), 3u);
        EXPECT_LT(far[0], 0.97) << white;
        EXPECT_LT(far[1], far[0]) << white;
        EXPECT_LT(far[2], 0.95 * far[1]) << white;
        const std::vector<double> both =
            far_froxel("in_scatter_and_transmittance", "2000 km", {white});
        ASSERT_EQ(both.size(), 4u);
        EXPECT_NEAR(both[3], (far[0] + far[1] + far[2]) / 3, 1e-6) << white;
    }
}

TEST_F(TablesOfWavelengths, HaveFourChannelsAndTheWeightsOfLight) {
    const Baked factor = baked("[bake.transmittance]\nsize = [8, 8]\n", {});
    EXPECT_EQ(factor.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(factor.conventions.wavelengths_nm.size(), 4u);
    EXPECT_FALSE(factor.conventions.color) << "it multiplies light, which has the weights";
    const Baked table =
        baked("[bake.multiple_scattering]\nmethod = 'converged'\nsize = [8, 8]\n", {});
    EXPECT_EQ(table.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
    ASSERT_TRUE(table.conventions.color);
    EXPECT_FALSE(table.conventions.color->is_applied);
    EXPECT_EQ(table.conventions.color->weights.size(), 12u);
}

TEST(ColorGlsl, HasTheWeightsOfEachWavelengthAsAVector) {
    const ColorConvention color = {"linear_srgb", "sun", "measured",
                                   "cie_1931",    false, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12.5}};
    const std::string text = color_glsl(color, {446, 525, 576, 637}, false, "baked_sky");
    EXPECT_NE(
        text.find("vec3 baked_sky_color(vec4 light) {\n    return light.x * vec3(1.0, 2.0, 3.0)\n"
                  "         + light.y * vec3(4.0, 5.0, 6.0)\n"
                  "         + light.z * vec3(7.0, 8.0, 9.0)\n"
                  "         + light.w * vec3(10.0, 11.0, 12.5);\n}"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("light at 446, 525, 576, 637"), std::string::npos) << text;
}

TEST(ColorGlsl, OfAPacketSaysThatOthersAddToIt) {
    const ColorConvention color = {"linear_srgb", "sun", "measured", "cie_1931", false, {1, 2, 3}};
    const std::string text = color_glsl(color, {446}, true, "baked_sky_3");
    EXPECT_NE(text.find("vec3 baked_sky_3_color(float light) {\n"
                        "    return light * vec3(1.0, 2.0, 3.0);\n}"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("other packets"), std::string::npos) << text;
}

}  // namespace
}  // namespace skybake::test
