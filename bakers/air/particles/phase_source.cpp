#include "bakers/air/particles/phase_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "bakers/air/particles/particle_scattering.h"
#include "bakers/air/particles/sphere_mixture.h"
#include "config/sections/layer.h"

namespace skybake {

namespace {

// Small spheres are known to many digits in milliseconds; of large ones the error falls only as the
// number of radii (particle_scattering.h), and a third of a per cent takes half a second.
constexpr double kSmallSpheres = 50;  // size parameter
constexpr double kAccuracyOfSmall = 1e-5;
constexpr double kAccuracyOfLarge = 3e-3;

// A tenth of the error that the table may have, where that is more than the usual.
double accuracy_for(const config::LayerParticles& spheres, config::Length wavelength,
                    const std::optional<double>& max_error) {
    const bool small = std::ranges::all_of(spheres.kinds, [&](const config::SphereKind& kind) {
        return largest_size_parameter(kind.particles, wavelength) < kSmallSpheres;
    });
    const double usual = small ? kAccuracyOfSmall : kAccuracyOfLarge;
    return max_error ? std::clamp(*max_error / 10, 1e-5, usual) : usual;
}

constexpr double kTableAccuracy = 1e-6;

template <class T>
const T* find_named(const std::vector<T>& things, const std::string& name) {
    const auto found = std::ranges::find(things, name, &T::name);
    return found == things.end() ? nullptr : &*found;
}

PhaseSource source_of_spheres(const config::LayerParticles& spheres,
                              const std::vector<config::Length>& wavelengths,
                              const std::optional<double>& max_error, int threads) {
    PhaseSource source;
    // Their mean cross-section does not depend on how many there are.
    config::LayerParticles own = spheres;
    own.extinction.reset();
    for (const config::Length wavelength : wavelengths) {
        const auto scattering = sphere_scattering(
            own, wavelength, accuracy_for(spheres, wavelength, max_error), threads);
        PhaseFunction function;
        function.g = scattering->mean_cosine;
        function.table = scattering->phase;
        source.tables.push_back(function.table);
        source.functions.push_back(std::move(function));
        source.error = std::max(source.error, scattering->error);
        const std::string at = fmt::format("_{:.6g}_nm", wavelength.meters * 1e9);
        const auto add = [&](const char* name, double value) {
            source.facts.emplace_back(name + at, to_digits(value, 9));
        };
        add("extinction_cross_section_um2",
            scattering->extinction_per_m / spheres_per_m3(own) * 1e12);
        add("single_scattering_albedo",
            scattering->scattering_per_m / scattering->extinction_per_m);
    }
    return source;
}

PhaseSource source_of_closed_form(const PhaseFunction& function, std::size_t channels) {
    const auto values = [&](const std::vector<ScatteringAngle>& angles) {
        std::vector<double> result;
        for (const ScatteringAngle& angle : angles) {
            result.push_back(phase_value(function, angle.one_minus, angle.one_plus));
        }
        return result;
    };
    PhaseSource source;
    source.functions.assign(channels, function);
    source.tables.assign(channels, std::make_shared<const TabulatedPhase>(
                                       make_tabulated_phase(values, kTableAccuracy).phase));
    return source;
}

}  // namespace

PhaseSource phase_source(const config::Parameters& parameters, const config::PhaseBake& bake,
                         int threads) {
    PhaseSource source;
    if (!bake.particles.empty()) {
        const config::Particles& particles = *find_named(parameters.particles, bake.particles);
        config::LayerParticles alone;
        alone.kinds = {{particles, {1}}};
        source = source_of_spheres(alone, parameters.wavelengths, bake.max_error, threads);
        source.text = "particles " + bake.particles;
        return source;
    }
    const config::Layer& layer = *find_named(parameters.atmosphere.layers, bake.layer);
    source =
        layer.phase == config::Phase::mie
            ? source_of_spheres(layer.particles, parameters.wavelengths, bake.max_error, threads)
            : source_of_closed_form(make_phase_function(layer.phase, layer.g),
                                    parameters.wavelengths.size());
    source.text = "layer " + bake.layer;
    return source;
}

}  // namespace skybake
