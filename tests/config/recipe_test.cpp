// Whole recipes: every diagnostic, the list of bad input, and what a pipeline relies on.
#include "config/recipe/recipe.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <locale>
#include <set>

#include "config/diagnostics/diagnostic_codes.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::all_parameters;
using testing::codes_and_places;
using testing::parse;
using testing::TemporaryFolder;
using testing::valid;

// A recipe with one fault, and what is said about it.
const std::string fog = "preset = \"vacuum\"\n[particles.fog]\npreset = \"fog\"\n";

struct Fault {
    std::string code;
    std::string text;
    int line;
    int column;
    int length;
    std::string label;
};

const std::string vacuum = "preset = \"vacuum\"\n";
const std::string layer =
    vacuum + "[atmosphere.layers.a]\nprofile = \"exponential\"\nscale_height = \"8 km\"\n";

const std::string shape =
    "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\nasset = \"noise_volume\"\n"
    "noise = \"shape\"\n";
const std::string perlin = "[noise.n.channels.Y]\ntype = \"perlin\"\n";
const std::string cloud =
    perlin + "[clouds.c]\nnoise = \"n\"\n" + "extent = [\"1 km\", \"1 km\", \"1 km\"]\n";

const std::vector<Fault> faults = {
    {"E0100", vacuum + "# \xff", 2, 3, 1, "a recipe is TOML text: save it as UTF-8 in your editor"},
    {"E0101", vacuum + "[atmosphere]\nground_radius = 8 km", 3, 19, 1,
     "write a quantity with a unit in quotes: \"8 km\""},
    {"E0102", vacuum + "include_ = []", 2, 1, 8, "did you mean `include`?"},
    {"E0103", layer + "enabled = \"no\"", 5, 11, 4, "expected true or false"},
    {"E0104", layer + "phase = \"raleigh\"", 5, 9, 9, "did you mean `rayleigh`?"},
    {"E0105", layer + "phase = \"henyey_greenstein\"", 5, 9, 19,
     "give a number without a unit; typical haze has 0.76"},
    {"E0106", layer + "scattering = \"1 /Km\"", 5, 14, 7, "units are case sensitive: write `/km`"},
    {"E0107", vacuum + "[atmosphere]\nground_radius = \"40 deg\"", 3, 17, 8,
     "expected a length with a unit, such as \"8 km\""},
    {"E0108", vacuum + "[atmosphere]\nground_albedo = [0.1, 0.2]", 3, 17, 10,
     "expected one value, or 3: one per wavelength"},
    {"E0109", layer + "extinction = \"1e-6 /m\"\nabsorption = \"0 /m\"", 6, 1, 10,
     "`extinction` is given already (line 5): keep one"},
    {"E0110", layer + "phase = \"cornette_shanks\"\ng = 1.2", 6, 5, 3,
     "must be in (-1, 1); typical haze has 0.76"},
    {"E0111", layer + "half_width = \"1 km\"", 5, 1, 10,
     "profile = \"exponential\" comes from test.toml:3"},
    {"E0112", layer + "scattering = \"2e-6 /m\"\nextinction = \"1e-6 /m\"", 6, 14, 9,
     "extinction is scattering plus absorption; if this is absorption, name it `absorption`"},
    {"E0113", vacuum + "[atmosphere]\ntop_radius = \"6000 km\"", 3, 14, 9,
     "must be above \"6360 km\""},
    {"E0114",
     vacuum +
         "[atmosphere.layers.a]\nprofile = \"tabulated\"\ntable = [[\"0 km\", 1], [\"0 km\", 2]]",
     4, 23, 11, "each altitude must be above the one before"},
    {"E0115", "preset = \"vacum\"", 1, 10, 7, "did you mean `vacuum`?"},
    {"E0117", vacuum + "[bake.\"a/b\"]\nasset = \"transmittance\"", 2, 7, 5,
     "use only letters, digits, `_` and `-`"},
    {"E0118", vacuum + "[bake.multiple_scatering]", 2, 7, 18,
     "did you mean `multiple_scattering`?"},
    {"E0119", vacuum + "format = 2", 2, 10, 1, "must be 1"},
    {"E0126", shape + "size = [10000, 10000, 10000]", 6, 8, 21,
     "at most 68719476736 (2^36) voxels are allowed"},
    {"E0128", perlin + "lacunarity = 16\noctaves = 6", 4, 11, 1,
     "at most 1048576 cells per tile are allowed: use fewer octaves or a lower lacunarity"},
    {"E0129", perlin + "[noise.n.channels.R]\ntype = \"perlin\"", 3, 19, 1,
     "expected Y alone, R alone, R, G, B, or R, G, B, A"},
    {"E0130", perlin + "[bake.n]\nasset = \"noise_volume\"\nnoise = \"m\"", 5, 9, 3,
     "this recipe has n"},
    {"E0131", shape + "pixel_type = \"unorm8\"", 6, 14, 8, "bin, png, dds, ktx2, npy, tga hold it"},
    {"E0132", cloud + "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"d\"\nsize = [16, 16, 16]", 8,
     9, 3, "this recipe has c"},
    {"E0133", cloud + "[bake.o]\nasset = \"occupancy\"\nof = \"o\"", 8, 6, 3,
     "the recipe has no [bake.NAME] with asset = \"cloud_volume\""},
    {"E0134",
     cloud + "[bake.o]\nasset = \"occupancy\"\nof = \"v\"\nchannel = \"R\"\n"
             "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 16, 16]",
     9, 11, 3, "channel is Y"},
    {"E0135", perlin + "[sweep]\n\"noise.n.seed\" = { from = 1, to = 4, count = 3 }", 4, 18, 31,
     "choose a count that divides the range from 1 to 4 into whole steps, or list the values"},
    {"E0136",
     perlin + "[sweep]\n\"noise.n.seed\" = [1, 2]\nzip = [\"noise.n.seed\", \"noise.n.pack\"]", 5,
     7, 32, "zip takes paths that vary, each once, with as many values as the others"},
    {"E0137",
     perlin + "[sweep]\n\"noise.n.seed\" = { from = 1, to = 99999, count = 99999 }\n"
              "\"noise.n.size\" = [[8, 8, 8], [4, 4, 4]]",
     5, 1, 14, "at most 100000 are allowed"},
    {"E0138",
     "preset = \"earth_hillaire\"\n[bake.sky_view]\nsun_elevations = [\"30 deg\"]\n"
     "orders = \"single\"\nlayers = [\"mei\"]",
     5, 10, 7, "did you mean `mie`?"},
    {"E0139",
     fog + "[atmosphere.layers.fog]\nprofile = \"exponential\"\nscale_height = \"0.2 km\"\n"
           "phase = { mie = \"fog\" }\nnumber_density = \"15 /cm3\"\nabsorption = \"1e-6 /m\"",
     9, 14, 9, "phase = \"mie\" computes it from their number and size; leave it out"},
    {"E0140", fog + "[bake.phase]\nparticles = \"frog\"", 5, 13, 6, "did you mean `fog`?"},
    {"E0141", fog + "[bake.phase]\nsize = 64", 4, 7, 5, "name `particles` or a `layer`"},
    {"E0142", vacuum + "[bake.bruneton]\nsize = [256, 128, 32]\nnu_size = 7", 3, 8, 14,
     "it needs at least two sub-images, each of at least two texels"},
    {"E0144", fog + "material = \"constant\"\nrefractive_index = 1", 5, 20, 1,
     "give a refractive_index other than 1, or an absorption_index above 0"},
    {"E0150",
     cloud + "[bake.o]\nasset = \"occupancy\"\nof = \"v\"\ncell = 8\n"
             "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [20, 20, 20]",
     9, 8, 1, "give `v` a size that 8 divides, or a `cell` that divides the size"},
    {"E0171",
     cloud +
         "[bake.l]\nasset = \"cloud_light\"\nof = \"v\"\ncontents = \"sky_visibility\"\npart = 2\n"
         "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 16, 16]",
     10, 8, 1, "use at most 1"},
    {"E0156",
     perlin + "[bake.m]\nasset = \"weather_map\"\nnoise = \"n\"\ncovered = 0.2\nfull = 0.3", 7, 8,
     3, "`full` is at most `covered`"},
    {"E0175",
     cloud + "[bake.d]\nasset = \"cloud_distance\"\nof = \"v\"\nrange = [\"10 m\", \"4 km\"]\n"
             "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [20, 20, 20]",
     9, 9, 16, "begin it at or below 0 m, and end it above 0 m"},
    {"E0176",
     cloud + "[bake.l]\nasset = \"cloud_light\"\nof = \"v\"\ncontents = \"sun_radiance\"\n"
             "sun_elevations = [\"60 deg\", \"30 deg\"]\n"
             "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 16, 16]",
     10, 18, 20, "give one elevation, and bake an asset for each sun"},
    {"E0189",
     cloud + "[bake.l]\nasset = \"cloud_light\"\nof = \"v\"\ncontents = \"clear_sky_radiance\"\n"
             "sun_elevations = \"60 deg\"\n"
             "[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 16, 16]",
     9, 12, 20, "give the recipe an atmosphere, for instance preset = \"earth\""},
    {"E0160", vacuum + "[bake.transmittance]\ntarget = \"pbrt\"", 3, 10, 6,
     "it loads cloud_volume, noise_volume"},
    {"E0170",
     "[volumes.smoke]\nfile = \"smoke.vdb\"\n[clouds.c]\nvolume = \"smok\"\n"
     "extent = [\"1 km\", \"1 km\", \"1 km\"]",
     4, 10, 6, "did you mean `smoke`?"},
    {"E0172", vacuum + "[bake.environment]\nsun_elevation = \"9 deg\"\nlevel_content = \"ggx\"", 4,
     17, 5, "give `mips`, for instance 6"},
    {"E0182",
     "[noise.n.channels.Y]\ntype = \"perlin\"\n[clouds.c]\nnoise = \"n\"\n"
     "extent = [\"1 km\", \"1 km\", \"1 km\"]\nperiod = 8\n[[clouds.c.towers]]\n"
     "center = [0, 0]\nsigma = [1, 1]\namplitude = 1\nlife = [0.5, 0.5, 0.5]",
     11, 8, 15, "they add up to 1.5, and the tower is born again after 1; [0.4, 0.3, 0.3] is one"},
    {"E0121", vacuum + "a = " + std::string(40, '['), 2, 37, 1, "at most 32 levels"},
};

