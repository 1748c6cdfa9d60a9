#include "bakers/render/screen_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bakers/color/color_space.h"
#include "bakers/color/spectral_color.h"
#include "bakers/render/sun_disc.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

Image2<float> texel_of(const std::vector<float>& values) {
    Image2<float> image(1, 1, static_cast<int>(values.size()));
    image.texels = values;
    return image;
}

Conventions colors_in(const std::string& space, const std::string& white) {
    Conventions conventions;
    conventions.wavelengths_nm = {446, 525, 576, 637};
    conventions.color = ColorConvention{space, white, "measured", "cie_1931", true, {}};
    return conventions;
}

void expect_near(const Image2<float>& image, const glm::dvec3& wanted, double tolerance) {
    ASSERT_EQ(image.channels, 3);
    EXPECT_NEAR(double{image.texels[0]}, wanted.x, tolerance);
    EXPECT_NEAR(double{image.texels[1]}, wanted.y, tolerance);
    EXPECT_NEAR(double{image.texels[2]}, wanted.z, tolerance);
}

TEST(ScreenColor, ShowsOneOrThreeWavelengthsAsTheyAre) {
    Conventions conventions;
    conventions.wavelengths_nm = {680, 550, 440};
    const Image2<float> rgb = texel_of({0.25f, 0.5f, 1.0f});
    EXPECT_EQ(ScreenColor(conventions, 3).shown(rgb).texels, rgb.texels);
    EXPECT_EQ(ScreenColor(conventions, 3).words(), ScreenColor().words());
    conventions.wavelengths_nm = {550};
    EXPECT_EQ(ScreenColor(conventions, 1).shown(texel_of({0.5f})).channels, 1);
}

// The same light in any space is the same on the screen.
TEST(ScreenColor, CarriesColoursOfAnySpaceToLinearSrgb) {
    const glm::dvec3 light(0.3, 0.9, 0.2);  // XYZ
    const glm::dvec3 sun = sun_xyz(Sunlight::measured);
    for (const ColorSpace space : all_color_spaces()) {
        for (const auto& [name, white] : {std::pair{"sun", White::sun}, {"space", White::own}}) {
            const glm::dvec3 wanted = from_xyz(ColorSpace::linear_srgb, white, sun) * light;
            const glm::dvec3 stored = from_xyz(space, white, sun) * light;
            const Image2<float> texel =
                texel_of({static_cast<float>(stored.x), static_cast<float>(stored.y),
                          static_cast<float>(stored.z)});
            const ScreenColor screen(colors_in(std::string(to_string(space)), name), 3);
            // Under Bradford's adaptation cones are scaled, under XYZ's the values themselves, so
            // colours far from white differ there.
            const bool differs = space == ColorSpace::xyz && white == White::sun;
            SCOPED_TRACE(to_string(space));
            expect_near(screen.shown(texel), wanted, differs ? 0.1 : 1e-6);
            if (white == White::sun)
                expect_near(screen.shown(texel_of({1, 1, 1})), {1, 1, 1}, 1e-6);
        }
    }
}

TEST(ScreenColor, SumsWavelengthsWithTheFilesWeights) {
    Conventions conventions = colors_in("linear_srgb", "sun");
    conventions.color->is_applied = false;
    conventions.color->weights = {0, 0, 1, 0, 0.75, 0, 0.5, 0.25, 0, 0.5, 0, 0};
    const ScreenColor screen(conventions, 4);
    expect_near(screen.shown(texel_of({8, 4, 2, 1})), {1.5, 3.5, 8}, 1e-5);
    EXPECT_NE(screen.words().find("446, 525, 576, 637 nm become"), std::string::npos);
    // The weights of a wider space lead to the same colours.
    const glm::dvec3 sun = sun_xyz(Sunlight::measured);
    const glm::dmat3 wider = from_xyz(ColorSpace::rec2020, White::sun, sun) *
                             glm::inverse(from_xyz(ColorSpace::linear_srgb, White::sun, sun));
    std::vector<double>& weights = conventions.color->weights;
    for (std::size_t i = 0; i < weights.size(); i += 3) {
        const glm::dvec3 weight = wider * glm::dvec3(weights[i], weights[i + 1], weights[i + 2]);
        weights[i] = weight.x;
        weights[i + 1] = weight.y;
        weights[i + 2] = weight.z;
    }
    conventions.color->space = "rec2020";
    expect_near(ScreenColor(conventions, 4).shown(texel_of({8, 4, 2, 1})), {1.5, 3.5, 8}, 1e-5);
    // A file with too few weights is shown without them.
    weights.resize(9);
    EXPECT_NE(ScreenColor(conventions, 4).words().find("linear between them"), std::string::npos);
}

