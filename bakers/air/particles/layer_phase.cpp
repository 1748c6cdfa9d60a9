#include "bakers/air/particles/layer_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bakers/air/particles/particle_scattering.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/sphere_mixture.h"
#include "config/assets/phase.h"
#include "config/sections/layer.h"
#include "config/sections/parameters.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// The accuracy of the phase function, far below the errors of the sky's tables.
constexpr double kAccuracy = 3e-3;
// Spheres between whose wavelengths light is interpolated give the shapes of spectra, and need less.
constexpr double kAccuracyOfSteps = 1e-2;

std::shared_ptr<const SphereScattering> scattering_of(const config::LayerParticles& layer,
                                                      config::Length wavelength) {
    const double accuracy = layer.step.meters > 0 ? kAccuracyOfSteps : kAccuracy;
    return sphere_scattering(layer, wavelength, accuracy, 1);
}

// The upper limit of the key `extinction`.
constexpr double kMostExtinctionPerMeter = 1e6;

Diagnostic problem(std::string message, std::string label) {
    return diagnosis("E0144", std::move(message), std::move(label));
}

// Whether any spheres that count are within the bounds of radii.
bool has_spheres(const config::Particles& particles, config::Length wavelength) {
    if (particles.sizes == config::SizeDistribution::monodisperse) return true;
    const auto range = RadiusDistribution(particles).scattering_range(wavelength);
    return range.first < range.last;
}

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
        source.tables.push_back(scattering->phase);
        source.functions.push_back({.table = scattering->phase});
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
        return mapped<double>(angles, [&](const ScatteringAngle& angle) {
            return phase_value(function, angle.one_minus, angle.one_plus);
        });
    };
    PhaseSource source;
    source.functions.assign(channels, function);
    source.tables.assign(channels, std::make_shared<const TabulatedPhase>(
                                       make_tabulated_phase(values, kTableAccuracy).phase));
    return source;
}

}  // namespace

LayerPhase layer_phase(const config::Layer& layer) {
    if (layer.phase == config::Phase::rayleigh) {
        return {{make_rayleigh_phase(layer.depolarization)}};
    }
    if (layer.phase != config::Phase::mie) return {{make_phase_function(layer.phase, layer.g)}};
    LayerPhase result;
    for (const config::Length wavelength : layer.particles.wavelengths) {
        result.functions.push_back({.table = scattering_of(layer.particles, wavelength)->phase});
    }
    return result;
}

Spectrum phase_values(const LayerPhase& phase, double one_minus_cosine, double one_plus_cosine) {
    if (phase.is_alike()) {
        return Spectrum(phase_value(phase.functions.front(), one_minus_cosine, one_plus_cosine));
    }
    Spectrum result{};
    for (std::size_t c = 0; c < phase.functions.size(); ++c) {
        data(result)[c] = phase_value(phase.functions[c], one_minus_cosine, one_plus_cosine);
    }
    return result;
}

std::vector<Spectrum> legendre_moments(const LayerPhase& phase, int degree) {
    auto moments = mapped<std::vector<double>>(phase.functions, [&](const PhaseFunction& function) {
        return legendre_moments(function, degree);
    });
    std::vector<Spectrum> result(static_cast<std::size_t>(degree) + 1);
    for (std::size_t l = 0; l < result.size(); ++l) {
        if (phase.is_alike()) {
            result[l] = Spectrum(moments.front()[l]);
            continue;
        }
        for (std::size_t c = 0; c < moments.size(); ++c) result[l][c] = moments[c][l];
    }
    return result;
}

config::Layer with_coefficients(config::Layer layer) {
    if (layer.phase != config::Phase::mie) return layer;
    layer.scattering.clear();
    layer.extinction.clear();
    for (const config::Length wavelength : layer.particles.wavelengths) {
        const auto scattering = scattering_of(layer.particles, wavelength);
        layer.scattering.push_back({scattering->scattering_per_m});
        layer.extinction.push_back({scattering->extinction_per_m});
    }
    return layer;
}

std::vector<Diagnostic> check_particles(const Parameters& parameters) {
    std::vector<Diagnostic> problems;
    for (const config::Particles& particles : parameters.particles) {
        double largest = 0;
        bool is_empty = false;
        for (const config::Length wavelength : parameters.wavelengths) {
            is_empty = is_empty || !has_spheres(particles, wavelength);
            largest = std::max(largest, largest_size_parameter(particles, wavelength));
        }
        if (is_empty) {
            problems.push_back(
                problem(fmt::format("[particles.{}]: no spheres that scatter light have radii "
                                    "within smallest_radius and largest_radius",
                                    particles.name),
                        "give wider bounds, or leave them out"));
            continue;
        }
        if (largest <= kLargestSizeParameter) continue;
        problems.push_back(problem(fmt::format("[particles.{}]: the largest spheres have a "
                                               "circumference of {:.3g} wavelengths, above {:g}",
                                               particles.name, largest, kLargestSizeParameter),
                                   "give smaller spheres or longer wavelengths"));
    }
    // Their cross-sections are not to be asked for.
    if (!problems.empty()) return problems;
    for (const config::Layer& layer : parameters.atmosphere.layers) {
        if (layer.phase != config::Phase::mie) continue;
        double most = 0;
        for (const config::InverseLength value : with_coefficients(layer).extinction) {
            most = std::max(most, value.per_meter);
        }
        if (most <= kMostExtinctionPerMeter) continue;
        problems.push_back(problem(fmt::format("[atmosphere.layers.{}]: its particles have an "
                                               "extinction of {:.3g} /m, above {:g} /m",
                                               layer.name, most, kMostExtinctionPerMeter),
                                   "give a smaller number_density"));
    }
    return problems;
}

PhaseSource phase_source(const Parameters& parameters, const config::PhaseBake& bake, int threads) {
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