TEST(Recipe, EveryFaultIsReportedWithItsPlace) {
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.code);
        const Outcome<Recipe> outcome = parse(fault.text);
        EXPECT_FALSE(outcome.value);
        ASSERT_EQ(outcome.diagnostics.size(), 1u);
        const Diagnostic& diagnostic = outcome.diagnostics[0];
        EXPECT_EQ(diagnostic.code, fault.code);
        EXPECT_EQ(diagnostic.severity, Severity::error);
        EXPECT_EQ(diagnostic.where.source, "test.toml");
        EXPECT_EQ(diagnostic.where.line, fault.line);
        EXPECT_EQ(diagnostic.where.column, fault.column);
        EXPECT_EQ(diagnostic.where.length, fault.length);
        EXPECT_EQ(diagnostic.label, fault.label);
        EXPECT_FALSE(diagnostic.message.empty());
        EXPECT_EQ(exit_code(outcome.diagnostics), 2);
    }
}

// Codes that need files, settings or a thousand errors have tests of their own.
TEST(Recipe, EveryCodeOfTheRecipeHasATest) {
    std::set<std::string> tested = {"E0116", "E0120", "E0122", "E0123", "E0125"};
    for (const Fault& fault : faults) tested.insert(fault.code);
    tested.insert("E0124");  // said by `bake`, which alone needs something to bake
    tested.insert("E0143");  // said by the baker
    tested.insert("E0145");  // in spectral_air_test.cpp
    tested.insert("E0147");  // in wavelengths_test.cpp
    tested.insert("E0174");  // in noise_motion_decoder_test.cpp
    tested.insert("E0177");  // in output_files_test.cpp
    tested.insert("E0178");
    for (const DiagnosticCode& code : diagnostic_codes()) {
        if (code.code.starts_with("E01")) {
            EXPECT_TRUE(tested.contains(std::string(code.code))) << code.code;
        }
    }
}