// Without weights the order of wavelengths does not matter, equal light is white, and long waves
// are red.
TEST(ScreenColor, TakesOtherNumbersOfWavelengthsAsASpectrum) {
    Conventions conventions;
    conventions.wavelengths_nm = {637, 446, 576, 525};
    const ScreenColor screen(conventions, 4);
    expect_near(screen.shown(texel_of({1, 1, 1, 1})), {1, 1, 1}, 2e-3);
    const std::vector<float> red = screen.shown(texel_of({1, 0, 0, 0})).texels;
    EXPECT_GT(red[0], 3 * std::fabs(red[1]));
    EXPECT_GT(red[0], 3 * std::fabs(red[2]));
    const std::vector<float> blue = screen.shown(texel_of({0, 1, 0, 0})).texels;
    EXPECT_GT(blue[2], 3 * std::fabs(blue[0]));
    EXPECT_GT(blue[2], 3 * std::fabs(blue[1]));
    conventions.wavelengths_nm = {450, 620};
    expect_near(ScreenColor(conventions, 2).shown(texel_of({1, 1})), {1, 1, 1}, 2e-3);
}

TEST(ScreenColor, KeepsNotANumber) {
    Conventions conventions;
    conventions.wavelengths_nm = {446, 525, 576, 637};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float value : ScreenColor(conventions, 4).shown(texel_of({1, nan, 1, 1})).texels) {
        EXPECT_TRUE(std::isnan(value));
    }
}

// Three and four wavelengths, whose lists begin with the shortest, show a blue sky by day and at
// dusk and a warm sun, and agree with each other.
TEST(ScreenColor, SkiesOfTheBestWavelengthsHaveTheColoursOfSkies) {
    const test::Sky three = test::sky_of("earth_clear_mountain", {"wavelengths=\"best 3\""});
    const test::Sky four = test::sky_of("earth_clear_mountain", {"wavelengths=\"best 4\""});
    for (const double sun : {40.0, -4.0}) {
        std::vector<glm::dvec3> zeniths;
        for (const test::Sky* sky : {&three, &four}) {
            const SkyView view = test::dome(9, 0.2, sun);
            const Image2<float> shown =
                sky->tables.screen.shown(render_sky(sky->medium, sky->tables, view, 1));
            const float* zenith = shown.texel(4, 4);
            EXPECT_GT(zenith[2], 1.3f * zenith[1]) << sun;
            EXPECT_GT(zenith[1], 1.1f * zenith[0]) << sun;
            zeniths.emplace_back(zenith[0], zenith[1], zenith[2]);
        }
        // Their largest errors over luminance are 8.1 and 1.4 % (examples/colors.md).
        const double luminance = glm::dot(zeniths[1], glm::dvec3(0.2126, 0.7152, 0.0722));
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(zeniths[0][c], zeniths[1][c], 0.095 * luminance) << sun << " " << c;
        }
    }
    SkyView low = test::panorama(2048, 0.2, 2);
    low.lowest_degrees = 0;
    low.highest_degrees = 4;
    low.height = 64;
    for (const test::Sky* sky : {&three, &four}) {
        Image2<float> radiance(low.width, low.height, sky->tables.transmittance.channels);
        add_sun(sky->medium, sky->tables, low, Glare::none, radiance);
        const Image2<float> shown = sky->tables.screen.shown(radiance);
        const float* disc = shown.texel(low.width / 2, low.height / 2);
        EXPECT_GT(disc[0], 1.3f * disc[1]);
        EXPECT_GT(disc[1], 1.5f * disc[2]);
    }
}

}  // namespace
}  // namespace skybake
