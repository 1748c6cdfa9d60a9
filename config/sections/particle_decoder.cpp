#include "config/sections/particle_decoder.h"

#include <fmt/format.h>

#include "config/sections/section_rows.h"
#include "config/text/key_path.h"
#include "config/text/suggest.h"
#include "config/text/units.h"

namespace skybake::config {

namespace {

// Those of the tables that bakers/air/particles/water_refractive_index.h cites.
constexpr Length shortest_in_water{0.2e-6};
constexpr Length longest_in_water{4e-6};

// Below this the difference of the index from that of air is rounding.
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
    for (const Length wavelength : wavelengths) {
        if (wavelength.meters >= shortest_in_water.meters &&
            wavelength.meters <= longest_in_water.meters) {
            continue;
        }
        decoder.diagnostics.error(
            "E0144", place_of("material"),
            fmt::format("[{}]: the refractive index of water is not known at {}", section.path,
                        spell_wavelength(wavelength.meters)),
            "it is known from 200 nm to 4000 nm; give other wavelengths, or material = "
            "\"constant\"");
        return;
    }
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
    }
    return particles;
}

}  // namespace skybake::config