// `explain` shows for a code about noises and clouds a recipe that earns it, and one that does not.
TEST(Recipe, ExamplesOfNoiseAndCloudCodesAreRight) {
    for (const char* name : {"E0126", "E0128", "E0129", "E0130", "E0131", "E0132", "E0133", "E0134",
                             "E0150", "E0171", "E0174", "E0175", "E0176", "E0177", "E0189", "W0203", "W0204",
                             "W0208", "W0210", "W0211", "W0212", "W0213", "W0223"}) {
        const DiagnosticCode* code = find_diagnostic_code(name);
        ASSERT_TRUE(code) << name;
        const auto wrong = parse(std::string(code->wrong)).diagnostics;
        ASSERT_EQ(wrong.size(), 1u) << name;
        EXPECT_EQ(wrong[0].code, name);
        const Outcome<Recipe> right = parse(std::string(code->right));
        EXPECT_TRUE(right.value) << name;
        EXPECT_TRUE(right.diagnostics.empty()) << name;
    }
}

TEST(Recipe, AnswersInTheUsersUnits) {
    const auto radii = parse(
        "preset = 'vacuum'\n[atmosphere]\nground_radius = '6460 km'\ntop_radius = '6360 km'\n");
    ASSERT_EQ(radii.diagnostics.size(), 1u);
    EXPECT_EQ(radii.diagnostics[0].message,
              "`atmosphere.top_radius` is not above ground_radius: \"6360 km\"");
    EXPECT_EQ(radii.diagnostics[0].label, "must be above \"6460 km\"");
    const auto label = [](const std::string& bake) {
        return parse("preset = 'earth_hillaire'\n[bake.transmittance]\n" + bake)
            .diagnostics.at(0)
            .label;
    };
    EXPECT_TRUE(
        label("max_error = 5").starts_with("5 is 500 %: write \"5 %\" for 5 per cent; must be in"));
    EXPECT_TRUE(label("max_error = 500").starts_with("must be in"));
    EXPECT_TRUE(label("max_error = '500 %'").starts_with("must be in"));
    const auto comma = parse("preset = 'vacuum'\n[atmosphere]\ntop_radius = '6460,5 km'\n");
    EXPECT_EQ(comma.diagnostics.at(0).label, "write a decimal point, not a comma");
}

