#include "config/sections/particles.h"

#include <fmt/format.h>

#include <limits>

#include "config/fields/fields.h"
#include "config/sections/sections.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {

namespace {

// These are the ends of the tables that bakers/air/particles/water_refractive_index.h cites.
constexpr Length shortest_in_water{0.2e-6};
constexpr Length longest_in_water{4e-6};

// Below this value the difference between the index and that of air is only rounding.
constexpr double least_contrast = 1e-6;

void check_material(const DecodedSection& section, const Particles& particles,
                    std::span<const Length> wavelengths, Decoder& decoder) {
    const auto place_of = [&](std::string_view key) {
        const Value* source = section.at(key).source;
        return source ? source->place : section.place;
    };
    if (particles.material == ParticleMaterial::constant) {
        const double real = particles.refractive_index - 1;
        const double imaginary = particles.absorption_index;
        if (real * real + imaginary * imaginary >= least_contrast * least_contrast) return;
        decoder.diagnostics.error(
            "E0144", place_of("refractive_index"),
            fmt::format("[{}] scatters no light: its refractive index is that of air",
                        section.path),
            "give a refractive_index other than 1, or an absorption_index above 0");
        return;
    }
    const WavelengthRange range = range_of(particles);
    for (const Length wavelength : wavelengths) {
        if (range.contains(wavelength)) continue;
        const bool is_water = particles.material == ParticleMaterial::water;
        decoder.diagnostics.error(
            "E0144", place_of(is_water ? "material" : "indices"),
            fmt::format("[{}]: the refractive index{} is not known at {}", section.path,
                        is_water ? " of water" : "", wavelength_to_string(wavelength.meters)),
            fmt::format("it is known from {} to {}; give other wavelengths, or material = "
                        "\"constant\"",
                        wavelength_to_string(range.shortest.meters),
                        wavelength_to_string(range.longest.meters)));
        return;
    }
}

void check_radii(const DecodedSection& section, const Particles& particles, Decoder& decoder) {
    const double smallest = particles.smallest_radius.meters;
    const double largest = particles.largest_radius.meters;
    if (!(largest > 0) || largest > smallest) return;
    const Value* source = section.at("largest_radius").source;
    decoder.diagnostics.error(
        "E0113", source ? source->place : section.place,
        fmt::format("`{}` is not above smallest_radius: {}",
                    join_path(section.path, "largest_radius"), length_to_string(largest)),
        fmt::format("must be above {}", length_to_string(smallest)));
}

}  // namespace

Particles decode_particles(const std::string& name, const Place& place, const Table& table,
                           std::span<const Length> wavelengths, Decoder& decoder) {
    const std::string path = join_path("particles", name);
    if (!is_bare_key(name)) {
        decoder.diagnostics.error(
            "E0117", place, fmt::format("[{}] cannot be the name of particles", shorten(path)),
            "use only letters, digits, `_` and `-`");
    }
    const DecodedSection section = decode_section(*find_section("particles.*"), path, place, table,
                                                  Absent::filled_in, decoder);
    append_values(section, decoder);
    Particles particles;
    particles.name = name;
    bind_section(section, particles_fields(), particles);
    if (!decoder.diagnostics.has_errors()) {
        check_material(section, particles, wavelengths, decoder);
        check_radii(section, particles, decoder);
    }
    return particles;
}

WavelengthRange range_of(const Particles& particles) {
    switch (particles.material) {
        case ParticleMaterial::water:
            return {shortest_in_water, longest_in_water};
        case ParticleMaterial::tabulated:
            if (particles.indices.empty()) break;  // at fault, which has been reported
            return {particles.indices.front().wavelength, particles.indices.back().wavelength};
        case ParticleMaterial::constant:
            break;
    }
    return {{0}, {std::numeric_limits<double>::infinity()}};
}

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
    Choice{ParticleMaterial::tabulated, "tabulated", "indices, linear between their wavelengths"},
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
constexpr std::string_view tabulated_index[] = {"tabulated"};
constexpr std::string_view distributed[] = {"log_normal", "gamma", "modified_gamma"};
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
    ParticlesField{
        {.key = "indices",
         .kind = Kind::index_table,
         .range = absorption_range,
         .required = true,
         .documentation = "wavelengths, each with the real and the imaginary part of "
                          "the refractive index; a positive imaginary part absorbs",
         .hint = "dust of Mars absorbs blue light: [[\"400 nm\", 1.5, 0.01], [\"700 nm\", "
                 "1.5, 0.003]]",
         .selector = "material",
         .selected_by = tabulated_index},
        &Particles::indices},
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
    ParticlesField{{.key = "smallest_radius",
                    .kind = Kind::length,
                    .range = sphere_radius_range,
                    .documentation = "spheres below it are missing; numbers of particles count the "
                                     "whole distribution",
                    .selector = "sizes",
                    .selected_by = distributed},
                   &Particles::smallest_radius},
    ParticlesField{{.key = "largest_radius",
                    .kind = Kind::length,
                    .range = sphere_radius_range,
                    .documentation = "spheres above it are missing; numbers of particles count the "
                                     "whole distribution",
                    .hint = "OPAC has 20 um, of coarse kinds 60 um",
                    .selector = "sizes",
                    .selected_by = distributed},
                   &Particles::largest_radius},
};

}  // namespace

std::span<const ParticlesField> particles_fields() { return particles_table; }

}  // namespace skybake::config
