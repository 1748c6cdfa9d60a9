#include "bakers/air/particles/layer_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "bakers/air/particles/particle_scattering.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/sphere_mixture.h"
#include "config/sections/layer.h"
#include "config/sections/parameters.h"

namespace skybake {

namespace {

// The accuracy of the phase function, far below the errors of the sky's tables.
constexpr double kAccuracy = 3e-3;

std::shared_ptr<const SphereScattering> scattering_of(const config::LayerParticles& layer,
                                                      config::Length wavelength) {
    return sphere_scattering(layer, wavelength, kAccuracy, 1);
}

// The upper limit of the key `extinction`.
constexpr double kMostExtinctionPerMeter = 1e6;

config::Diagnostic problem(std::string message, std::string label) {
    config::Diagnostic found;
    found.severity = config::Severity::error;
    found.code = "E0144";
    found.message = std::move(message);
    found.label = std::move(label);
    return found;
}

// Whether any spheres that count are within the bounds of radii.
bool has_spheres(const config::Particles& particles, config::Length wavelength) {
    if (particles.sizes == config::SizeDistribution::monodisperse) return true;
    const auto range = RadiusDistribution(particles).scattering_range(wavelength);
    return range.first < range.last;
}

}  // namespace

LayerPhase layer_phase(const config::Layer& layer) {
    if (layer.phase == config::Phase::rayleigh) {
        return {{make_rayleigh_phase(layer.depolarization)}};
    }
    if (layer.phase != config::Phase::mie) return {{make_phase_function(layer.phase, layer.g)}};
    LayerPhase result;
    for (const config::Length wavelength : layer.particles.wavelengths) {
        const auto scattering = scattering_of(layer.particles, wavelength);
        PhaseFunction function;
        function.g = scattering->mean_cosine;
        function.table = scattering->phase;
        result.functions.push_back(std::move(function));
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
    std::vector<std::vector<double>> moments;
    for (const PhaseFunction& function : phase.functions) {
        moments.push_back(legendre_moments(function, degree));
    }
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

std::vector<config::Diagnostic> check_particles(const config::Parameters& parameters) {
    std::vector<config::Diagnostic> problems;
    for (const config::Particles& particles : parameters.particles) {
        double largest = 0;
        bool is_empty = false;
        for (const config::Length wavelength : parameters.wavelengths) {
            is_empty = is_empty || !has_spheres(particles, wavelength);
            largest = std::max(largest, largest_size_parameter(particles, wavelength));
        }
        if (is_empty) {
            problems.push_back(problem(
                fmt::format("[particles.{}]: no spheres that scatter light have radii within "
                            "smallest_radius and largest_radius",
                            particles.name),
                "give wider bounds, or leave them out"));
            continue;
        }
        if (largest <= kLargestSizeParameter) continue;
        problems.push_back(problem(
            fmt::format("[particles.{}]: the largest spheres have a circumference of {:.3g} "
                        "wavelengths, above {:g}",
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
        problems.push_back(problem(
            fmt::format("[atmosphere.layers.{}]: its particles have an extinction of {:.3g} "
                        "/m, above {:g} /m",
                        layer.name, most, kMostExtinctionPerMeter),
            "give a smaller number_density"));
    }
    return problems;
}

}  // namespace skybake
