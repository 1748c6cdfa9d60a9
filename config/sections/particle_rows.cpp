#include "config/fields/shared_ranges.h"
#include "config/sections/section_rows.h"

namespace skybake::config {
namespace {

constexpr Range sphere_radius_range{1e-10, 0.1};
constexpr Range refractive_range{0.01, 100};
constexpr Range absorption_range{0, 100};
constexpr Range deviation_range{1, 10, true};
constexpr Range variance_range{0, 0.5, true, true};
constexpr Range exponent_range{-0.9, 100};
constexpr Range decay_range{0.1, 10};

constexpr std::string_view hansen_1974 =
    "Hansen and Travis 1974, Light Scattering in Planetary "
    "Atmospheres";
constexpr std::string_view deirmendjian_1969 =
    "Deirmendjian 1969, Electromagnetic Scattering on Spherical Polydispersions";

constexpr std::array material_choices = {
    Choice{ParticleMaterial::water, "water", "liquid water, at each wavelength"},
    Choice{ParticleMaterial::constant, "constant",
           "refractive_index and absorption_index at all wavelengths"},
};
constexpr std::array sizes_choices = {
    Choice{SizeDistribution::monodisperse, "monodisperse", "spheres of a single radius"},
    Choice{SizeDistribution::log_normal, "log_normal",
           "a normal distribution of the radius' logarithm"},
    Choice{SizeDistribution::gamma, "gamma",
           "by effective radius and variance, as clouds are described"},
    Choice{SizeDistribution::modified_gamma, "modified_gamma",
           "r^alpha exp(-(r / radius)^gamma); rain: alpha = 0, gamma = 1"},
};

constexpr std::string_view constant_index[] = {"constant"};
constexpr std::string_view with_radius[] = {"monodisperse", "log_normal", "modified_gamma"};
constexpr std::string_view log_normal[] = {"log_normal"};
constexpr std::string_view gamma[] = {"gamma"};
constexpr std::string_view modified_gamma[] = {"modified_gamma"};

const std::array particles_table = {
    ParticlesField{{.key = "preset",
                    .kind = Kind::text,
                    .documentation = "name of a preset of particles to start from",
                    .only_shown = true},
                   {}},
    ParticlesField{{.key = "material",
                    .kind = Kind::choice,
                    .choices = material_choices,
                    .fallback = R"("water")",
                    .documentation = "what the spheres are made of"},
                   &Particles::material},
    ParticlesField{{.key = "refractive_index",
                    .kind = Kind::number,
                    .range = refractive_range,
                    .required = true,
                    .documentation = "real part of the refractive index, relative to air",
                    .hint = "ammonium sulfate has 1.52, mineral dust 1.5 to 1.6, ice 1.31",
                    .selector = "material",
                    .selected_by = constant_index},
                   &Particles::refractive_index},
    ParticlesField{
        {.key = "absorption_index",
         .kind = Kind::number,
         .range = absorption_range,
         .fallback = "0",
         .documentation = "imaginary part of the refractive index; a positive one absorbs",
         .hint = "mineral dust has 0.001 to 0.008, soot 0.4 to 0.8",
         .selector = "material",
         .selected_by = constant_index},
        &Particles::absorption_index},
    ParticlesField{{.key = "sizes",
                    .kind = Kind::choice,
                    .choices = sizes_choices,
                    .fallback = R"("gamma")",
                    .documentation = "distribution of the radii",
                    .citation = hansen_1974},
                   &Particles::sizes},
    ParticlesField{{.key = "radius",
                    .kind = Kind::length,
                    .range = sphere_radius_range,
                    .required = true,
                    .documentation = "radius of all spheres (monodisperse), the median "
                                     "(log_normal) or the scale (modified_gamma)",
                    .hint = "haze has 0.05 to 0.5 um",
                    .selector = "sizes",
                    .selected_by = with_radius},
                   &Particles::radius},
    ParticlesField{
        {.key = "geometric_deviation",
         .kind = Kind::number,
         .range = deviation_range,
         .required = true,
         .documentation = "factor about the median within which two thirds of the radii lie",
         .hint = "haze has 1.5 to 2.3",
         .selector = "sizes",
         .selected_by = log_normal},
        &Particles::geometric_deviation},
    ParticlesField{{.key = "effective_radius",
                    .kind = Kind::length,
                    .range = sphere_radius_range,
                    .required = true,
                    .documentation = "mean radius, weighted by cross-section",
                    .hint = "cloud droplets have 5 to 15 um",
                    .citation = hansen_1974,
                    .selector = "sizes",
                    .selected_by = gamma},
                   &Particles::effective_radius},
    ParticlesField{{.key = "effective_variance",
                    .kind = Kind::number,
                    .range = variance_range,
                    .fallback = "0.1",
                    .documentation =
                        "variance of the radii, weighted by cross-section, over their mean squared",
                    .hint = "cloud droplets have 0.05 to 0.2",
                    .citation = hansen_1974,
                    .selector = "sizes",
                    .selected_by = gamma},
                   &Particles::effective_variance},
    ParticlesField{{.key = "alpha",
                    .kind = Kind::number,
                    .range = exponent_range,
                    .required = true,
                    .documentation = "exponent of the small radii",
                    .citation = deirmendjian_1969,
                    .selector = "sizes",
                    .selected_by = modified_gamma},
                   &Particles::alpha},
    ParticlesField{{.key = "gamma",
                    .kind = Kind::number,
                    .range = decay_range,
                    .fallback = "1",
                    .documentation = "exponent of the decay towards large radii",
                    .citation = deirmendjian_1969,
                    .selector = "sizes",
                    .selected_by = modified_gamma},
                   &Particles::gamma},
};

}  // namespace

std::span<const ParticlesField> particles_fields() { return particles_table; }

}  // namespace skybake::config
