// This file holds the rows of the recipe as a whole, of [atmosphere] and of its layers.
#include "config/fields/fields.h"
#include "config/optics/aerosol_components.h"
#include "config/optics/ground_spectra.h"
#include "config/sections/sections.h"
#include "config/sections/targets.h"

namespace skybake::config {
namespace {

// The outer bounds of these ranges are wider than any planet, and narrow enough that no square
// overflows a double. So the bakers need not check them again.
constexpr Range radius_range{1, 1e12};
constexpr Range altitude_range{-1e9, 1e12};
constexpr Range thickness_range{1e-3, 1e9};
constexpr Range number_density_range{1e-12, 1e30};

constexpr std::string_view hess_1998 =
    "Hess, Koepke and Schult 1998, Optical Properties of Aerosols and Clouds: OPAC";
constexpr std::string_view henyey_1941 = "Henyey and Greenstein 1941; Cornette and Shanks 1992";

constexpr Choice profile_choices[] = {
    {Profile::exponential, "exponential", "exp(-altitude / scale_height)"},
    {Profile::tent, "tent",
     "1 at center_altitude, falling linearly to 0 half_width above and below"},
    {Profile::slab, "slab", "1 between bottom_altitude and top_altitude, 0 elsewhere"},
    {Profile::tabulated, "tabulated", "linear between the entries of table, 0 outside"},
    {Profile::standard, "standard",
     "that of the gas in the US Standard Atmosphere 1976, by 10 to 30 altitudes"},
};
constexpr Choice phase_choices[] = {
    {Phase::isotropic, "isotropic", "the same in all directions"},
    {Phase::rayleigh, "rayleigh", "molecules: 3/(16 pi) (1 + cos^2)"},
    {Phase::henyey_greenstein, "henyey_greenstein", "haze and dust, one parameter g"},
    {Phase::cornette_shanks, "cornette_shanks",
     "Henyey-Greenstein with a Rayleigh-like back; Rayleigh at g = 0"},
    {Phase::mie, "mie",
     "the phase function of [particles.NAME], and with it scattering and extinction"},
};

constexpr Choice gas_choices[] = {
    {Gas::air, "air", "scatters by Rayleigh's law (Bucholtz 1995)"},
    {Gas::ozone, "ozone", "absorbs yellow light, and ultraviolet"},
    {Gas::nitrogen_dioxide, "nitrogen_dioxide", "absorbs blue light: brown air of cities"},
    {Gas::oxygen, "oxygen", "absorbs in bands of the far red, taken as their means"},
    {Gas::water_vapor, "water_vapor", "absorbs in bands of the red, taken as their means"},
    {Gas::nitrogen, "nitrogen", "scatters by Rayleigh's law, for air that is not the Earth's"},
    {Gas::carbon_dioxide, "carbon_dioxide", "scatters by Rayleigh's law: Mars and Venus"},
};

constexpr Choice mixture_choices[] = {
    {AerosolMixture::continental_clean, "continental_clean", "remote land, without soot"},
    {AerosolMixture::continental_average, "continental_average", "land, with some soot"},
    {AerosolMixture::continental_polluted, "continental_polluted", "land near cities"},
    {AerosolMixture::urban, "urban", "cities: much soot"},
    {AerosolMixture::desert, "desert", "mineral dust"},
    {AerosolMixture::maritime_clean, "maritime_clean", "the open sea: salt and sulfate"},
    {AerosolMixture::maritime_polluted, "maritime_polluted", "seas near land, with soot"},
    {AerosolMixture::maritime_tropical, "maritime_tropical", "the open sea of the tropics"},
    {AerosolMixture::arctic, "arctic", "north of 70 degrees, with soot"},
    {AerosolMixture::antarctic, "antarctic", "the Antarctic continent"},
};

constexpr Choice ground_choices[] = {
    {Ground::vegetation, "vegetation",
     "green leaves: 0.06 in blue, 0.13 in green, 0.5 beyond 720 nm (Vermote et al. 1997)"},
    {Ground::sand, "sand", "dry sand: 0.09 in blue, 0.21 in red (Vermote et al. 1997)"},
    {Ground::snow, "snow", "clean new snow: 0.99 in blue, 0.97 in red (Kokhanovsky 2004)"},
    {Ground::sea, "sea", "the open sea: 0.09 in blue, 0.067 in red (Morel 1988)"},
    {Ground::mars, "mars", "mean of Mars: 0.09 in blue, 0.25 in red (Mallama et al. 2017)"},
};

const Row<Parameters> root_table[] = {
    {"format", Kind::integer, nullptr, "version of the recipe's language, which may be left out",
     Range{1, 1}, Default{"1"}, RangeCode{"E0119"}, KeyFlag::only_shown},
    {"preset", Kind::text, nullptr, "name of a preset to start from, without its [bake.*] sections",
     KeyFlag::only_shown},
    {"include", Kind::text_list, nullptr, "recipes to read before this one, relative to its folder",
     KeyFlag::only_shown},
    {"wavelengths", Kind::wavelengths, &Parameters::wavelengths,
     "wavelengths of light: one channel for each, or with [color] any number that are turned into "
     "colours",
     Range{1e-8, 1e-3}, Default{R"(["680 nm", "550 nm", "440 nm"])"},
     Hint{"visible light is 380 nm to 750 nm; \"best 4\" is enough for its colours"},
     Cited{bruneton_2008}},
    {"target", Kind::choice, &Parameters::target,
     "the program that all files are for, unless a section names another", target_choices(),
     Role::usual},
};

const Row<Atmosphere> atmosphere_table[] = {
    {"ground_radius", Kind::length, &Atmosphere::ground_radius,
     "distance from the planet's centre to the ground", radius_range, KeyFlag::required,
     Hint{"the Earth has 6371 km"}, Role::geometry},
    {"top_radius", Kind::length, &Atmosphere::top_radius,
     "distance from the planet's centre to where the atmosphere is cut off", radius_range,
     KeyFlag::required, Hint{"60 to 100 km above the Earth's ground"}, Role::geometry},
    {"ground_albedo", Kind::albedo, nullptr,
     "share of the light that the ground reflects (Lambert); pairs are linear between wavelengths "
     "and constant beyond",
     unit_range, ground_choices, KeyFlag::required,
     Hint{"the Earth's ground has 0.125 in the mean, the sea 0.06, forests 0.15, deserts 0.35, new "
          "snow 0.9; 1 is all light"},
     Role::ground},
};

const Row<Layer> layer_table[] = {
    {"preset", Kind::text, nullptr, "name of a preset of a layer to start from",
     KeyFlag::only_shown},
    {"enabled", Kind::flag, &Layer::enabled, "false drops the layer", Default{"true"},
     KeyFlag::only_shown},
    {"profile", Kind::choice, &Layer::profile, "how density changes with altitude", profile_choices,
     KeyFlag::required, Role::geometry},
    {"scale_height", Kind::length, &Layer::scale_height,
     "altitude over which the density falls by a factor of e", thickness_range, KeyFlag::required,
     Hint{"air has 8 km, haze 1.2 km"}, When{"profile", "exponential"}, Cited{bruneton_2008},
     Role::geometry},
    {"center_altitude", Kind::length, &Layer::center_altitude, "altitude of the largest density",
     altitude_range, KeyFlag::required, Hint{"ozone has 25 km"}, When{"profile", "tent"},
     Cited{bruneton_2017}, Role::geometry},
    {"half_width", Kind::length, &Layer::half_width,
     "distance from the largest density to zero: half the base of the tent", thickness_range,
     KeyFlag::required,
     Hint{"for ozone 15 km (papers that say \"width 30 km\" mean the full base)"},
     When{"profile", "tent"}, Cited{bruneton_2017}, Role::geometry},
    {"bottom_altitude", Kind::length, &Layer::bottom_altitude, "lower bound of the slab",
     altitude_range, KeyFlag::required, When{"profile", "slab"}, Role::geometry},
    {"top_altitude", Kind::length, &Layer::top_altitude, "upper bound of the slab", altitude_range,
     KeyFlag::required, When{"profile", "slab"}, Role::geometry},
    {"table", Kind::density_table, &Layer::table,
     "pairs [altitude, density] with altitudes that increase from at least 0; with a gas or "
     "optical_depth only ratios of densities count, else they are at most 1e6. A file's first line "
     "names its columns with units, as in altitude(km), ozone(cm-3)",
     Range{0, 1e40}, KeyFlag::required, When{"profile", "tabulated"}, Role::geometry},
    {"gas", Kind::choice, nullptr, "gas whose coefficients are looked up at each wavelength",
     gas_choices, Role::particles},
    {"pressure", Kind::pressure, nullptr,
     "pressure of the air at the ground, which says how much there is", Range{1e-3, 1e8},
     Default{R"("1013.25 hPa")"}, Hint{"840 hPa at 1500 m above the sea"}, When{"gas", "air"},
     Role::particles},
    {"column", Kind::column_density, nullptr,
     "molecules of the gas from the ground to the top of the air", Range{1, 1e33},
     KeyFlag::required,
     Hint{"ozone has 250 to 450 DU, nitrogen dioxide 0.1 to 1 DU, oxygen 4.5e28 /m2, water vapour "
          "4.7e26 /m2 (14 mm of water), carbon dioxide of Mars 2.2e27 /m2"},
     When{"gas",
          {"ozone", "nitrogen_dioxide", "oxygen", "water_vapor", "nitrogen", "carbon_dioxide"}},
     Role::particles},
    {"aerosol", Kind::choice, nullptr,
     "mixture of OPAC's spheres, whose coefficients and phase function follow at each wavelength; "
     "without an amount it has its own",
     mixture_choices, Exclusive{"species"}, Cited{hess_1998}, Role::particles},
    {"components", Kind::components, nullptr,
     "kinds of spheres, each with its particles per volume where the density is 1; with "
     "optical_depth or visibility shares count",
     number_density_range,
     Hint{"OPAC's insoluble, water_soluble, soot, sea_salt_accumulation, sea_salt_coarse, "
          "mineral_nucleation, mineral_accumulation, mineral_coarse, mineral_transported, "
          "sulfate_droplets, or NAME of a [particles.NAME]"},
     Exclusive{"species"}, Cited{hess_1998}, Role::particles},
    {"relative_humidity", Kind::fraction, nullptr,
     "humidity in which the spheres of aerosol or components swell; without it 80 %",
     Range{0, 0.99}, Cited{hess_1998}, Role::particles},
    {"optical_depth", Kind::number, nullptr, "optical depth of an aerosol at 550 nm, straight up",
     Range{0, 1000}, Hint{"clean air of mountains has 0.02 to 0.05, haze 0.3"}, Exclusive{"amount"},
     Role::particles},
    {"visibility", Kind::length, nullptr,
     "distance at which things vanish in the haze at the ground", Range{1, 3e5},
     Hint{"clear air has 50 km, haze 5 km, fog less than 1 km"}, Exclusive{"amount"},
     Cited{"Koschmieder 1924"}, Role::particles},
    {"angstrom_exponent", Kind::number, nullptr,
     "exponent by which an aerosol's extinction falls with wavelength; without it 1.3",
     Range{-4, 6}, Hint{"dust and sea salt have 0 to 0.5, smoke 2"}, Cited{"Angstrom 1929"},
     Role::particles},
    {"scattering", Kind::coefficients, &Layer::scattering,
     "scattering coefficient where the density is 1", coefficient_range, Default{R"("0 /m")"},
     Hint{"air has 5.8e-6, 1.36e-5, 3.31e-5 /m"}, Role::scattering},
    {"extinction", Kind::coefficients, &Layer::extinction,
     "scattering plus absorption where the density is 1", coefficient_range,
     Hint{"haze has 4.44e-6 /m, which the table in Hillaire 2020 calls absorption"},
     Exclusive{"extinction"}, Cited{bruneton_2008}, Role::extinction},
    {"absorption", Kind::coefficients, nullptr,
     "absorption coefficient where the density is 1; without it there is none", coefficient_range,
     Hint{"ozone has 6.5e-7, 1.881e-6, 8.5e-8 /m"}, Exclusive{"extinction"}, Cited{hillaire_2020},
     KeyFlag::only_shown},
    {"single_scattering_albedo", Kind::fractions, nullptr, "scattering as a share of extinction",
     Range{1e-6, 1}, Hint{"haze has 0.9"}, Exclusive{"extinction"}, KeyFlag::only_shown},
    {"phase", Kind::choice, &Layer::phase,
     "where scattered light goes; { mie = \"NAME\" } names particles", phase_choices,
     Default{R"("isotropic")"}, Cited{henyey_1941}, Role::phase},
    {"g", Kind::number, &Layer::g, "asymmetry of the phase function: forward above 0, back below",
     Range{-1, 1, true, true}, KeyFlag::required, Hint{"typical haze has 0.76"},
     When{"phase", {"henyey_greenstein", "cornette_shanks"}}, Cited{henyey_1941}, Role::phase},
    {"depolarization", Kind::number, nullptr,
     "how much of the light scattered by 90 degrees is depolarised; without it that of the gas "
     "(air 0.0279), or 0",
     Range{0, 0.5}, When{"phase", "rayleigh"}, Cited{"Bates 1984"}, Role::phase},
    {"particles", Kind::text, nullptr, "NAME of the [particles.NAME] that the layer is made of",
     KeyFlag::required, When{"phase", "mie"}, Role::particles},
    {"number_density", Kind::number_density, nullptr, "particles per volume where the density is 1",
     number_density_range, Hint{"haze has 1e3 to 1e4 /cm3, fog 10 to 100 /cm3, rain 1e3 /m3"},
     Exclusive{"amount"}, Role::particles},
};

}  // namespace

std::span<const Row<Parameters>> root_fields() { return root_table; }

std::span<const Row<Atmosphere>> atmosphere_fields() { return atmosphere_table; }

std::span<const Row<Layer>> layer_fields() { return layer_table; }

}  // namespace skybake::config