TEST(Recipe, AllErrorsAreReportedInOneRun) {
    const auto diagnostics = parse(
                                 "preset = \"earth_hillaire\"\n"
                                 "[atmosphere.layers.rayleigh]\n"
                                 "scale_hieght = \"8 km\"\n"
                                 "[atmosphere.layers.mie]\n"
                                 "g = 1.2\n"
                                 "[bake.transmittance]\n"
                                 "size = [0, 1000000000]\n",
                                 {"atmosphere.layers.ozone.center_altitude=40deg"})
                                 .diagnostics;
    EXPECT_EQ(codes_and_places(diagnostics),
              (std::vector<std::string>{"E0102 3:1", "E0110 5:5", "E0110 7:9", "E0110 7:12",
                                        "E0107 0:0"}));
    EXPECT_EQ(diagnostics[1].message, "`atmosphere.layers.mie.g` is out of range: 1.2");
    EXPECT_EQ(diagnostics[4].where.source, "--set `atmosphere.layers.ozone.center_altitude=40deg`");
    EXPECT_EQ(
        diagnostics[4].message,
        "`atmosphere.layers.ozone.center_altitude`: expected a length with a unit, not an angle");
}

TEST(Recipe, AFileWithAByteOrderMarkIsFine) {
    const Recipe recipe =
        valid("\xef\xbb\xbfpreset = 'earth_hillaire'\r\n[bake.transmittance]\r\n");
    EXPECT_EQ(recipe.parameters.bakes.size(), 1u);
    EXPECT_EQ(parse("\xef\xbb\xbf[atmosphere").diagnostics[0].where.line_text, "[atmosphere");
}

