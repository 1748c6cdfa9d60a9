#include "bakers/air/particles/check_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/air/particles/particle_scattering.h"

namespace skybake {

namespace {

// As of the key `extinction`.
constexpr double kMostExtinctionPerMeter = 1e6;

config::Diagnostic problem(std::string message, std::string label) {
    config::Diagnostic found;
    found.severity = config::Severity::error;
    found.code = "E0144";
    found.message = std::move(message);
    found.label = std::move(label);
    return found;
}

}  // namespace

std::vector<config::Diagnostic> check_particles(const config::Parameters& parameters) {
    std::vector<config::Diagnostic> problems;
    for (const config::Particles& particles : parameters.particles) {
        double largest = 0;
        for (const config::Length wavelength : parameters.wavelengths) {
            largest = std::max(largest, largest_size_parameter(particles, wavelength));
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
