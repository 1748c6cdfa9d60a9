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
constexpr Range wavelength_range{1e-8, 1e-3};
constexpr Range number_density_range{1e-12, 1e30};
constexpr Range humidity_range{0, 0.99};
constexpr Range pressure_range{1e-3, 1e8};
constexpr Range column_range{1, 1e33};
constexpr Range aerosol_depth_range{0, 1000};
constexpr Range visibility_range{1, 3e5};
constexpr Range angstrom_range{-4, 6};
constexpr Range depolarization_range{0, 0.5};
constexpr Range albedo_of_scattering_range{1e-6, 1};
constexpr Range asymmetry_range{-1, 1, true, true};

constexpr std::string_view hess_1998 =
    "Hess, Koepke and Schult 1998, Optical Properties of Aerosols and Clouds: OPAC";
constexpr std::string_view henyey_1941 = "Henyey and Greenstein 1941; Cornette and Shanks 1992";

constexpr std::array profile_choices = {
    Choice{Profile::exponential, "exponential", "exp(-altitude / scale_height)"},
    Choice{Profile::tent, "tent",
           "1 at center_altitude, falling linearly to 0 half_width above and below"},
    Choice{Profile::slab, "slab", "1 between bottom_altitude and top_altitude, 0 elsewhere"},
    Choice{Profile::tabulated, "tabulated", "linear between the entries of table, 0 outside"},
    Choice{Profile::standard, "standard",
           "that of the gas in the US Standard Atmosphere 1976, by 10 to 30 altitudes"},
};
constexpr std::array phase_choices = {
    Choice{Phase::isotropic, "isotropic", "the same in all directions"},
    Choice{Phase::rayleigh, "rayleigh", "molecules: 3/(16 pi) (1 + cos^2)"},
    Choice{Phase::henyey_greenstein, "henyey_greenstein", "haze and dust, one parameter g"},
    Choice{Phase::cornette_shanks, "cornette_shanks",
           "Henyey-Greenstein with a Rayleigh-like back; Rayleigh at g = 0"},
    Choice{Phase::mie, "mie",
           "the phase function of [particles.NAME], and with it scattering and extinction"},
};

constexpr std::array gas_choices = {
    Choice{Gas::air, "air", "scatters by Rayleigh's law (Bucholtz 1995)"},
    Choice{Gas::ozone, "ozone", "absorbs yellow light, and ultraviolet"},
    Choice{Gas::nitrogen_dioxide, "nitrogen_dioxide", "absorbs blue light: brown air of cities"},
    Choice{Gas::oxygen, "oxygen", "absorbs in bands of the far red, taken as their means"},
    Choice{Gas::water_vapor, "water_vapor", "absorbs in bands of the red, taken as their means"},
    Choice{Gas::nitrogen, "nitrogen",
           "scatters by Rayleigh's law, for air that is not the Earth's"},
    Choice{Gas::carbon_dioxide, "carbon_dioxide", "scatters by Rayleigh's law: Mars and Venus"},
};

// These are the profiles, phases and gases for which a key applies.
constexpr std::array mixture_choices = {
    Choice{AerosolMixture::continental_clean, "continental_clean", "remote land, without soot"},
    Choice{AerosolMixture::continental_average, "continental_average", "land, with some soot"},
    Choice{AerosolMixture::continental_polluted, "continental_polluted", "land near cities"},
    Choice{AerosolMixture::urban, "urban", "cities: much soot"},
    Choice{AerosolMixture::desert, "desert", "mineral dust"},
    Choice{AerosolMixture::maritime_clean, "maritime_clean", "the open sea: salt and sulfate"},
    Choice{AerosolMixture::maritime_polluted, "maritime_polluted", "seas near land, with soot"},
    Choice{AerosolMixture::maritime_tropical, "maritime_tropical", "the open sea of the tropics"},
    Choice{AerosolMixture::arctic, "arctic", "north of 70 degrees, with soot"},
    Choice{AerosolMixture::antarctic, "antarctic", "the Antarctic continent"},
};