struct BadFile {
    std::string what;
    std::string content;
    std::string code;
    int exit_code;
};

TEST(Recipe, BadFilesAreOneClearMessage) {
    const TemporaryFolder folder;
    const std::vector<BadFile> files = {
        {"empty", "", "E0105", 2},
        {"binary",
         std::string("\x7f"
                     "ELF\x02\x01\x01\0\0\0",
                     10),
         "E0100", 2},
        {"large", std::string(5 << 20, 'x'), "E0120", 2},
        {"latin1", "# caf\xe9\n", "E0100", 2},
        {"utf16",
         std::string("\xff\xfe"
                     "a\0",
                     4),
         "E0100", 2},
        {"cyclic", "include = ['cyclic']", "E0116", 2},
        {"lost include", "include = ['nowhere.toml']", "E0300", 3},
        {"deep", "[" + std::string(1000, '['), "E0121", 2},
    };
    for (const BadFile& file : files) {
        SCOPED_TRACE(file.what);
        const Outcome<Recipe> outcome = load_recipe(folder.write(file.what, file.content));
        EXPECT_FALSE(outcome.value);
        ASSERT_EQ(outcome.diagnostics.size(), 1u);
        EXPECT_EQ(outcome.diagnostics[0].code, file.code);
        EXPECT_EQ(exit_code(outcome.diagnostics), file.exit_code);
    }
}

TEST(Recipe, FilesThatCannotBeReadHaveTheirOwnExitCode) {
    const TemporaryFolder folder;
    for (const auto& path : {folder.path() / "missing.toml", folder.path()}) {
        const Outcome<Recipe> outcome = load_recipe(path);
        EXPECT_FALSE(outcome.value);
        ASSERT_EQ(outcome.diagnostics.size(), 1u);
        EXPECT_EQ(outcome.diagnostics[0].code, "E0300");
        EXPECT_EQ(exit_code(outcome.diagnostics), 3);
        EXPECT_NE(outcome.diagnostics[0].message.find(path.string()), std::string::npos);
    }
}

TEST(Recipe, AnUnreadableFileDoesNotHideErrorsOfSettings) {
    const TemporaryFolder folder;
    const std::vector<std::string> settings = {"nonsense"};
    const Outcome<Recipe> outcome = load_recipe(folder.path() / "missing.toml", settings);
    EXPECT_EQ(outcome.diagnostics.size(), 2u);
    EXPECT_EQ(exit_code(outcome.diagnostics), 3);
}

TEST(Recipe, IncludesComeBeforeTheFileAndSettingsAfter) {
    const TemporaryFolder folder;
    folder.write(
        "base.toml",
        "preset = 'earth_hillaire'\n[atmosphere.layers.mie]\ng = 0.1\nscattering = '1e-6 /m'\n");
    const auto path =
        folder.write("top.toml", "include = 'base.toml'\n[atmosphere.layers.mie]\ng = 0.2\n");
    const std::vector<std::string> settings = {"atmosphere.layers.mie.g=0.3",
                                               "atmosphere.layers.mie.g=0.4"};
    const auto g = [](const Outcome<Recipe>& outcome) {
        return testing::find_layer(outcome.value.value().parameters, "mie")->g;
    };
    EXPECT_EQ(g(load_recipe(path)), 0.2);
    EXPECT_EQ(g(load_recipe(path, settings)), 0.4);
    EXPECT_EQ(
        testing::find_layer(load_recipe(path).value->parameters, "mie")->scattering[0].per_meter,
        1e-6);
    EXPECT_EQ(load_recipe(path).value->inputs.size(), 2u);
}

