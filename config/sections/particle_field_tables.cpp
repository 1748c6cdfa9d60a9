// The field tables of particles and of the phase functions that are baked; field_tables.cpp says
// how such tables work.
#include "config/assets/shared_fields.h"
#include "config/assets/sky_fields.h"
#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"

namespace skybake::config {
namespace {

constexpr Range sphere_radius_range{1e-10, 0.1};
constexpr Range refractive_range{0.01, 100};
constexpr Range absorption_range{0, 100};
constexpr Range deviation_range{1, 10, true};
constexpr Range variance_range{0, 0.5, true, true};
constexpr Range exponent_range{-0.9, 100};
constexpr Range decay_range{0.1, 10};
constexpr Range phase_texel_range{2, 16384};
constexpr Range phase_degree_range{1, 256};

constexpr std::string_view hansen_1974 =
    "Hansen and Travis 1974, Light Scattering in Planetary "
    "Atmospheres";
constexpr std::string_view deirmendjian_1969 =
    "Deirmendjian 1969, Electromagnetic Scattering on Spherical Polydispersions";

// Choices, each in the order of its enumeration in parameters.h.
constexpr std::array material_choices = {
    Choice{"water", "liquid water, at each wavelength"},
    Choice{"constant", "refractive_index and absorption_index at all wavelengths"},
};
constexpr std::array sizes_choices = {
    Choice{"monodisperse", "spheres of a single radius"},
    Choice{"log_normal", "a normal distribution of the radius' logarithm"},
    Choice{"gamma", "by effective radius and variance, as clouds are described"},
    Choice{"modified_gamma", "r^alpha exp(-(r / radius)^gamma); rain: alpha = 0, gamma = 1"},
};
constexpr std::array phase_content_choices = {
    Choice{"phase", "the phase function, 1/sr"},
    Choice{"inverse_cumulative", "1 - cosine of the angle below which a share u of light goes"},
};
constexpr std::array spacing_choices = {
    Choice{"best", "the most accurate of the three, or the smallest with max_error"},
    Choice{"angle", "uniform in the scattering angle"},
    Choice{"cosine", "uniform in its cosine"},
    Choice{"peaks", "closer together towards 0 and 180 deg"},
};

constexpr std::string_view constant_index[] = {"constant"};
constexpr std::string_view with_radius[] = {"monodisperse", "log_normal", "modified_gamma"};
constexpr std::string_view log_normal[] = {"log_normal"};
constexpr std::string_view gamma[] = {"gamma"};
constexpr std::string_view modified_gamma[] = {"modified_gamma"};
constexpr std::string_view phase[] = {"phase"};

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

const std::array phase_table = {
    PhaseField{asset_field, {}},
    PhaseField{{.key = "particles",
                .kind = Kind::text,
                .documentation = "NAME of the [particles.NAME] that scatter",
                .exclusive_group = "of"},
               &PhaseBake::particles},
    PhaseField{{.key = "layer",
                .kind = Kind::text,
                .documentation = "NAME of the [atmosphere.layers.NAME] that scatters",
                .exclusive_group = "of"},
               &PhaseBake::layer},
    PhaseField{{.key = "size",
                .kind = Kind::integer,
                .range = phase_texel_range,
                .fallback = "1024",
                .documentation = "texels",
                .exclusive_group = "size"},
               &PhaseBake::size},
    PhaseField{
        {.key = "max_error",
         .kind = Kind::fraction,
         .range = lookup_error_range,
         .documentation =
             "in place of size, asks for the smallest table whose lookups are within this error",
         .hint = "errors below 0.01 are invisible",
         .exclusive_group = "size"},
        &PhaseBake::max_error},
    PhaseField{{.key = "content",
                .kind = Kind::choice,
                .choices = phase_content_choices,
                .fallback = R"("phase")",
                .documentation = "what the texels hold"},
               &PhaseBake::content},
    PhaseField{{.key = "spacing",
                .kind = Kind::choice,
                .choices = spacing_choices,
                .fallback = R"("best")",
                .documentation = "which angle a texel stands for",
                .selector = "content",
                .selected_by = phase},
               &PhaseBake::spacing},
    PhaseField{{.key = "degree",
                .kind = Kind::integer,
                .range = phase_degree_range,
                .fallback = "16",
                .documentation = "Legendre moments up to this degree go into the manifest"},
               &PhaseBake::degree},
    PhaseField{table_pixel_type_field, &PhaseBake::pixel_type},
    PhaseField{compression_field, &PhaseBake::compression},
};

}  // namespace

std::span<const ParticlesField> particles_fields() { return particles_table; }

std::span<const PhaseField> phase_fields() { return phase_table; }

}  // namespace skybake::config