constexpr std::array ground_choices = {
    Choice{Ground::vegetation, "vegetation",
           "green leaves: 0.06 in blue, 0.13 in green, 0.5 beyond "
           "720 nm (Vermote et al. 1997)"},
    Choice{Ground::sand, "sand", "dry sand: 0.09 in blue, 0.21 in red (Vermote et al. 1997)"},
    Choice{Ground::snow, "snow", "clean new snow: 0.99 in blue, 0.97 in red (Kokhanovsky 2004)"},
    Choice{Ground::sea, "sea", "the open sea: 0.09 in blue, 0.067 in red (Morel 1988)"},
    Choice{Ground::mars, "mars", "mean of Mars: 0.09 in blue, 0.25 in red (Mallama et al. 2017)"},
};

constexpr std::string_view exponential[] = {"exponential"};
constexpr std::string_view tent[] = {"tent"};
constexpr std::string_view slab[] = {"slab"};
constexpr std::string_view tabulated[] = {"tabulated"};
constexpr std::string_view mie[] = {"mie"};
constexpr std::string_view rayleigh[] = {"rayleigh"};
constexpr std::string_view air[] = {"air"};
constexpr std::string_view with_column[] = {"ozone",       "nitrogen_dioxide", "oxygen",
                                            "water_vapor", "nitrogen",         "carbon_dioxide"};
constexpr std::string_view with_asymmetry[] = {"henyey_greenstein", "cornette_shanks"};

const std::array root_table = {
    RootField{{.key = "format",
               .kind = Kind::integer,
               .range = {1, 1},
               .fallback = "1",
               .documentation = "version of the recipe's language, which may be left out",
               .range_code = "E0119",
               .only_shown = true},
              {}},
    RootField{{.key = "preset",
               .kind = Kind::text,
               .documentation = "name of a preset to start from, without its [bake.*] sections",
               .only_shown = true},
              {}},
    RootField{{.key = "include",
               .kind = Kind::text_list,
               .documentation = "recipes to read before this one, relative to its folder",
               .only_shown = true},
              {}},
    RootField{{.key = "wavelengths",
               .kind = Kind::wavelengths,
               .range = wavelength_range,
               .fallback = R"(["680 nm", "550 nm", "440 nm"])",
               .documentation = "wavelengths of light: one channel for each, or with [color] any "
                                "number that are turned into colours",
               .hint = "visible light is 380 nm to 750 nm; \"best 4\" is enough for its colours",
               .citation = bruneton_2008},
              &Parameters::wavelengths},
    RootField{
        {.key = "target",
         .kind = Kind::choice,
         .choices = target_choices(),
         .documentation = "the program that all files are for, unless a section names another",
         .role = Role::usual},
        &Parameters::target},
};

const std::array atmosphere_table = {
    AtmosphereField{{.key = "ground_radius",
                     .kind = Kind::length,
                     .range = radius_range,
                     .required = true,
                     .documentation = "distance from the planet's centre to the ground",
                     .hint = "the Earth has 6371 km",
                     .role = Role::geometry},
                    &Atmosphere::ground_radius},
    AtmosphereField{
        {.key = "top_radius",
         .kind = Kind::length,
         .range = radius_range,
         .required = true,
         .documentation = "distance from the planet's centre to where the atmosphere is cut off",
         .hint = "60 to 100 km above the Earth's ground",
         .role = Role::geometry},
        &Atmosphere::top_radius},
    AtmosphereField{
        {.key = "ground_albedo",
         .kind = Kind::albedo,
         .range = unit_range,
         .choices = ground_choices,
         .required = true,
         .documentation = "share of the light that the ground reflects (Lambert); pairs "
                          "are linear between wavelengths and constant beyond",
         .hint = "the Earth's ground has 0.125 in the mean, the sea 0.06, forests 0.15, "
                 "deserts 0.35, new snow 0.9; 1 is all light",
         .role = Role::ground},
        {}},
};

