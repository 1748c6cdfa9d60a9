// Light where directions coincide that are otherwise apart: the view, the sun, the zenith, the nadir
// and the horizon. Formulas divide by sines of angles between them. Light is continuous in the sun's
// place, so each table must be that of a sun a ten-thousandth of a degree away.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "config/assets/asset_kind.h"
#include "tests/light/sky_media.h"
#include "tests/support/shared_bakes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

// Nothing is too dark to count: a ray that is lit by mistake is brighter than its like by any factor.
void expect_alike(const Baked& on_axis, const Baked& beside, const std::string& name) {
    const auto exact = testing::planes_of(on_axis);
    const auto near = testing::planes_of(beside);
    ASSERT_EQ(exact.size(), near.size()) << name;
    for (std::size_t c = 0; c < exact.size(); ++c) {
        ASSERT_EQ(exact[c].size(), near[c].size()) << name;
        for (std::size_t i = 0; i < exact[c].size(); ++i) {
            ASSERT_TRUE(std::isfinite(exact[c][i])) << name << ' ' << i;
            EXPECT_NEAR(exact[c][i], near[c][i], 2e-3 * std::fabs(near[c][i]) + 1e-18)
                << name << ' ' << i;
        }
    }
}

// Returns bakes of each asset with directions under a sun at this elevation, at odd sizes, which have a
// texel on the axis.
std::string assets(const std::string& elevation) {
    std::string text;
    for (const char* altitude : {"0 m", "20 km", "150 km"}) {
        const std::string at = std::string(altitude).substr(0, 2);
        const std::string tag = at == "0 " ? "ground" : at == "20" ? "air" : "space";
        text += fmt::format(
            "[bake.view_{0}]\nasset = 'sky_view'\nsize = [5, 9]\npixel_type = 'float'\n"
            "altitude = '{1}'\nsun_elevations = ['{2}']\n",
            tag, altitude, elevation);
        const auto map = [&](const char* mapping, const char* size) {
            text += fmt::format(
                "[bake.{0}_{1}]\nasset = 'environment'\nmapping = '{0}'\nsize = {2}\n"
                "pixel_type = 'float'\naltitude = '{3}'\nsun_elevation = '{4}'\n",
                mapping, tag, size, altitude, elevation);
        };
        map("longitude_latitude", "[9, 5]");
        map("cube", "[5, 30]");
        map("octahedral", "[9, 9]");
        for (const char* pitch : {"90", "-90", "0"}) {
            text += fmt::format(
                "[bake.froxels_{0}_{1}]\nasset = 'aerial_perspective'\nsize = [3, 3, 4]\n"
                "pixel_type = 'float'\naltitude = '{2}'\npitch = '{3} deg'\nfov = '60 deg'\n"
                "view_distance = '400 km'\nsun_elevation = '{4}'\n",
                tag,
                pitch[0] == '-'   ? "down"
                : pitch[0] == '9' ? "up"
                                  : "ahead",
                altitude, pitch, elevation);
        }
    }
    return "preset = 'earth_hillaire'\n" + text;
}

TEST(CoincidingAxes, SunsAtTheZenithNadirAndHorizonAreThoseBesideThem) {
    test::SharedBakes shared;
    for (const auto& [exact, near] : std::vector<std::array<std::string, 2>>{
             {"90 deg", "89.9999 deg"}, {"-90 deg", "-89.9999 deg"}, {"0 deg", "0.00001 deg"}}) {
        const config::Recipe on_axis = test::recipe_of(assets(exact));
        const config::Recipe beside = test::recipe_of(assets(near));
        ASSERT_EQ(on_axis.parameters.bakes.size(), 21U);
        for (std::size_t i = 0; i < on_axis.parameters.bakes.size(); ++i) {
            const config::Bake& bake = on_axis.parameters.bakes[i];
            // Within the planet, straight below a camera on the ground, a sun on the horizon is lit from
            // one side and not from the other.
            if (exact == "0 deg" && bake.name == "froxels_ground_down") continue;
            expect_alike(shared.baked(on_axis, bake),
                         shared.baked(beside, beside.parameters.bakes[i]), exact + " " + bake.name);
        }
    }
}

// Tables whose axes are suns: the column of a sun at the nadir is no brighter than the next one.
TEST(CoincidingAxes, SunsAtTheNadirAreTheDarkest) {
    const config::Recipe recipe = test::recipe_of(
        "preset = 'earth_hillaire'\n"
        "[bake.irradiance]\nasset = 'irradiance'\nsize = [9, 3]\npixel_type = 'float'\n"
        "[bake.converged]\nasset = 'multiple_scattering'\nmethod = 'converged'\nsize = [9, 3]\n"
        "mapping = 'hillaire'\npixel_type = 'float'\n"
        "[bake.solved]\nasset = 'multiple_scattering'\nmethod = 'solved'\nsize = [9, 3]\n"
        "mapping = 'hillaire'\npixel_type = 'float'\n");
    test::SharedBakes shared;
    for (const config::Bake& bake : recipe.parameters.bakes) {
        const Baked baked = shared.baked(recipe, bake);
        const Image2<float>& image = baked.image();
        for (int y = 0; y < image.height; ++y) {
            for (int c = 0; c < image.channels; ++c) {
                // Suns below the solution's last are taken for it, but for the quadrature over the sky.
                EXPECT_LE(image.texel(0, y)[c], 1.001F * image.texel(1, y)[c])
                    << bake.name << ' ' << y;
                EXPECT_LT(image.texel(0, y)[c], 1e-8) << bake.name << ' ' << y;
            }
        }
    }
}

TEST(CoincidingAxes, BrunetonsTablesReachTheNadir) {
    const auto recipe = [](double last) {
        return test::recipe_of(fmt::format(
            "preset = 'earth_bruneton'\n[bake.b]\nasset = 'bruneton'\ntable = 'scattering'\n"
            "size = [27, 6, 5]\nnu_size = 3\npixel_type = 'float'\nsun_cos_zenith_min = {}\n",
            last));
    };
    test::SharedBakes shared;
    const config::Recipe exact = recipe(-1);
    const config::Recipe near = recipe(-0.99999999);
    expect_alike(shared.baked(exact, exact.parameters.bakes[0]),
                 shared.baked(near, near.parameters.bakes[0]), "bruneton");
}

}  // namespace
}  // namespace skybake