TEST(Recipe, ALaterSourceReplacesTheAlternatives) {
    const Recipe recipe = valid(
        "preset = 'earth_hillaire'\n[atmosphere.layers.mie]\nsingle_scattering_albedo = 0.5\nphase "
        "= "
        "'rayleigh'\n"
        "[atmosphere.layers.ozone]\nprofile = 'exponential'\nscale_height = '8 km'\n",
        {"atmosphere.layers.rayleigh.absorption=1e-6 /m"});
    const Layer* mie = testing::find_layer(recipe.parameters, "mie");
    ASSERT_TRUE(mie);
    EXPECT_EQ(mie->extinction[0].per_meter, 3.996e-6 / 0.5);
    EXPECT_EQ(mie->phase, Phase::rayleigh);
    EXPECT_EQ(testing::find_layer(recipe.parameters, "ozone")->profile, Profile::exponential);
}

TEST(Recipe, SettingsTakeTomlOrText) {
    const auto albedo = [](const std::string& setting) {
        return valid("preset = 'earth_hillaire'", {setting}).parameters.atmosphere.ground_albedo;
    };
    EXPECT_EQ(albedo("atmosphere.ground_albedo=0.5"), std::vector<double>(3, 0.5));
    EXPECT_EQ(albedo("atmosphere.ground_albedo = [0.1, 0.2, 0.3]"),
              (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_EQ(albedo("atmosphere.ground_albedo=50 %"), std::vector<double>(3, 0.5));
    EXPECT_EQ(albedo("atmosphere={ground_albedo=0.5}"), std::vector<double>(3, 0.5));
}

TEST(Recipe, EquivalentSpellingsResolveToTheSameText) {
    EXPECT_EQ(
        all_parameters(valid("preset = 'earth_hillaire'", {"atmosphere.ground_radius=6360000 m"})),
        all_parameters(valid("preset = 'earth_hillaire'")));
}

// A locale with a decimal comma and points between the thousands, whether installed or not.
class CommaPunctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Recipe, DoesNotDependOnTheLocale) {
    const std::string expected = all_parameters(valid("preset = 'earth_hillaire'"));
    const std::string message = parse("format = 2000").diagnostics.back().message;
    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation));
    EXPECT_EQ(all_parameters(valid("preset = 'earth_hillaire'")), expected);
    EXPECT_EQ(parse("format = 2000").diagnostics.back().message, message);
    std::locale::global(before);
}

// The canonical text is itself a recipe, of the same parameters.
TEST(Recipe, CanonicalTextReadsBack) {
    EXPECT_TRUE(rc::check("resolve(canonical(recipe)) == recipe", [] {
        const auto scale_height = *rc::gen::inRange(1, 1000000);
        const auto scattering = *rc::gen::inRange(0, 1000000);
        const auto absorption = *rc::gen::inRange(0, 1000000);
        const auto exponent = *rc::gen::inRange(-12, -7);
        const auto g = *rc::gen::inRange(-99999, 99999);
        const std::string suffix = "e" + std::to_string(exponent) + " /km\"\n";
        const std::string text =
            "preset = \"vacuum\"\n[atmosphere.layers.x]\nprofile = \"exponential\"\n"
            "scale_height = \"" +
            std::to_string(scale_height) + "e-3 km\"\n" + "scattering = \"" +
            std::to_string(scattering) + suffix + "absorption = \"" + std::to_string(absorption) +
            suffix + "phase = \"henyey_greenstein\"\ng = " + std::to_string(g) + "e-5\n" +
            "[bake.transmittance]\nmax_error = \"1 %\"\n";
        const Outcome<Recipe> once = parse(text);
        RC_ASSERT(once.value.has_value());
        const std::string canonical = all_parameters(*once.value);
        const Outcome<Recipe> twice = parse(canonical);
        RC_ASSERT(twice.value.has_value());
        RC_ASSERT(all_parameters(*twice.value) == canonical);
    }));
}

}  // namespace
}  // namespace skybake::config
