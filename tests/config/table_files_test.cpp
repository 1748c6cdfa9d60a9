// Densities in particles per volume, and tables of densities from files.
#include <gtest/gtest.h>

#include "config/sections/atmosphere.h"
#include "tests/config/recipes.h"
#include "tests/support/outcomes.h"

namespace skybake::config {
namespace {

std::string ozone(const std::string& table) {
    return "wavelengths = ['600 nm']\n[atmosphere]\nground_albedo = 0\nground_radius = '6360 km'\n"
           "top_radius = '6460 km'\n[atmosphere.layers.ozone]\ngas = 'ozone'\ncolumn = '300 DU'\n"
           "profile = 'tabulated'\ntable = " +
           table + "\n[bake.t]\nasset = 'transmittance'\n";
}

const std::string afgl =
    "# AFGL atmospheric constituent profile. U.S. standard atmosphere 1976.\n"
    "#  z(km)   p(mb)   T(K)  air(cm-3)   o3(cm-3)\n"
    "   50.000  0.798  270.7  2.135e+16  6.600e+10\n"
    "   22.000  40.47  218.6  1.341e+18  4.800e+12\n"
    "    0.000  1013.  288.2  2.547e+19  6.800e+11\n";

Recipe loaded(const TemporaryFolder& folder, const std::string& text) {
    return test::without_diagnostics(load_recipe(folder.write("r.toml", text)));
}

std::vector<DensityPoint> table_of(const Recipe& recipe) {
    if (recipe.parameters.atmosphere.layers.empty()) return {};
    return recipe.parameters.atmosphere.layers.front().table;
}

double depth_of(const Recipe& recipe) {
    const Atmosphere& air = recipe.parameters.atmosphere;
    return zenith_optical_depth(air.layers.front(), air).front();
}

// Divided by the largest, as only ratios count beside a column.
TEST(ParticlesPerVolume, AreRatiosBesideAColumn) {
    const Recipe particles =
        testing::valid(ozone("[['0 km', 6.8e11], ['22 km', 4.8e12], ['50 km', 6.6e10]]"));
    const Recipe ratios =
        testing::valid(ozone("[['0 km', 0.1416666666666667], ['22 km', 1], ['50 km', 0.01375]]"));
    ASSERT_EQ(table_of(particles).size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(table_of(particles)[i].density, table_of(ratios)[i].density, 1e-15);
        EXPECT_EQ(table_of(particles)[i].altitude.meters, table_of(ratios)[i].altitude.meters);
    }
    // 300 DU are 8.06e18 /cm2, and the cross-section at 600 nm is about 5.1e-21 cm2.
    EXPECT_NEAR(depth_of(particles), 0.041, 0.001);
    EXPECT_NEAR(depth_of(particles), depth_of(ratios), 1e-12);
}

TEST(TableFile, OfLibRadtranIsReadByTheNameOfAColumn) {
    const TemporaryFolder folder;
    folder.write("afglus.dat", afgl);
    const Recipe recipe = loaded(folder, ozone("['afglus.dat', 'o3']"));
    const Recipe inlined =
        testing::valid(ozone("[['0 km', 6.8e11], ['22 km', 4.8e12], ['50 km', 6.6e10]]"));
    EXPECT_EQ(table_of(recipe), table_of(inlined)) << "and from the ground up";
    ASSERT_EQ(recipe.inputs.size(), 2U) << "build systems know the file";
    EXPECT_EQ(recipe.inputs[1].filename(), "afglus.dat");
}

TEST(TableFile, HasTwoColumnsInWhateverMarks) {
    const TemporaryFolder folder;
    const Recipe wanted = testing::valid(ozone("[['0 km', 0.5], ['22000 m', 2]]"));
    for (const char* text :
         {"altitude [km], ozone [/cm3]\n0,0.5\n22,2\n", "z(km);o3\n0;0.5\n22;2\n",
          "# z (m)\tdensity (kg/m3)\r\n0\t0.5\r\n22000\t2\r\n",
          "# made by hand\n\n# z (m)  o3 (cm-3)\n0 0.5\n22000 2\n# end\n"}) {
        folder.write("o.csv", text);
        EXPECT_EQ(table_of(loaded(folder, ozone("'o.csv'"))), table_of(wanted)) << text;
    }
}

TEST(TableFile, SaysWhatIsWrongAtItsName) {
    const TemporaryFolder folder;
    const auto fault = [&](const std::string& text, const std::string& table = "'o.csv'") {
        folder.write("o.csv", text);
        const auto outcome = load_recipe(folder.write("r.toml", ozone(table)));
        EXPECT_EQ(outcome.diagnostics.size(), 1U) << text;
        if (outcome.diagnostics.empty()) return std::string();
        EXPECT_EQ(outcome.diagnostics[0].where.line, 10);
        return outcome.diagnostics[0].code + ": " + outcome.diagnostics[0].message + "; " +
               outcome.diagnostics[0].label;
    };
    EXPECT_EQ(fault("0,1\n1,2\n"),
              "E0114: `o.csv` does not name its columns, the first of them with a unit of length; "
              "begin it with a line such as `altitude(km), ozone(/cm3)`");
    EXPECT_EQ(
        fault("z(km),T(K)\n0,1\n1,2\n"),
        "E0114: `o.csv` has `T` in `K`, which is no density; give a column without a unit, or "
        "in one per volume, such as /cm3");
    EXPECT_EQ(fault("z(km),o3\n0,1\n1,two\n"),
              "E0114: `o.csv` has `two` in line 3; numbers must stand there");
    EXPECT_EQ(fault("z(km),o3\n0,1\n1\n"),
              "E0114: `o.csv` has 1 columns in line 3, and 2 above; each line must have as many");
    EXPECT_EQ(fault(afgl), "E0114: `o.csv` has several columns; name one: [\"o.csv\", \"o3\"]");
    EXPECT_EQ(fault(afgl, "['o.csv', 'O3']"),
              "E0114: `o.csv` has no column `O3`; there are p, T, air, o3");
    EXPECT_EQ(fault("# z(km), o3\n"),
              "E0114: `o.csv` has no numbers; write an altitude and a value in each line");
    EXPECT_TRUE(fault("", "'none.csv'").starts_with("E0300: cannot read `"));
    EXPECT_EQ(fault("z(km),o3\n0,1\n5,2\n3,1\n").substr(0, 5), "E0114") << "neither up nor down";
}

}  // namespace
}  // namespace skybake::config