const std::array layer_table = {
    LayerField{{.key = "preset",
                .kind = Kind::text,
                .documentation = "name of a preset of a layer to start from",
                .only_shown = true},
               {}},
    LayerField{{.key = "enabled",
                .kind = Kind::flag,
                .fallback = "true",
                .documentation = "false drops the layer",
                .only_shown = true},
               &Layer::enabled},
    LayerField{{.key = "profile",
                .kind = Kind::choice,
                .choices = profile_choices,
                .required = true,
                .documentation = "how density changes with altitude",
                .role = Role::geometry},
               &Layer::profile},
    LayerField{{.key = "scale_height",
                .kind = Kind::length,
                .range = thickness_range,
                .required = true,
                .documentation = "altitude over which the density falls by a factor of e",
                .hint = "air has 8 km, haze 1.2 km",
                .citation = bruneton_2008,
                .selector = "profile",
                .selected_by = exponential,
                .role = Role::geometry},
               &Layer::scale_height},
    LayerField{{.key = "center_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "altitude of the largest density",
                .hint = "ozone has 25 km",
                .citation = bruneton_2017,
                .selector = "profile",
                .selected_by = tent,
                .role = Role::geometry},
               &Layer::center_altitude},
    LayerField{
        {.key = "half_width",
         .kind = Kind::length,
         .range = thickness_range,
         .required = true,
         .documentation = "distance from the largest density to zero: half the base of the tent",
         .hint = "for ozone 15 km (papers that say \"width 30 km\" mean the full base)",
         .citation = bruneton_2017,
         .selector = "profile",
         .selected_by = tent,
         .role = Role::geometry},
        &Layer::half_width},
    LayerField{{.key = "bottom_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "lower bound of the slab",
                .selector = "profile",
                .selected_by = slab,
                .role = Role::geometry},
               &Layer::bottom_altitude},
    LayerField{{.key = "top_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "upper bound of the slab",
                .selector = "profile",
                .selected_by = slab,
                .role = Role::geometry},
               &Layer::top_altitude},
    LayerField{
        {.key = "table",
         .kind = Kind::density_table,
         .range = {0, 1e40},
         .required = true,
         .documentation = "pairs [altitude, density] with altitudes that increase from at least 0; "
                          "with a gas or optical_depth only ratios of densities count, else they "
                          "are at most 1e6. A file's first line names its columns with units, as "
                          "in altitude(km), ozone(cm-3)",
         .selector = "profile",
         .selected_by = tabulated,
         .role = Role::geometry},
        &Layer::table},
    LayerField{{.key = "gas",
                .kind = Kind::choice,
                .choices = gas_choices,
                .documentation = "gas whose coefficients are looked up at each wavelength",
                .role = Role::particles},
               {}},
    LayerField{{.key = "pressure",
                .kind = Kind::pressure,
                .range = pressure_range,
                .fallback = R"("1013.25 hPa")",
                .documentation = "pressure of the air at the ground, which says how much there is",
                .hint = "840 hPa at 1500 m above the sea",
                .selector = "gas",
                .selected_by = air,
                .role = Role::particles},
               {}},
    LayerField{
        {.key = "column",
         .kind = Kind::column_density,
         .range = column_range,
         .required = true,
         .documentation = "molecules of the gas from the ground to the top of the air",
         .hint = "ozone has 250 to 450 DU, nitrogen dioxide 0.1 to 1 DU, oxygen 4.5e28 /m2, "
                 "water vapour 4.7e26 /m2 (14 mm of water), carbon dioxide of Mars 2.2e27 /m2",
         .selector = "gas",
         .selected_by = with_column,
         .role = Role::particles},
        {}},
    LayerField{{.key = "aerosol",
                .kind = Kind::choice,
                .choices = mixture_choices,
                .documentation = "mixture of OPAC's spheres, whose coefficients and phase function "
                                 "follow at each wavelength; without an amount it has its own",
                .citation = hess_1998,
                .exclusive_group = "species",
                .role = Role::particles},
               {}},
    LayerField{{.key = "components",
                .kind = Kind::components,
                .range = number_density_range,
                .documentation = "kinds of spheres, each with its particles per volume where the "
                                 "density is 1; with optical_depth or visibility shares count",
                .hint = "OPAC's insoluble, water_soluble, soot, sea_salt_accumulation, "
                        "sea_salt_coarse, mineral_nucleation, mineral_accumulation, "
                        "mineral_coarse, mineral_transported, sulfate_droplets, or NAME of a "
                        "[particles.NAME]",
                .citation = hess_1998,
                .exclusive_group = "species",
                .role = Role::particles},
               {}},
    LayerField{{.key = "relative_humidity",
                .kind = Kind::fraction,
                .range = humidity_range,
                .documentation = "humidity in which the spheres of aerosol or components swell; "
                                 "without it 80 %",
                .citation = hess_1998,
                .role = Role::particles},
               {}},
    LayerField{{.key = "optical_depth",
                .kind = Kind::number,
                .range = aerosol_depth_range,
                .documentation = "optical depth of an aerosol at 550 nm, straight up",
                .hint = "clean air of mountains has 0.02 to 0.05, haze 0.3",
                .exclusive_group = "amount",
                .role = Role::particles},
               {}},
    LayerField{{.key = "visibility",
                .kind = Kind::length,
                .range = visibility_range,
                .documentation = "distance at which things vanish in the haze at the ground",
                .hint = "clear air has 50 km, haze 5 km, fog less than 1 km",
                .citation = "Koschmieder 1924",
                .exclusive_group = "amount",
                .role = Role::particles},
               {}},
    LayerField{{.key = "angstrom_exponent",
                .kind = Kind::number,
                .range = angstrom_range,
                .documentation = "exponent by which an aerosol's extinction falls with wavelength; "
                                 "without it 1.3",
                .hint = "dust and sea salt have 0 to 0.5, smoke 2",
                .citation = "Angstrom 1929",
                .role = Role::particles},
               {}},
    LayerField{{.key = "scattering",
                .kind = Kind::coefficients,
                .range = coefficient_range,
                .fallback = R"("0 /m")",
                .documentation = "scattering coefficient where the density is 1",
                .hint = "air has 5.8e-6, 1.36e-5, 3.31e-5 /m",
                .role = Role::scattering},
               &Layer::scattering},
    LayerField{{.key = "extinction",
                .kind = Kind::coefficients,
                .range = coefficient_range,
                .documentation = "scattering plus absorption where the density is 1",
                .hint = "haze has 4.44e-6 /m, which the table in Hillaire 2020 calls absorption",
                .citation = bruneton_2008,
                .exclusive_group = "extinction",
                .role = Role::extinction},
               &Layer::extinction},
    LayerField{
        {.key = "absorption",
         .kind = Kind::coefficients,
         .range = coefficient_range,
         .documentation = "absorption coefficient where the density is 1; without it there is none",
         .hint = "ozone has 6.5e-7, 1.881e-6, 8.5e-8 /m",
         .citation = hillaire_2020,
         .exclusive_group = "extinction",
         .only_shown = true},
        {}},
    LayerField{{.key = "single_scattering_albedo",
                .kind = Kind::fractions,
                .range = albedo_of_scattering_range,
                .documentation = "scattering as a share of extinction",
                .hint = "haze has 0.9",
                .exclusive_group = "extinction",
                .only_shown = true},
               {}},
    LayerField{{.key = "phase",
                .kind = Kind::choice,
                .choices = phase_choices,
                .fallback = R"("isotropic")",
                .documentation = "where scattered light goes; { mie = \"NAME\" } names particles",
                .citation = henyey_1941,
                .role = Role::phase},
               &Layer::phase},
    LayerField{{.key = "g",
                .kind = Kind::number,
                .range = asymmetry_range,
                .required = true,
                .documentation = "asymmetry of the phase function: forward above 0, back below",
                .hint = "typical haze has 0.76",
                .citation = henyey_1941,
                .selector = "phase",
                .selected_by = with_asymmetry,
                .role = Role::phase},
               &Layer::g},
    LayerField{{.key = "depolarization",
                .kind = Kind::number,
                .range = depolarization_range,
                .documentation = "how much of the light scattered by 90 degrees is depolarised; "
                                 "without it that of the gas (air 0.0279), or 0",
                .citation = "Bates 1984",
                .selector = "phase",
                .selected_by = rayleigh,
                .role = Role::phase},
               {}},
    LayerField{{.key = "particles",
                .kind = Kind::text,
                .required = true,
                .documentation = "NAME of the [particles.NAME] that the layer is made of",
                .selector = "phase",
                .selected_by = mie,
                .role = Role::particles},
               {}},
    LayerField{{.key = "number_density",
                .kind = Kind::number_density,
                .range = number_density_range,
                .documentation = "particles per volume where the density is 1",
                .hint = "haze has 1e3 to 1e4 /cm3, fog 10 to 100 /cm3, rain 1e3 /m3",
                .exclusive_group = "amount",
                .role = Role::particles},
               {}},
};

}  // namespace

std::span<const RootField> root_fields() { return root_table; }

std::span<const AtmosphereField> atmosphere_fields() { return atmosphere_table; }

std::span<const LayerField> layer_fields() { return layer_table; }

}  // namespace skybake::config
