#include "config/sections/particles.h"

#include <fmt/format.h>

#include <limits>

#include "config/fields/fields.h"
#include "config/sections/sections.h"
#include "config/text/key_path.h"
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
    if (particles.material == ParticleMaterial::constant) {
        const double real = particles.refractive_index - 1;
        const double imaginary = particles.absorption_index;
        if (real * real + imaginary * imaginary >= least_contrast * least_contrast) return;
        decoder.diagnostics.error(
            "E0144", section.place_of("refractive_index"),
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
            "E0144", section.place_of(is_water ? "material" : "indices"),
            fmt::format("[{}]: the refractive index{} is not known at {}", section.path,
                        is_water ? " of water" : "", wavelength_to_string(wavelength.meters)),
            fmt::format(
                "it is known from {} to {}; give other wavelengths, or material = \"constant\"",
                wavelength_to_string(range.shortest.meters),
                wavelength_to_string(range.longest.meters)));
        return;
    }
}

void check_radii(const DecodedSection& section, const Particles& particles, Decoder& decoder) {
    const double smallest = particles.smallest_radius.meters;
    const double largest = particles.largest_radius.meters;
    if (!(largest > 0) || largest > smallest) return;
    decoder.report("E0113", section, "largest_radius",
                   fmt::format("is not above smallest_radius: {}", length_to_string(largest)),
                   fmt::format("must be above {}", length_to_string(smallest)));
}

constexpr Range sphere_radius_range{1e-10, 0.1};
constexpr Range absorption_range{0, 100};

constexpr std::string_view hansen_1974 =
    "Hansen and Travis 1974, Light Scattering in Planetary Atmospheres";
constexpr std::string_view deirmendjian_1969 =
    "Deirmendjian 1969, Electromagnetic Scattering on Spherical Polydispersions";

constexpr Choice material_choices[] = {
    {ParticleMaterial::water, "water", "liquid water, at each wavelength"},
    {ParticleMaterial::constant, "constant",
     "refractive_index and absorption_index at all wavelengths"},
    {ParticleMaterial::tabulated, "tabulated", "indices, linear between their wavelengths"},
};
constexpr Choice sizes_choices[] = {
    {SizeDistribution::monodisperse, "monodisperse", "spheres of a single radius"},
    {SizeDistribution::log_normal, "log_normal", "a normal distribution of the radius' logarithm"},
    {SizeDistribution::gamma, "gamma", "by effective radius and variance, as clouds are described"},
    {SizeDistribution::modified_gamma, "modified_gamma",
     "r^alpha exp(-(r / radius)^gamma); rain: alpha = 0, gamma = 1"},
};

constexpr Words distributed = {"log_normal", "gamma", "modified_gamma"};

const Row<Particles> particles_table[] = {
    {"preset", Kind::text, nullptr, "name of a preset of particles to start from",
     KeyFlag::only_shown},
    {"material", Kind::choice, &Particles::material, "what the spheres are made of",
     material_choices, Default{R"("water")"}},
    {"refractive_index", Kind::number, &Particles::refractive_index,
     "real part of the refractive index, relative to air", Range{0.01, 100}, KeyFlag::required,
     Hint{"ammonium sulfate has 1.52, mineral dust 1.5 to 1.6, ice 1.31"},
     When{"material", "constant"}},
    {"absorption_index", Kind::number, &Particles::absorption_index,
     "imaginary part of the refractive index; a positive one absorbs", absorption_range,
     Default{"0"}, Hint{"mineral dust has 0.001 to 0.008, soot 0.4 to 0.8"},
     When{"material", "constant"}},
    {"indices", Kind::index_table, &Particles::indices,
     "wavelengths, each with the real and the imaginary part of the refractive index; a positive "
     "imaginary part absorbs",
     absorption_range, KeyFlag::required,
     Hint{"dust of Mars absorbs blue light: [[\"400 nm\", 1.5, 0.01], [\"700 nm\", 1.5, 0.003]]"},
     When{"material", "tabulated"}},
    {"sizes", Kind::choice, &Particles::sizes, "distribution of the radii", sizes_choices,
     Default{R"("gamma")"}, Cited{hansen_1974}},
    {"radius", Kind::length, &Particles::radius,
     "radius of all spheres (monodisperse), the median (log_normal) or the scale (modified_gamma)",
     sphere_radius_range, KeyFlag::required, Hint{"haze has 0.05 to 0.5 um"},
     When{"sizes", {"monodisperse", "log_normal", "modified_gamma"}}},
    {"geometric_deviation", Kind::number, &Particles::geometric_deviation,
     "factor about the median within which two thirds of the radii lie", Range{1, 10, true},
     KeyFlag::required, Hint{"haze has 1.5 to 2.3"}, When{"sizes", "log_normal"}},
    {"effective_radius", Kind::length, &Particles::effective_radius,
     "mean radius, weighted by cross-section", sphere_radius_range, KeyFlag::required,
     Hint{"cloud droplets have 5 to 15 um"}, When{"sizes", "gamma"}, Cited{hansen_1974}},
    {"effective_variance", Kind::number, &Particles::effective_variance,
     "variance of the radii, weighted by cross-section, over their mean squared",
     Range{0, 0.5, true, true}, Default{"0.1"}, Hint{"cloud droplets have 0.05 to 0.2"},
     When{"sizes", "gamma"}, Cited{hansen_1974}},
    {"alpha", Kind::number, &Particles::alpha, "exponent of the small radii", Range{-0.9, 100},
     KeyFlag::required, When{"sizes", "modified_gamma"}, Cited{deirmendjian_1969}},
    {"gamma", Kind::number, &Particles::gamma, "exponent of the decay towards large radii",
     Range{0.1, 10}, Default{"1"}, When{"sizes", "modified_gamma"}, Cited{deirmendjian_1969}},
    {"smallest_radius", Kind::length, &Particles::smallest_radius,
     "spheres below it are missing; numbers of particles count the whole distribution",
     sphere_radius_range, When{"sizes", distributed}},
    {"largest_radius", Kind::length, &Particles::largest_radius,
     "spheres above it are missing; numbers of particles count the whole distribution",
     sphere_radius_range, Hint{"OPAC has 20 um, of coarse kinds 60 um"},
     When{"sizes", distributed}},
};

}  // namespace

Particles decode_particles(const Entry& entry, std::span<const Length> wavelengths,
                           Decoder& decoder) {
    const std::string path = join_path("particles", entry.key);
    check_name(entry, path, "particles", decoder);
    Particles particles;
    particles.name = entry.key;
    const DecodedSection section = decode_into(particles, particles_fields(), "particles.*", path,
                                               entry.key_place, *as_table(entry.value), decoder);
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

std::span<const Row<Particles>> particles_fields() { return particles_table; }

}  // namespace skybake::config
